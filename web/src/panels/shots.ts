import { element } from "../dom";
import type { Shot } from "../framing";

/** The button of each shot; the n-th has the key n. */
const SHOTS: [Shot, string][] = [
  ["face", "shot-face"],
  ["bust", "shot-bust"],
  ["upper", "shot-upper"],
  ["full", "shot-full"],
];

/** Buttons and keys that choose how much of the characters the camera shows. */
export class ShotsPanel {
  constructor(private readonly choose: (shot: Shot) => void) {
    for (const [shot, id] of SHOTS) {
      element(id, HTMLButtonElement).addEventListener("click", () => {
        this.choose(shot);
      });
    }
    window.addEventListener("keydown", (event) => {
      const [shot] = SHOTS[Number(event.key) - 1] ?? [];
      const typing = document.activeElement?.matches("input, select, textarea") ?? false;
      if (shot !== undefined && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) this.choose(shot);
    });
  }

  /** Marks the shot that the camera shows; none once the user has moved it. */
  mark(shown: Shot | null): void {
    for (const [shot, id] of SHOTS) element(id, HTMLButtonElement).ariaPressed = String(shot === shown);
  }
}
