/* eslint-disable */
/**
 * The messages of the socket, made from the server's protocol.json by `npm run types`: change that, not this.
 */

/**
 * What travels as text on the socket (GET /ws), protocol 1. Times are seconds of realizer time, positions meters in the world's frame: right-handed, y up. Unknown fields are to be ignored.
 */
export type Message = ClientMessage | ServerMessage;
/**
 * From a client. One that carries a ref is answered by accepted or error with the same ref.
 */
export type ClientMessage = Bml | Predict | Event | Ping | Clock | Camera | WorldChange | Demo;
/**
 * Chosen by the client; comes back with the answer.
 */
export type Ref = string | number;
/**
 * When a point of an anticipator is now said to be: at a time, in so many seconds from now, or, with time null, unknown again.
 */
export type Predict = Predict1 & Predict2;
export type Predict1 = {
  [k: string]: unknown;
};
/**
 * A part of a sync reference: 1 to 200 characters, no white space, control character, colon, plus sign or half of a surrogate pair.
 */
export type Name = string;
export type Seconds = number;
/**
 * x, y, z in meters.
 *
 * @minItems 3
 * @maxItems 3
 */
export type Position = [number, number, number];
/**
 * From the server; the first one is hello.
 */
export type ServerMessage =
  Hello | Feedback | Pong | ClockAnswer | AudioStart | AudioMove | AudioGain | AudioStop | Board | Accepted | Refused;
/**
 * Name of a peg, its time before and after.
 *
 * @minItems 3
 * @maxItems 3
 */
export type Change = [string, number | null, number | null];
/**
 * In answers to bml: the ids of the blocks that entered, in order; none where nothing could be read.
 */
export type Entered = string[];

/**
 * A BML document of one or more blocks. Blocks that can be accepted enter, whatever the others are; of those, feedback tells each and error the first. The answer lists the blocks that entered.
 */
export interface Bml {
  type: "bml";
  xml: string;
  ref?: Ref;
}
export interface Predict2 {
  type: "predict";
  anticipator: Name;
  sync: Name;
  time?: Seconds | null;
  in?: Seconds;
  ref?: Ref;
}
/**
 * Something that an anticipator makes predictions from happened, was set to a value, or was said: then text has the words, and value means nothing.
 */
export interface Event {
  type: "event";
  anticipator: Name;
  event: Name;
  value?: number;
  text?: string;
  ref?: Ref;
}
export interface Ping {
  type: "ping";
  t: number;
  ref?: Ref;
}
/**
 * Asks for realizer time.
 */
export interface Clock {
  type: "clock";
  ref?: Ref;
}
/**
 * Where the page's camera is: it moves the target camera.
 */
export interface Camera {
  type: "camera";
  position: Position;
  ref?: Ref;
}
/**
 * Where targets are now; null removes one.
 */
export interface WorldChange {
  type: "world";
  set: {
    [k: string]: Position | null;
  };
  ref?: Ref;
}
/**
 * Plays the performance of the demo from its beginning.
 */
export interface Demo {
  type: "demo";
  ref?: Ref;
}
/**
 * The first message of every connection. A session is one run of a realizer; seq counts within it.
 */
export interface Hello {
  type: "hello";
  protocol: number;
  version: string;
  session: string;
  time: Seconds;
  tick: number;
  characters: Character[];
  /**
   * Whether there is a performance to play.
   */
  demo?: boolean;
}
/**
 * One virtual human of the scene; joints and morphs are the avatar's own, in the order of its frames.
 */
export interface Character {
  id: string;
  index: number;
  /**
   * URL of a GLB file.
   */
  avatar: string;
  joints: string[];
  morphs: string[];
}
/**
 * A message of BML feedback, with the time of the tick that reported.
 */
export interface Feedback {
  type: "feedback";
  session: string;
  seq: number;
  time: Seconds;
  xml: string;
}
/**
 * Answers a ping with its own t and realizer time.
 */
export interface Pong {
  type: "pong";
  t: number;
  time: Seconds;
}
export interface ClockAnswer {
  type: "clock";
  time: Seconds;
}
/**
 * A sound that begins at start, told before or while it does.
 */
export interface AudioStart {
  type: "audio";
  character: string;
  id: string;
  /**
   * URL of a WAV file.
   */
  url: string;
  start: Seconds;
  duration: number;
  /**
   * 1 is as recorded.
   */
  gain: number;
}
/**
 * A sound is to begin at another time.
 */
export interface AudioMove {
  type: "audio_move";
  id: string;
  start: Seconds;
}
/**
 * A sound has another gain from time on; at most one such message a tick and sound.
 */
export interface AudioGain {
  type: "audio_gain";
  id: string;
  /**
   * 1 is as recorded.
   */
  gain: number;
  time: Seconds;
}
/**
 * A sound falls silent from time on, within fade seconds.
 */
export interface AudioStop {
  type: "audio_stop";
  id: string;
  time: Seconds;
  fade: number;
}
/**
 * The board and its commits since the last such message; for clients that ask for the stream board, when something changed.
 */
export interface Board {
  type: "board";
  time: Seconds;
  pegs: Peg[];
  commits: Commit[];
}
/**
 * A peg of the board; source says what it hangs on.
 */
export interface Peg {
  key: string;
  time: number | null;
  state: "pinned" | "moving" | "unknown";
  source: string;
}
/**
 * A transaction of the board: at which tick, what for, and each peg that it moved.
 */
export interface Commit {
  sequence: number;
  time: Seconds;
  cause: string;
  changes: Change[];
}
/**
 * The message with this ref has entered; what comes of it is told in feedback.
 */
export interface Accepted {
  type: "accepted";
  ref: Ref;
  blocks?: Entered;
}
/**
 * A message, or part of a bml message, was refused; code is one of the table of errors.
 */
export interface Refused {
  type: "error";
  ref?: Ref;
  code: string;
  message: string;
  blocks?: Entered;
}
