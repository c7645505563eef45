import { heardTime, type PlayoutClock } from "./clock";
import type { AudioMessage } from "./connection";
import { sentenceOf } from "./errors";
import type { AudioStart } from "./protocol";
import { Utterance } from "./utterance";

/** Speech of the past that is remembered for who asks what was played. */
const REMEMBERED = 20;

/** How one piece of speech was played, s: `start` and `end` realizer time, `begin` audio time of its first sample. */
export interface SpeechRecord {
  id: string;
  character: string;
  start: number;
  end: number;
  begin: number | null;
}

/**
 * All speech of the scene, each piece scheduled on the audio clock such that it is heard at its realizer time.
 *
 * While one sounds it is the master of the playout clock: what is seen is what belongs to what is heard.
 */
export class SpeechPlayer {
  private utterances = new Map<string, Utterance>();

  constructor(
    private readonly context: AudioContext,
    private readonly clock: PlayoutClock,
    private readonly onFailure: (sentence: string) => void,
  ) {
    context.addEventListener("statechange", () => {
      this.rescheduleAll();
    });
  }

  /** The last pieces of speech, oldest first. */
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

  /** The realizer time that is heard at this moment, s; null when nothing sounds. */
  heard(): number | null {
    const heard = heardTime(this.context);
    for (const utterance of this.utterances.values()) {
      if (utterance.begin === null) continue;
      const time = utterance.start + heard - utterance.begin;
      if (time >= utterance.start && time < utterance.end) return time;
    }
    return null;
  }

  /** Forgets all: the realizer that announced it is gone. */
  clear(): void {
    for (const utterance of this.utterances.values()) utterance.silence();
    this.utterances.clear();
  }

  private announce(message: AudioStart): void {
    this.utterances.get(message.id)?.silence();
    const utterance = new Utterance(message, this.context);
    this.utterances.set(message.id, utterance);
    this.forgetOldest();
    utterance.load().then(
      () => {
        if (this.utterances.get(message.id) === utterance) this.schedule(utterance);
      },
      (reason: unknown) => {
        this.onFailure(sentenceOf(reason));
      },
    );
  }

  private schedule(utterance: Utterance): void {
    utterance.silence();
    const shown = this.clock.at(performance.now() / 1000);
    if (shown === null || shown >= utterance.end || this.context.state !== "running") return;
    utterance.schedule(heardTime(this.context) + utterance.start - shown);
  }

  /** The audio clock stood still or runs again: what was scheduled by it no longer holds. */
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
