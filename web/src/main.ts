import { makeTabs } from "./dom";
import { Film } from "./film";
import { shotOf } from "./framing";
import { StatusPanel } from "./panels/status";
import { StepsPanel } from "./panels/steps";
import type { Position } from "./protocol";
import type { SpeechRecord } from "./speech";
import { Viewer } from "./viewer";
import { type Quality, qualityOf } from "./viewport";

const STREAMS = "feedback,audio,sound,frames,pictures,board";
const FILM_STREAMS = "audio,frames,pictures";

/** Asked for by a socket of its own, while its overlay is shown. */
const STEPS_STREAMS = "steps";

/** The state of the page as browser tests read it, from `window.viewer`; nothing in it can be changed. */
export interface ViewerState {
  readonly quality: Quality;
  readonly connected: boolean;
  /** Number of frames whose time has come, over all characters. */
  readonly framesPlayed: number;
  /** Realizer time of the newest frame shown, s. */
  readonly lastFrameTime: number | null;
  readonly feedbackCount: number;
  /** The last utterances, oldest first. */
  readonly speech: SpeechRecord[];
  /** World position of a bone, m. */
  bone(characterId: string, name: string): Position | null;
  /** Present weight of a morph. */
  morph(characterId: string, name: string): number | null;
  /** Number of footprints shown, of which the last may be one that is not made yet. */
  footprints(characterId: string): number;
}

declare global {
  interface Window {
    viewer?: ViewerState;
    /** Instead of the viewer, for the pictures of a video. */
    film?: Film;
  }
}

function socketAddress(streams: string): URL {
  const address = new URL("ws", document.baseURI);
  address.protocol = address.protocol.replace("http", "ws");
  address.search = new URLSearchParams({ streams }).toString();
  return address;
}

function stateOf(viewer: Viewer, steps: StepsPanel): ViewerState {
  return Object.freeze({
    quality: viewer.quality,
    get connected() {
      return viewer.connection.connected;
    },
    get framesPlayed() {
      return viewer.characters.framesPlayed;
    },
    get lastFrameTime() {
      return viewer.characters.lastFrameTime;
    },
    get feedbackCount() {
      return viewer.feedback.count;
    },
    get speech() {
      return viewer.speech.records;
    },
    bone: (characterId: string, name: string) => viewer.characters.bone(characterId, name),
    morph: (characterId: string, name: string) => viewer.characters.morph(characterId, name),
    footprints: (characterId: string) => steps.footprints(characterId),
  });
}

function startViewer(status: StatusPanel): void {
  makeTabs(["feedback-tab", "pegs-tab"]);
  const viewer = new Viewer(socketAddress(STREAMS), qualityOf(location.href), status);
  const steps = new StepsPanel(socketAddress(STEPS_STREAMS), viewer.scene);
  window.viewer = stateOf(viewer, steps);
  viewer.start();
}

const status = new StatusPanel();
try {
  const shot = shotOf(location.href);
  if (shot === null) startViewer(status);
  else window.film = new Film(socketAddress(FILM_STREAMS), qualityOf(location.href), shot);
} catch (error) {
  // Most likely the browser has no WebGL 2.
  status.failed(error);
  throw error;
}
