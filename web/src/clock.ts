/**
 * Three clocks: the realizer's (s, estimated from its frames), the page's (`performance.now()`, here in s) and the sound
 * card's. A clock is stored as an offset to the page's time, so a reading is always `page + offset`.
 */

/** Number of recent frames of which the one that was delayed least is used: those of two seconds. */
const SAMPLES = 100;

/** Delay of the page behind the frames, s: the network jitter that it absorbs before a pose is late. */
export const PLAYOUT_DELAY = 0.05;

/** Greatest deviation from the rate of real time while the playout clock closes a gap. */
const GLIDE = 0.05;

/** Gap above which the playout clock jumps, because gliding would take too long, s. */
const JUMP = 0.25;

/**
 * Realizer time as a page sees it: that of a frame that has just arrived, undelayed as few are. It lags by the latency
 * of the network, so that on a remote page frames and sounds are as punctual as on a near one.
 */
export class FrameClock {
  private offsets: number[] = [];

  /** Begins anew: a message with realizer time `time` arrived at page time `page`, both s. */
  reset(page: number, time: number): void {
    this.offsets = [time - page];
  }

  /** Takes a frame of realizer time `time` that arrived at page time `page`, both s. */
  take(page: number, time: number): void {
    this.offsets.push(time - page);
    if (this.offsets.length > SAMPLES) this.offsets.shift();
  }

  /** Realizer time at a page time, s; null before the first message. */
  at(page: number): number | null {
    return this.offsets.length === 0 ? null : page + Math.max(...this.offsets);
  }
}

/**
 * The realizer time that is shown now.
 *
 * It follows the frames less the playout delay, and glides towards it, so that corrections do not make motion
 * jerk.
 */
export class PlayoutClock {
  private offset: number | null = null;
  private lastPage = 0;

  /** Moves towards the time that is due at this page time; both s. */
  follow(page: number, due: number): void {
    const target = due - page;
    const elapsed = Math.max(0, page - this.lastPage);
    this.lastPage = page;
    if (this.offset === null || Math.abs(target - this.offset) > JUMP) {
      this.offset = target;
      return;
    }
    const step = GLIDE * elapsed;
    this.offset += Math.min(step, Math.max(-step, target - this.offset));
  }

  /** The time shown at a page time, s; null before the first call of `follow`. */
  at(page: number): number | null {
    return this.offset === null ? null : page + this.offset;
  }
}

/** The audio time of the sample heard now, s: played one output latency ago. */
export function heardTime(context: Pick<AudioContext, "baseLatency" | "currentTime" | "outputLatency">): number {
  // Safari does not report the output latency.
  const latency = (context.outputLatency as number | undefined) ?? context.baseLatency;
  return context.currentTime - latency;
}
