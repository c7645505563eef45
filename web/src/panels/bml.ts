import type { Connection } from "../connection";
import { create, element, sentenceOf } from "../dom";
import { SAMPLES } from "./samples";

/** The editor that sends BML, with examples to start from. */
export class BmlPanel {
  private readonly form = element("bml-form", HTMLFormElement);
  private readonly samples = element("bml-samples", HTMLSelectElement);
  private readonly text = element("bml-text", HTMLTextAreaElement);
  private readonly answer = element("bml-answer", HTMLOutputElement);
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
      await this.connection.request({ type: "bml", xml });
      this.say("accepted", "Accepted");
      // An id may not be reused while its block lives: an unedited example gets a new one.
      if (this.text.value === this.loaded) this.load();
    } catch (error) {
      this.say("refused", sentenceOf(error));
    }
  }

  private say(state: "accepted" | "refused", sentence: string): void {
    this.answer.dataset.state = state;
    this.answer.textContent = sentence;
  }
}

/** A block id that no other page is likely to use. */
function freshId(): string {
  return `bml-${Math.random().toString(36).slice(2, 6)}`;
}
