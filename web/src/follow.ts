import type { Position } from "./protocol";

/** Distance over the floor that a character must move before the camera follows, m. */
const STEP = 0.4;

/** The same up or down: who falls is followed, and who sits down is not. */
const DROP = 0.6;

/** A character that moves less than this for some time rests, m and ms. */
const REST = 0.02;
const REST_TIME = 500;

/** Decides when the camera follows the characters: from when one has moved far until all rest. */
export class Follow {
  /** Their roots as the camera shows them, m. */
  private framed: Position[] = [];
  private following = false;
  private rest = { roots: [] as Position[], since: 0 };

  /** Takes the roots (m) at a page time (ms), and returns whether the camera is to show these. */
  update(page: number, roots: Position[]): boolean {
    if (!near(this.rest.roots, roots, REST, REST)) this.rest = { roots, since: page };
    if (!this.following && near(this.framed, roots, STEP, DROP)) return false;
    this.framed = roots;
    this.following = page - this.rest.since < REST_TIME;
    return true;
  }
}

/** Whether all characters are within a distance, over the floor and in height, of where they were. */
function near(before: Position[], roots: Position[], along: number, up: number): boolean {
  if (before.length !== roots.length) return false;
  return roots.every(([x, y, z], i) => {
    const [x0, y0, z0] = before[i] ?? [NaN, NaN, NaN];
    return Math.hypot(x - x0, z - z0) < along && Math.abs(y - y0) < up;
  });
}
