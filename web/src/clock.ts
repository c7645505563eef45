/**
 * Three clocks: the realizer's (s, told by pongs), the page's (`performance.now()`, here in s) and the sound card's.
 *
 * A clock is read as an offset to the page's time, so a reading is always `page + offset`.
 */

/** Number of pongs among which the quickest is believed. */
const SAMPLES = 16;

/** How far the page stays behind the realizer, s: what the network may jitter before a pose is late. */
export const PLAYOUT_DELAY = 0.05;

/** Greatest deviation from the rate of real time while the playout clock closes a gap. */
const GLIDE = 0.05;

/** A gap beyond which gliding would take too long to be worth it, s. */
const JUMP = 0.25;

interface Sample {
  roundTrip: number;
  offset: number;
}

/** Realizer time as seen from here: the offset told by the quickest of the last pongs, which was delayed least. */
export class ServerClock {
  private samples: Sample[] = [];

  /** A first, rough reading: a message that carried realizer time came now. */
  reset(page: number, server: number): void {
    this.samples = [{ roundTrip: Infinity, offset: server - page }];
  }

  /** A pong: sent and received in page time, with the realizer time it carried; the way back took half of it. */
  sample(sent: number, received: number, server: number): void {
    const roundTrip = received - sent;
    this.samples.push({ roundTrip, offset: server + roundTrip / 2 - received });
    if (this.samples.length > SAMPLES) this.samples.shift();
  }

  /** Realizer time at a page time, s; null before the first reading. */
  at(page: number): number | null {
    if (this.samples.length === 0) return null;
    const quickest = this.samples.reduce((best, next) => (next.roundTrip < best.roundTrip ? next : best));
    return page + quickest.offset;
  }
}

/**
 * The realizer time that is shown and heard at this moment.
 *
 * It follows a master (the server's clock less the playout delay; while speech sounds, the sound that is heard) and
 * glides towards it, so that a correction is never seen as a jump, nor the graininess of the audio clock as a tremor.
 */
export class PlayoutClock {
  private offset: number | null = null;
  private lastPage = 0;

  /** Moves towards what the master says at this page time; both s. */
  follow(page: number, master: number): void {
    const target = master - page;
    const elapsed = Math.max(0, page - this.lastPage);
    this.lastPage = page;
    if (this.offset === null || Math.abs(target - this.offset) > JUMP) {
      this.offset = target;
      return;
    }
    const step = GLIDE * elapsed;
    this.offset += Math.min(step, Math.max(-step, target - this.offset));
  }

  /** The time shown at a page time, s; null before there was a master. */
  at(page: number): number | null {
    return this.offset === null ? null : page + this.offset;
  }
}

/** What is heard now, in the time of the audio context, s: what was played one output latency ago. */
export function heardTime(context: Pick<AudioContext, "baseLatency" | "currentTime" | "outputLatency">): number {
  // Safari does not tell the output latency.
  const latency = (context.outputLatency as number | undefined) ?? context.baseLatency;
  return context.currentTime - latency;
}
