import type { Pictures as PicturesMessage } from "./protocol";

/** The pictures that show characters in place of their bodies, as messages announce them. */
export class Pictures {
  /** Messages by character, in the order of time; the first one may have come. */
  private readonly announced = new Map<string, PicturesMessage[]>();

  handle(message: PicturesMessage): void {
    const before = this.announced.get(message.character) ?? [];
    this.announced.set(message.character, [...before, message]);
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
