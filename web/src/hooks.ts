import type { Position } from "./protocol";
import type { Quality } from "./quality";
import type { SpeechRecord } from "./speech";
import type { Viewer } from "./viewer";

/** What a test in a browser may look at, as `window.viewer`; nothing here can be changed. */
export interface ViewerState {
  readonly quality: Quality;
  readonly connected: boolean;
  /** Number of frames whose time has come, over all characters. */
  readonly framesPlayed: number;
  /** Realizer time of the newest frame shown, s. */
  readonly lastFrameTime: number | null;
  readonly feedbackCount: number;
  /** The last pieces of speech, oldest first. */
  readonly speech: SpeechRecord[];
  /** World position of a bone, m. */
  bone(characterId: string, name: string): Position | null;
  /** Present weight of a morph. */
  morph(characterId: string, name: string): number | null;
}

declare global {
  interface Window {
    viewer?: ViewerState;
  }
}

/** A read-only view on the running page. */
export function stateOf(viewer: Viewer): ViewerState {
  return Object.freeze({
    quality: viewer.quality,
    get connected() {
      return viewer.connection.connected;
    },
    get framesPlayed() {
      return viewer.cast.framesPlayed;
    },
    get lastFrameTime() {
      return viewer.cast.lastFrameTime;
    },
    get feedbackCount() {
      return viewer.feedback.count;
    },
    get speech() {
      return viewer.speech.records;
    },
    bone: (characterId: string, name: string) => viewer.cast.bone(characterId, name),
    morph: (characterId: string, name: string) => viewer.cast.morph(characterId, name),
  });
}
