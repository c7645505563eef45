import { vi } from "vitest";

/** Stands for the browser's AudioContext: a clock that the test sets. */
export class FakeAudio extends EventTarget {
  readonly destination = {};
  readonly baseLatency = 0.01;
  state = "running";

  constructor(
    public currentTime: number,
    readonly outputLatency: number,
  ) {
    super();
  }

  decodeAudioData(): Promise<object> {
    return Promise.resolve({});
  }

  change(state: string): void {
    this.state = state;
    this.dispatchEvent(new Event("statechange"));
  }
}

/** Notes what it was told; plays nothing. */
class FakeSource {
  at = NaN;
  offset = NaN;
  stopped = false;
  stoppedAt: number | undefined;
  readonly connect = vi.fn();
  readonly disconnect = vi.fn();

  constructor() {
    played.sources.push(this);
  }

  start(at: number, offset: number): void {
    this.at = at;
    this.offset = offset;
  }

  stop(at?: number): void {
    this.stopped = true;
    this.stoppedAt = at;
  }
}

/** Notes the gains it was told: until when one holds does not matter. */
class FakeGain {
  readonly initial: number;
  readonly told: { gain: number; at: number; sudden: boolean }[] = [];
  readonly connect = vi.fn();
  readonly disconnect = vi.fn();
  readonly gain = {
    setTargetAtTime: (gain: number, at: number) => this.told.push({ gain, at, sudden: false }),
    setValueAtTime: (gain: number, at: number) => this.told.push({ gain, at, sudden: true }),
    cancelScheduledValues: vi.fn(),
  };

  constructor(_context: unknown, options: { gain: number }) {
    this.initial = options.gain;
    played.gains.push(this);
  }
}

/** All that was scheduled since `reset`. */
export const played = {
  Source: FakeSource,
  GainNode: FakeGain,
  sources: [] as FakeSource[],
  gains: [] as FakeGain[],

  get last(): FakeSource {
    const source = played.sources.at(-1);
    if (source === undefined) throw new Error("nothing was scheduled");
    return source;
  },

  reset(): void {
    played.sources = [];
    played.gains = [];
  },

  /** Lets fetching and decoding come to their end. */
  async settled(): Promise<void> {
    for (let i = 0; i < 10; i++) await Promise.resolve();
  },
};
