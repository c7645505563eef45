import type { Connection } from "../connection";
import { create, element } from "../dom";
import { acceptedAnswer, type EditorAnswer, lineSpan, type Mistake, refusedAnswer } from "./answer";
import { SAMPLES } from "./samples";

/** The editor that sends BML, with examples to start from. */
export class BmlPanel {
  private readonly form = element("bml-form", HTMLFormElement);
  private readonly samples = element("bml-samples", HTMLSelectElement);
  private readonly text = element("bml-text", HTMLTextAreaElement);
  private readonly answer = element("bml-answer", HTMLOutputElement);
  private readonly mistakes = element("bml-mistakes", HTMLOListElement);
  /** The example as it was loaded into the editor. */
  private loaded = "";

  constructor(private readonly connection: Connection) {
    this.samples.append(...Object.keys(SAMPLES).map((title) => create("option", "", title)));
    this.samples.addEventListener("change", () => {
      this.load();
    });
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.send();
    });
    this.text.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.form.requestSubmit();
    });
    this.load();
  }

  private load(): void {
    this.loaded = SAMPLES[this.samples.value]?.(freshId()) ?? "";
    this.text.value = this.loaded;
  }

  private async send(): Promise<void> {
    const xml = this.text.value;
    try {
      this.show(acceptedAnswer(await this.connection.request({ type: "bml", xml })));
      // An id may not be reused while its block lives: an unedited example gets a new one.
      if (this.text.value === this.loaded) this.load();
    } catch (error) {
      this.show(refusedAnswer(error));
    }
  }

  private show({ state, summary, mistakes }: EditorAnswer): void {
    this.answer.dataset.state = state;
    this.answer.textContent = summary;
    this.mistakes.replaceChildren(...mistakes.map((mistake) => this.item(mistake)));
    this.mistakes.hidden = mistakes.length === 0;
  }

  /** A mistake as an item of the list; a click selects its line. */
  private item({ line, message, refused }: Mistake): HTMLElement {
    const item = create("li", refused ? "refused" : "");
    if (line === null) {
      item.textContent = message;
      return item;
    }
    const button = create("button");
    button.type = "button";
    button.append(create("span", "line", `line ${line}`), create("span", "", message));
    button.addEventListener("click", () => {
      this.select(line);
    });
    item.append(button);
    return item;
  }

  private select(line: number): void {
    const [start, end] = lineSpan(this.text.value, line);
    this.text.setSelectionRange(start, start);
    this.text.focus(); // which scrolls to the cursor, but would not to a selection
    this.text.setSelectionRange(start, end);
  }
}

/** A block id that no other page is likely to use. */
function freshId(): string {
  return `bml-${Math.random().toString(36).slice(2, 6)}`;
}
