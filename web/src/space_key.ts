/** What the space bar does. */
export type KeyMove = "press" | "release";

/** What a keyboard event says; of a KeyboardEvent no more is needed. */
interface KeyEvent extends Event {
  readonly code: string;
  readonly repeat: boolean;
}

/**
 * The space bar as an anticipator sees it: pressed once, however long it is held, and released for every press.
 *
 * While a field, a button or a list has the focus the key belongs to that: `idle` says whether nothing has it.
 */
export class SpaceKey {
  private down = false;

  constructor(
    keys: EventTarget,
    private readonly idle: () => boolean,
    private readonly onMove: (move: KeyMove) => void,
  ) {
    keys.addEventListener("keydown", (event) => {
      this.press(event as KeyEvent);
    });
    keys.addEventListener("keyup", (event) => {
      if ((event as KeyEvent).code === "Space") this.release();
    });
    // A key that is let go in another window is never heard of.
    keys.addEventListener("blur", () => {
      this.release();
    });
  }

  private press(event: KeyEvent): void {
    if (event.code !== "Space" || !this.idle()) return;
    event.preventDefault(); // else the page scrolls
    if (event.repeat || this.down) return;
    this.down = true;
    this.onMove("press");
  }

  private release(): void {
    if (!this.down) return;
    this.down = false;
    this.onMove("release");
  }
}
