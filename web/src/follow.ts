import type { Position } from "./protocol";

/** How far a character must move before the camera follows: over the floor, down and up, m. */
interface Slack {
  along: number;
  down: number;
  up: number;
}

/** Who falls is followed, and who sits down is not; who rises would lose the head. */
const WIDE: Slack = { along: 0.4, down: 0.6, up: 0.1 };

/** In a picture of heads, who sits down is followed too. */
const CLOSE: Slack = { along: 0.15, down: 0.12, up: 0.05 };

/** A character that moves less than this for some time rests, m and ms. */
const REST: Slack = { along: 0.02, down: 0.02, up: 0.02 };
const REST_TIME = 500;

/** Decides when the camera follows the characters: from when one has moved far until all rest. */
export class Follow {
  /** Their roots as the camera shows them, m. */
  private framed: Position[] = [];
  private following = false;
  private rest = { roots: [] as Position[], since: 0 };

  /** Takes the roots (m) at a page time (ms), and returns whether the camera, close to heads or not, is to show these. */
  update(page: number, roots: Position[], close: boolean): boolean {
    if (!near(this.rest.roots, roots, REST)) this.rest = { roots, since: page };
    if (!this.following && near(this.framed, roots, close ? CLOSE : WIDE)) return false;
    this.framed = roots;
    this.following = page - this.rest.since < REST_TIME;
    return true;
  }
}

/** Whether no character is farther from where it was than a slack allows. */
function near(before: Position[], roots: Position[], { along, down, up }: Slack): boolean {
  if (before.length !== roots.length) return false;
  return roots.every(([x, y, z], i) => {
    const [x0, y0, z0] = before[i] ?? [NaN, NaN, NaN];
    return Math.hypot(x - x0, z - z0) < along && y0 - y < down && y - y0 < up;
  });
}
