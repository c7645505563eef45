import type { Ping, Pong } from "./protocol";

/**
 * Three clocks: the realizer's (s, estimated from pongs), the page's (`performance.now()`, here in s) and the sound
 * card's. A clock is stored as an offset to the page's time, so a reading is always `page + offset`.
 */

/** Number of recent pongs from which the fastest is used. */
const SAMPLES = 16;

/** Delay of the page behind the realizer, s: the network jitter that it absorbs before a pose is late. */
export const PLAYOUT_DELAY = 0.05;

/** Greatest deviation from the rate of real time while the playout clock closes a gap. */
const GLIDE = 0.05;

/** Gap above which the playout clock jumps, because gliding would take too long, s. */
const JUMP = 0.25;

/** Number of pings sent in quick succession after the greeting, to estimate realizer time soon. */
const BURST = 5;

/** Time between two pings, in the burst and later, ms. */
const BURST_INTERVAL = 100;
const STEADY_INTERVAL = 2000;

interface Sample {
  roundTrip: number;
  offset: number;
}

/** Estimates realizer time: the offset of the fastest recent pong, which the network delayed least. */
export class ServerClock {
  private samples: Sample[] = [];

  /** Takes a first, rough reading: a message with realizer time `server` arrived at page time `page`. */
  reset(page: number, server: number): void {
    this.samples = [{ roundTrip: Infinity, offset: server - page }];
  }

  /** Takes a pong with realizer time `server`: it was on its way back for half of the round trip. */
  sample(sent: number, received: number, server: number): void {
    const roundTrip = received - sent;
    this.samples.push({ roundTrip, offset: server + roundTrip / 2 - received });
    if (this.samples.length > SAMPLES) this.samples.shift();
  }

  /** Realizer time at a page time, s; null before the first reading. */
  at(page: number): number | null {
    if (this.samples.length === 0) return null;
    const fastest = this.samples.reduce((best, next) => (next.roundTrip < best.roundTrip ? next : best));
    return page + fastest.offset;
  }
}

/** Pings the realizer while the connection is open, and passes the pongs to the server clock. */
export class Pings {
  private timer: ReturnType<typeof setTimeout> | null = null;
  private sent = 0;

  constructor(
    private readonly clock: ServerClock,
    private readonly send: (message: Ping) => void,
  ) {}

  get running(): boolean {
    return this.timer !== null;
  }

  /** Starts from the realizer time (s) in the greeting. */
  start(serverTime: number): void {
    this.clock.reset(performance.now() / 1000, serverTime);
    this.sent = 0;
    this.schedule(0);
  }

  stop(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
  }

  answered(pong: Pong): void {
    this.clock.sample(pong.t, performance.now() / 1000, pong.time);
  }

  private schedule(delay: number): void {
    this.timer = setTimeout(() => {
      this.send({ type: "ping", t: performance.now() / 1000 });
      this.sent++;
      this.schedule(this.sent < BURST ? BURST_INTERVAL : STEADY_INTERVAL);
    }, delay);
  }
}

/**
 * The realizer time that is shown now.
 *
 * It follows the server's clock less the playout delay, and glides towards it, so that corrections do not make motion
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
