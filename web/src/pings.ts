import type { ServerClock } from "./clock";
import type { Ping, Pong } from "./protocol";

/** At first a quick burst, to know the realizer's time at once; then now and then, ms. */
const BURST = 5;
const BURST_INTERVAL = 100;
const STEADY_INTERVAL = 2000;

/** Asks the realizer for its time as long as the connection stands, and tells the server clock. */
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

  /** Begins with the realizer time (s) that the greeting carried. */
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
