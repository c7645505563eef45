/**
 * Three clocks: the realizer's (s, estimated from its frames), the page's (`performance.now()`, here in s) and the sound
 * card's. A clock is stored as an offset to the page's time, so a reading is always `page + offset`.
 */

/** Number of recent frames of which the one that was delayed least is used: those of two seconds. */
const SAMPLES = 100;

/** Bounds of the delay of the page behind the frames, s. */
const SHORTEST_DELAY = 0.05;
const LONGEST_DELAY = 0.3;

/** Number of recent frames whose lateness counts for the delay: those of ten seconds. */
const JUDGED = 500;

/** Share of these frames that may be later than the delay. */
const TOO_LATE = 0.02;

/** Time between two frames, s: a pose is between the last frame and the next one. */
const FRAME = 0.02;

/** Share of the delay for sounds that remains after one that came in time. */
const EASES = 0.9;

/** Greatest deviation from the rate of real time while the playout clock closes a gap. */
const GLIDE = 0.05;

/** Greatest distance of the time of a face from the time shown, s. */
export const FURTHEST_FACE = 0.3;

/** Rate at which a face returns to the time shown, when nothing of it is heard any more, s per s. */
const FACE_RETURNS = 0.5;

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
 * Delay of the page behind the frames, long enough that most frames and sounds arrive before their time is shown: mouth
 * and sound are together only then. It follows the jitter of the network and the time in which sounds are decoded.
 */
export class PlayoutDelay {
  private lateness: number[] = [];
  private forFrames = SHORTEST_DELAY;
  private forSounds = 0;

  /** The delay, s. */
  get seconds(): number {
    return Math.min(LONGEST_DELAY, Math.max(this.forFrames, this.forSounds));
  }

  /** Takes how much later than the least delayed one a frame arrived, s. */
  takeFrame(late: number): void {
    this.lateness.push(late);
    if (this.lateness.length > JUDGED) this.lateness.shift();
    const sorted = [...this.lateness].sort((a, b) => b - a);
    const tolerated = sorted[Math.floor(TOO_LATE * sorted.length)] ?? 0;
    this.forFrames = Math.max(SHORTEST_DELAY, tolerated + FRAME);
  }

  /**
   * Takes how much later than its time a sound could be played, s; not above 0 if it came in time. Returns by how much
   * the delay grew, s.
   */
  takeSound(late: number): number {
    const before = this.seconds;
    this.forSounds = late > 0 ? Math.min(LONGEST_DELAY, before + late) : EASES * this.forSounds;
    return Math.max(0, this.seconds - before);
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

  /** Stays behind by some time more at once, s: the picture waits for a sound that has come late. */
  wait(seconds: number): void {
    if (this.offset !== null) this.offset -= seconds;
  }

  /** The time shown at a page time, s; null before the first call of `follow`. */
  at(page: number): number | null {
    return this.offset === null ? null : page + this.offset;
  }
}

/**
 * The time of the frame that shows the face of a character: that of the sound that is heard, so that lips and sound are
 * together also before the realizer knows that a sound came late.
 */
export class FaceClock {
  /** Offset from the time shown, s. */
  private shift = 0;
  private lastTime = 0;

  /** The time of the face for a time shown and that of the frame of what is heard (null if nothing is), s. */
  at(time: number, heard: number | null): number {
    const step = FACE_RETURNS * Math.max(0, time - this.lastTime);
    this.lastTime = time;
    if (heard === null) this.shift -= Math.min(step, Math.max(-step, this.shift));
    else this.shift = Math.min(FURTHEST_FACE, Math.max(-FURTHEST_FACE, heard - time));
    return time + this.shift;
  }
}

/** The audio time of the sample heard now, s: played one output latency ago. */
export function heardTime(context: Pick<AudioContext, "baseLatency" | "currentTime" | "outputLatency">): number {
  // Safari does not report the output latency.
  const latency = (context.outputLatency as number | undefined) ?? context.baseLatency;
  return context.currentTime - latency;
}
