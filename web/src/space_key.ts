/** The events of the space bar. */
export type KeyMove = "press" | "release";

/** The part of a KeyboardEvent that is needed here. */
interface KeyEvent extends Event {
  readonly code: string;
  readonly repeat: boolean;
}

/**
 * The space bar as an anticipator's input: one press however long it is held, and one release for every press.
 *
 * A press counts only while `idle` returns true: otherwise the key belongs to the control that has the focus.
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
    // A key released in another window sends no event here.
    keys.addEventListener("blur", () => {
      this.release();
    });
  }

  private press(event: KeyEvent): void {
    if (event.code !== "Space" || !this.idle()) return;
    event.preventDefault(); // otherwise, the page scrolls
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
