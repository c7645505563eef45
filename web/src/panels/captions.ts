import type { Reading } from "../captions";
import { create, element } from "../dom";

/** Under which the browser remembers that captions are hidden. */
const HIDDEN = "captions-hidden";

/** Size of a caption by the gain of its speech: the smallest and the greatest, of which 1 is the usual one. */
const SMALLEST = 0.6;
const GREATEST = 1.5;

/** Captions over the figures, which a button switches on and off. */
export class CaptionsPanel {
  private readonly holder = element("captions", HTMLElement);
  private readonly button = element("captions-switch", HTMLButtonElement);
  private shown = "";

  constructor() {
    this.setHidden(localStorage.getItem(HIDDEN) !== null);
    this.button.addEventListener("click", () => {
      this.setHidden(!this.holder.hidden);
    });
  }

  /** Shows what is read now; called once an animation frame. */
  show(readings: Reading[]): void {
    const shown = JSON.stringify(readings);
    if (shown === this.shown) return;
    this.shown = shown;
    this.holder.replaceChildren(...readings.map((reading) => lineOf(reading, readings.length > 1)));
  }

  private setHidden(hidden: boolean): void {
    this.holder.hidden = hidden;
    this.button.ariaPressed = String(!hidden);
    if (hidden) localStorage.setItem(HIDDEN, "");
    else localStorage.removeItem(HIDDEN);
  }
}

/** A caption; with the name of its character, if several speak. */
function lineOf({ character, before, word, after, cut, gain }: Reading, named: boolean): HTMLElement {
  const line = create("p", "caption");
  line.style.fontSize = `${Math.min(Math.max((1 + gain) / 2, SMALLEST), GREATEST)}em`;
  if (named) line.append(create("span", "speaker", character));
  line.append(before, create("mark", "", word), cut ? `${after}—` : after);
  return line;
}
