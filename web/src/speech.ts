import { heardTime, type PlayoutClock } from "./clock";
import type { AudioMessage } from "./connection";
import type { AudioStart } from "./protocol";
import { Utterance } from "./utterance";

/** Number of utterances kept as records. */
const REMEMBERED = 20;

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
 * While speech plays, it is the master of the playout clock, so that lips and sound stay together.
 */
export class SpeechPlayer {
  private utterances = new Map<string, Utterance>();

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

  handle(message: AudioMessage): void {
    if (message.type === "audio") {
      this.announce(message);
      return;
    }
    const utterance = this.utterances.get(message.id);
    if (utterance === undefined) return;
    switch (message.type) {
      case "audio_move":
        utterance.start = message.start;
        this.schedule(utterance);
        break;
      case "audio_gain":
        utterance.changeGain(message.time, message.gain);
        break;
      case "audio_stop":
        utterance.stop(message.time, message.fade);
        break;
    }
  }

  /** The realizer time of the speech heard now, s; null when none plays. */
  heard(): number | null {
    const heard = heardTime(this.context);
    for (const utterance of this.utterances.values()) {
      if (utterance.begin === null) continue;
      const time = utterance.start + heard - utterance.begin;
      if (time >= utterance.start && time < utterance.end) return time;
    }
    return null;
  }

  /** Stops and removes all utterances: the realizer is new. */
  clear(): void {
    for (const utterance of this.utterances.values()) utterance.silence();
    this.utterances.clear();
  }

  private announce(message: AudioStart): void {
    this.utterances.get(message.id)?.silence();
    const utterance = new Utterance(message, this.context);
    this.utterances.set(message.id, utterance);
    this.forgetOldest();
    utterance.load().then(() => {
      if (this.utterances.get(message.id) === utterance) this.schedule(utterance);
    }, this.onFailure);
  }

  private schedule(utterance: Utterance): void {
    utterance.silence();
    const shown = this.clock.at(performance.now() / 1000);
    if (shown === null || shown >= utterance.end || this.context.state !== "running") return;
    utterance.schedule(heardTime(this.context) + utterance.start - shown);
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
