import type { AudioStart } from "./protocol";

/** How quickly a changed gain settles, s: short, but without a click. */
const GAIN_SETTLES = 0.02;

/** Within this part of a fade the sound falls to 1/e: at its end less than a hundredth is left. */
const FADE_FALLS = 0.2;

/** When a sound begins on the audio clock, and how far into it. */
export interface Entry {
  at: number;
  offset: number;
}

/** A gain, 1 as recorded, from a realizer time on. */
interface GainChange {
  time: number;
  gain: number;
}

/** Where to enter a sound that should begin at audio time `begin`; one whose beginning has passed is joined late. */
export function entry(begin: number, now: number): Entry {
  return begin >= now ? { at: begin, offset: 0 } : { at: now, offset: now - begin };
}

/** One announced piece of speech: its samples, and the node that plays them once they are scheduled. */
export class Utterance {
  /** Realizer time of its first sample, s; moves with `audio_move`. */
  start: number;
  /** Audio time at which its first sample is (or would have been) played, s; null while not scheduled. */
  begin: number | null = null;
  /** Realizer time at which it falls silent early, s. */
  private stopped: { time: number; fade: number } | null = null;
  /** Gains, each from a realizer time on, in order: a sound that is scheduled anew goes through them again. */
  private readonly gains: GainChange[] = [];
  private buffer: AudioBuffer | null = null;
  private source: AudioBufferSourceNode | null = null;
  private gain: GainNode | null = null;

  constructor(
    readonly announced: AudioStart,
    private readonly context: AudioContext,
  ) {
    this.start = announced.start;
  }

  /** Realizer time after which nothing of it sounds, s. */
  get end(): number {
    const natural = this.start + this.announced.duration;
    return this.stopped === null ? natural : Math.min(natural, this.stopped.time + this.stopped.fade);
  }

  get scheduled(): boolean {
    return this.source !== null;
  }

  /** Fetches and decodes the samples; rejects when they cannot be had. */
  async load(): Promise<void> {
    const response = await fetch(this.announced.url);
    if (!response.ok) throw new Error(`the sound of ${this.announced.id} is not there (HTTP ${response.status})`);
    this.buffer = await this.context.decodeAudioData(await response.arrayBuffer());
  }

  /**
   * Plays so that the first sample comes at audio time `begin`, replacing what was scheduled before. Without samples
   * yet it does nothing.
   */
  schedule(begin: number): void {
    this.silence();
    if (this.buffer === null) return;
    const { at, offset } = entry(begin, this.context.currentTime);
    this.begin = begin;
    const joined = this.start + offset;
    this.gain = new GainNode(this.context, { gain: this.gainAt(joined) });
    this.gain.connect(this.context.destination);
    this.source = new AudioBufferSourceNode(this.context, { buffer: this.buffer });
    this.source.connect(this.gain);
    this.source.start(at, offset);
    for (const change of this.gains) if (change.time > joined) this.follow(change);
    this.applyStop();
  }

  /** Has another gain from realizer time `time` on. */
  changeGain(time: number, gain: number): void {
    this.gains.push({ time, gain });
    this.follow({ time, gain });
  }

  /** Falls silent from realizer time `time` on, within `fade` s. */
  stop(time: number, fade: number): void {
    this.stopped = { time, fade };
    this.applyStop();
  }

  /** Takes back what was scheduled. */
  silence(): void {
    this.source?.stop();
    this.source?.disconnect();
    this.gain?.disconnect();
    this.source = this.gain = this.begin = null;
  }

  private gainAt(time: number): number {
    return this.gains.filter((change) => change.time <= time).at(-1)?.gain ?? this.announced.gain;
  }

  private follow({ time, gain }: GainChange): void {
    if (this.gain === null || this.begin === null) return;
    const at = Math.max(this.context.currentTime, this.begin + time - this.start);
    // Until the first sample nothing can click.
    if (at <= this.begin) this.gain.gain.setValueAtTime(gain, at);
    else this.gain.gain.setTargetAtTime(gain, at, GAIN_SETTLES);
  }

  private applyStop(): void {
    if (this.stopped === null || this.source === null || this.gain === null || this.begin === null) return;
    const { time, fade } = this.stopped;
    const from = Math.max(this.context.currentTime, this.begin + time - this.start);
    this.gain.gain.cancelScheduledValues(from);
    this.gain.gain.setTargetAtTime(0, from, fade * FADE_FALLS);
    this.source.stop(from + fade);
  }
}
