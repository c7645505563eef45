import type { Position } from "./protocol";

/** At most five reports a second, ms apart. */
const INTERVAL = 200;

/** A move smaller than this is none, m. */
const STILL = 0.005;

/** Tells the realizer where the page's camera is, when it has moved: virtual humans look there. */
export class CameraReport {
  private reported: Position | null = null;
  private nextReport = 0;

  constructor(private readonly send: (position: Position) => void) {}

  /** The camera is there at a page time (ms). */
  update(page: number, eye: Position): void {
    if (page < this.nextReport || (this.reported !== null && distance(this.reported, eye) < STILL)) return;
    this.reported = eye;
    this.nextReport = page + INTERVAL;
    this.send(eye);
  }

  /** Whoever was told before is gone; the next update reports again. */
  reset(): void {
    this.reported = null;
  }
}

function distance(a: Position, b: Position): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
