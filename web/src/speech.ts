import type { Sound } from "./binary";
import { heardTime, type PlayoutClock } from "./clock";
import type { AudioMessage } from "./connection";
import type { AudioStart, Heard } from "./protocol";
import { Utterance } from "./utterance";

/** Number of utterances kept as records. */
const REMEMBERED = 20;

/** Time between two reports of what is heard, s. */
const REPORT_INTERVAL = 0.25;

/** Drift from the plan above which a sound is heard to be off, s: that at which Elckerlyc skips (thesis 8.17). */
const OFF = 0.07;

/** Delay up to which a sound that comes late is played from its first word, s: that up to which the realizer follows. */
const FOLLOWED = 1;

/** Number of reports for which a sound may be off, before it skips: the realizer follows another page. */
const PATIENCE = 8;

/** How an utterance was played, s: `start` and `end` in realizer time, `begin` the audio time of its first sample. */
export interface SpeechRecord {
  id: string;
  character: string;
  start: number;
  end: number;
  begin: number | null;
}

/**
 * Plays all speech of the scene, scheduled on the audio clock such that it is heard at its realizer time.
 *
 * It reports what is heard. If that drifts from the plan, the realizer moves the plan, so that lips, gestures and sound
 * stay together.
 */
export class SpeechPlayer {
  private utterances = new Map<string, Utterance>();
  /** Sounds that have been sent, by the id under which they are announced next. */
  private readonly sent = new Map<string, ArrayBuffer>();
  private nextReport = 0;

  constructor(
    private readonly context: AudioContext,
    private readonly clock: PlayoutClock,
    private readonly onFailure: (reason: unknown) => void,
  ) {
    context.addEventListener("statechange", () => {
      this.rescheduleAll();
    });
  }

  /** The last utterances, oldest first. */
  get records(): SpeechRecord[] {
    return [...this.utterances.values()].map(({ announced, start, end, begin }) => {
      return { id: announced.id, character: announced.character, start, end, begin };
    });
  }

  /** Takes a sound that is announced next. */
  take({ id, wav }: Sound): void {
    this.sent.set(id, wav);
  }

  handle(message: AudioMessage): void {
    if (message.type === "audio") {
      this.announce(message);
      return;
    }
    const utterance = this.utterances.get(message.id);
    if (utterance === undefined) return;
    switch (message.type) {
      case "audio_move":
        utterance.move(message.start);
        if (!this.onTime(utterance)) this.schedule(utterance);
        break;
      case "audio_gain":
        utterance.changeGain(message.time, message.gain);
        break;
      case "audio_stop":
        utterance.stop(message.time, message.fade);
        break;
    }
  }

  /** What is heard now of each sound, a few times a second; a sound that stays off its plan skips to its place. */
  report(): Heard[] {
    const page = performance.now() / 1000;
    const time = this.clock.at(page);
    if (time === null || page < this.nextReport || this.context.state !== "running") return [];
    this.nextReport = page + REPORT_INTERVAL;
    const reports: Heard[] = [];
    for (const utterance of this.utterances.values()) {
      const position = utterance.positionAt(heardTime(this.context));
      if (position === null) continue;
      reports.push({ type: "heard", id: utterance.announced.id, position, time });
      utterance.strayed = this.onTime(utterance) ? 0 : utterance.strayed + 1;
      if (utterance.strayed >= PATIENCE) this.schedule(utterance);
    }
    return reports;
  }

  /** Stops and removes all utterances: the realizer is new. */
  clear(): void {
    for (const utterance of this.utterances.values()) utterance.silence();
    this.utterances.clear();
    this.sent.clear();
  }

  private announce(message: AudioStart): void {
    this.utterances.get(message.id)?.silence();
    const utterance = new Utterance(message, this.context);
    this.utterances.set(message.id, utterance);
    this.forgetOldest();
    const sent = this.sent.get(message.id);
    this.sent.delete(message.id);
    utterance.load(sent).then(() => {
      if (this.utterances.get(message.id) === utterance) this.begin(utterance);
    }, this.onFailure);
  }

  /**
   * Schedules a sound that has just come. If it comes late, it is played from its first word nevertheless: reports say
   * so, and the speech follows. A sound that comes later than that is joined in the middle.
   */
  private begin(utterance: Utterance): void {
    const planned = this.beginOf(utterance);
    if (planned === null) return;
    const now = this.context.currentTime;
    utterance.schedule(now - planned <= FOLLOWED ? Math.max(planned, now) : planned);
  }

  /** Whether a sound is heard now, in its place. */
  private onTime(utterance: Utterance): boolean {
    const position = utterance.positionAt(heardTime(this.context));
    const shown = this.clock.at(performance.now() / 1000);
    return position !== null && shown !== null && Math.abs(shown - utterance.start - position) <= OFF;
  }

  private schedule(utterance: Utterance): void {
    utterance.silence();
    utterance.strayed = 0;
    const begin = this.beginOf(utterance);
    if (begin !== null) utterance.schedule(begin);
  }

  /** The audio time at which the first sample is to be played, as planned; null if it is not to be played now. */
  private beginOf({ start, end }: Utterance): number | null {
    const shown = this.clock.at(performance.now() / 1000);
    if (shown === null || shown >= end || start === Infinity || this.context.state !== "running") return null;
    return heardTime(this.context) + start - shown;
  }

  /** Schedules all utterances again, because the audio clock has stopped or resumed. */
  private rescheduleAll(): void {
    for (const utterance of this.utterances.values()) this.schedule(utterance);
  }

  private forgetOldest(): void {
    for (const [id, utterance] of this.utterances) {
      if (this.utterances.size <= REMEMBERED) return;
      utterance.silence();
      this.utterances.delete(id);
    }
  }
}
