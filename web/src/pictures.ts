import type { Pictures as PicturesMessage } from "./protocol";

/** Most messages kept of a character: a page that is not drawn, in a hidden tab, does not show them. */
const CAPACITY = 100;

/** The pictures that show characters in place of their bodies, as messages announce them. */
export class Pictures {
  /** Messages by character, in the order of time; the first one may have come. */
  private readonly announced = new Map<string, PicturesMessage[]>();

  handle(message: PicturesMessage): void {
    const messages = this.announced.get(message.character) ?? [];
    messages.push(message);
    if (messages.length > CAPACITY) messages.shift();
    this.announced.set(message.character, messages);
  }

  /** The files of each character at a realizer time, s, from the lowest to the uppermost. Times must not go back. */
  at(time: number): Map<string, string[]> {
    const shown = new Map<string, string[]>();
    for (const [character, messages] of this.announced) {
      const come = messages.filter((message) => message.time <= time);
      const last = come.at(-1);
      this.announced.set(character, messages.slice(Math.max(come.length - 1, 0)));
      if (last !== undefined && last.files.length > 0) shown.set(character, last.files);
    }
    return shown;
  }

  /** Forgets everything: the realizer is new. */
  clear(): void {
    this.announced.clear();
  }
}
