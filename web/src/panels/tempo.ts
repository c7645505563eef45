import type { Connection } from "../connection";
import { element } from "../dom";
import { sentenceOf } from "../errors";

/** At most so often the tempo is sent while it is dragged, ms. */
const INTERVAL = 100;

/** The metronome's tempo, beats a minute, in the hands of the page's user. */
export class TempoPanel {
  private readonly slider = element("tempo", HTMLInputElement);
  private readonly value = element("tempo-value", HTMLOutputElement);
  private waiting: ReturnType<typeof setTimeout> | null = null;

  constructor(
    private readonly connection: Connection,
    private readonly onFailure: (sentence: string) => void,
  ) {
    this.show();
    this.slider.addEventListener("input", () => {
      this.show();
      this.sendSoon();
    });
  }

  private show(): void {
    this.value.textContent = `${this.slider.value} bpm`;
  }

  private sendSoon(): void {
    this.waiting ??= setTimeout(() => {
      this.waiting = null;
      this.send();
    }, INTERVAL);
  }

  private send(): void {
    const value = this.slider.valueAsNumber;
    this.connection
      .request({ type: "event", anticipator: "metronome", event: "tempo", value })
      .catch((error: unknown) => {
        this.onFailure(sentenceOf(error));
      });
  }
}
