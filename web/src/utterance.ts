import type { AudioStart } from "./protocol";

/** Time constant of a change of gain, s: the shortest without a click. */
const GAIN_SETTLES = 0.02;

/** Time constant of a fade as a fraction of its duration: less than a hundredth is left at its end. */
const FADE_FALLS = 0.2;

/** The audio time at which playback starts, and the offset into the sound, both s. */
export interface Entry {
  at: number;
  offset: number;
}

/** A realizer time of the first sample (s, Infinity while it is unknown), which the frames from `shown` on show. */
interface Start {
  time: number;
  shown: number;
}

/** A gain (1: as recorded) from a realizer time on. */
interface GainChange {
  time: number;
  gain: number;
}

/** The entry into a sound that begins at audio time `begin`; a sound that has already begun is entered late. */
export function entry(begin: number, now: number): Entry {
  return begin >= now ? { at: begin, offset: 0 } : { at: now, offset: now - begin };
}

/** One utterance: its samples, and the audio nodes that play them once it is scheduled. */
export class Utterance {
  /** Its starts, in order; `audio_move` adds one. */
  private readonly starts: Start[];
  /** How many times in a row it was heard far off its plan. */
  strayed = 0;
  /** Audio time at which its first sample is (or would have been) played, s; null while not scheduled. */
  begin: number | null = null;
  /** Realizer time at which it is stopped early, and its fade, s. */
  private stopped: { time: number; fade: number } | null = null;
  /** Changes of gain in order, kept because scheduling again applies them again. */
  private readonly gains: GainChange[] = [];
  private buffer: AudioBuffer | null = null;
  private source: AudioBufferSourceNode | null = null;
  private gain: GainNode | null = null;

  /** @param spoken - whether lips move with it */
  constructor(
    readonly announced: AudioStart,
    readonly spoken: boolean,
    private readonly context: AudioContext,
  ) {
    this.starts = [{ time: announced.start ?? Infinity, shown: -Infinity }];
  }

  /** Realizer time of its first sample, s; Infinity while it is unknown. */
  get start(): number {
    return this.starts.at(-1)?.time ?? Infinity;
  }

  /** Realizer time after which it is silent, s. */
  get end(): number {
    const natural = this.start + this.announced.duration;
    return this.stopped === null ? natural : Math.min(natural, this.stopped.time + this.stopped.fade);
  }

  get scheduled(): boolean {
    return this.source !== null;
  }

  /** Decodes the samples, and fetches them unless they have been sent; rejects when that fails. */
  async load(sent: ArrayBuffer | undefined): Promise<void> {
    this.buffer = await this.context.decodeAudioData(sent ?? (await this.fetched()));
  }

  private async fetched(): Promise<ArrayBuffer> {
    const response = await fetch(this.announced.url);
    if (!response.ok)
      throw new Error(`The audio of ${this.announced.id} could not be loaded (HTTP ${response.status}).`);
    return response.arrayBuffer();
  }

  /**
   * Schedules the first sample at audio time `begin`, in place of any earlier schedule. Does nothing before the
   * samples are loaded.
   */
  schedule(begin: number): void {
    this.silence();
    if (this.buffer === null) return;
    const { at, offset } = entry(begin, this.context.currentTime);
    this.begin = begin;
    const entered = this.start + offset;
    this.gain = new GainNode(this.context, { gain: this.gainAt(entered) });
    this.gain.connect(this.context.destination);
    this.source = new AudioBufferSourceNode(this.context, { buffer: this.buffer });
    this.source.connect(this.gain);
    this.source.start(at, offset);
    for (const change of this.gains) if (change.time > entered) this.follow(change);
    this.applyStop();
  }

  /** The position that is heard at an audio time, s, negative for up to `ahead` s; null while nothing of it is heard. */
  positionAt(audio: number, ahead = 0): number | null {
    if (this.begin === null) return null;
    const position = audio - this.begin;
    return position >= -ahead && position < this.end - this.start ? position : null;
  }

  /** The time of the frame that shows a position; both s. */
  frameTime(position: number): number {
    return this.starts.reduce((time, { time: start, shown }) => {
      return time < shown ? time : Math.max(shown, start + position);
    }, Infinity);
  }

  /** Changes the realizer time of the first sample, in the frames from `shown` on, without a change of what is played. */
  move(start: number, shown: number): void {
    this.starts.push({ time: start, shown });
    this.applyStop();
  }

  /** Changes the gain from realizer time `time` on. */
  changeGain(time: number, gain: number): void {
    this.gains.push({ time, gain });
    this.follow({ time, gain });
  }

  /** Fades out from realizer time `time` on, within `fade` s. */
  stop(time: number, fade: number): void {
    this.stopped = { time, fade };
    this.applyStop();
  }

  /** Removes what was scheduled. */
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
    // A sudden change clicks only if it comes after the first sample.
    if (at <= this.begin) this.gain.gain.setValueAtTime(gain, at);
    else this.gain.gain.setTargetAtTime(gain, at, GAIN_SETTLES);
  }

  private applyStop(): void {
    if (this.stopped === null || this.source === null || this.gain === null || this.begin === null) return;
    const { time, fade } = this.stopped;
    if (time <= this.start && this.begin >= this.context.currentTime) {
      this.silence(); // otherwise, the fade of its first samples would be heard
      return;
    }
    const from = Math.max(this.context.currentTime, this.begin + time - this.start);
    this.gain.gain.cancelScheduledValues(from);
    this.gain.gain.setTargetAtTime(0, from, fade * FADE_FALLS);
    this.source.stop(from + fade);
  }
}
