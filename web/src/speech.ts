import type { Sound } from "./binary";
import { heardTime, type PlayoutClock, type PlayoutDelay } from "./clock";
import type { AudioMessage } from "./connection";
import type { AudioStart, Heard } from "./protocol";
import { Utterance } from "./utterance";

/** Number of utterances kept as records. */
const REMEMBERED = 20;

/** Time between two reports of what is heard, s. */
const REPORT_INTERVAL = 0.25;

/** The same just after a sound began late, and the number of such reports: the realizer follows two that agree. */
const SOON = 0.06;
const SOON_REPORTS = 2;

/** Change of its time at which a sound that has not begun is scheduled again, s. */
const SHIFT = 0.005;

/** Drift from the plan above which a sound is heard to be off, s: that at which Elckerlyc skips (thesis 8.17). */
const OFF = 0.07;

/** Delay up to which a sound that comes late is played from its first word, s: that up to which the realizer follows. */
const FOLLOWED = 1;

/** Time before a sound in which the lips move towards its first shape, s. */
const APPROACH = 0.2;

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
  /** The id of the last caption; the sound with that id, which follows it, is speech. */
  private captioned = "";
  private nextReport = 0;
  private soon = 0;

  constructor(
    private readonly context: AudioContext,
    private readonly clock: PlayoutClock,
    private readonly delay: PlayoutDelay,
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

  /** The position of a sound on the audio clock, s; negative before its start, null while it is not scheduled. */
  position(id: string): number | null {
    const begin = this.utterances.get(id)?.begin ?? null;
    return begin === null || this.context.state !== "running" ? null : heardTime(this.context) - begin;
  }

  /** The time of the frame that shows what is heard of the speech of a character, s; null if nothing is. */
  frameTime(character: string): number | null {
    if (this.context.state !== "running") return null;
    const heard = heardTime(this.context);
    for (const utterance of this.utterances.values()) {
      if (utterance.announced.character !== character || !utterance.spoken) continue;
      const position = utterance.positionAt(heard, APPROACH);
      if (position !== null) return utterance.frameTime(position);
    }
    return null;
  }

  /** Takes a sound that is announced next. */
  take({ id, wav }: Sound): void {
    this.sent.set(id, wav);
  }

  handle(message: AudioMessage): void {
    if (message.type === "caption") {
      this.captioned = message.id;
      return;
    }
    if (message.type === "audio") {
      this.announce(message);
      return;
    }
    const utterance = this.utterances.get(message.id);
    if (utterance === undefined) return;
    switch (message.type) {
      case "audio_move":
        utterance.move(message.start, message.time);
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
    for (const utterance of this.utterances.values()) this.keepAhead(utterance);
    const page = performance.now() / 1000;
    const time = this.clock.at(page);
    if (time === null || page < this.nextReport || this.context.state !== "running") return [];
    const reports: Heard[] = [];
    for (const utterance of this.utterances.values()) {
      const position = utterance.positionAt(heardTime(this.context));
      if (position === null) continue;
      reports.push({ type: "heard", id: utterance.announced.id, position, time });
      utterance.strayed = this.onTime(utterance) ? 0 : utterance.strayed + 1;
      if (utterance.strayed >= PATIENCE) this.schedule(utterance);
    }
    if (reports.length > 0) this.soon = Math.max(0, this.soon - 1);
    this.nextReport = page + (this.soon > 0 ? SOON : REPORT_INTERVAL);
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
    const utterance = new Utterance(message, message.id === this.captioned, this.context);
    this.utterances.set(message.id, utterance);
    this.forgetOldest();
    const sent = this.sent.get(message.id);
    this.sent.delete(message.id);
    utterance.load(sent).then(() => {
      if (this.utterances.get(message.id) === utterance) this.begin(utterance);
    }, this.onFailure);
  }

  /**
   * Schedules a sound that has just come. If it comes late, it is played from its first word nevertheless: the picture
   * waits for it, as far as the delay may grow; reports say how late it still is, and the speech follows. A sound that
   * comes later than that is joined in the middle.
   */
  private begin(utterance: Utterance): void {
    const planned = this.beginOf(utterance);
    if (planned === null) return;
    const late = this.context.currentTime - planned;
    utterance.schedule(late <= FOLLOWED ? planned + Math.max(late, 0) : planned);
    if (late > FOLLOWED) return;
    this.clock.wait(this.delay.takeSound(late));
    if (late <= 0) return;
    this.nextReport = 0;
    this.soon = SOON_REPORTS;
  }

  /** Schedules a sound again that has not begun, if its time has changed with the playout clock. */
  private keepAhead(utterance: Utterance): void {
    if (utterance.begin === null || utterance.begin - this.context.currentTime < SHIFT) return;
    const planned = this.beginOf(utterance);
    if (planned === null || Math.abs(planned - utterance.begin) <= SHIFT) return;
    utterance.schedule(Math.max(planned, this.context.currentTime));
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
