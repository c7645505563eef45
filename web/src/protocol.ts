/* eslint-disable */
/**
 * The messages of the socket, made from the server's protocol.json by `npm run types`: change that, not this.
 */

/**
 * The text messages of the socket (GET /ws), protocol 2. Times are in seconds of realizer time, positions in meters in the world's frame: right-handed, y up. Unknown fields must be ignored.
 */
export type Message = ClientMessage | ServerMessage;
/**
 * A message of a client. If it has a ref, the answer is accepted or error with the same ref.
 */
export type ClientMessage =
  Bml | Predict | Event | Ping | Clock | Camera | WorldChange | Heard | Push | SpeechAudio | Demo;
/**
 * Chosen by the client, and repeated in the answer.
 */
export type Ref = string | number;
/**
 * Predicts a point of an anticipator: at a time, after a number of seconds from now or, if time is null, unknown again.
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
 * w, x, y, z of a rotation from the axes of a thing to those of the world; of any length but 0.
 *
 * @minItems 4
 * @maxItems 4
 */
export type Quaternion = [number, number, number, number];
/**
 * A part of a sync reference: 1 to 200 characters, no white space, control character, colon, plus sign or half of a surrogate pair.
 */
export type Name1 = string;
/**
 * A word and its start, s.
 *
 * @minItems 2
 */
export type TimedWord = never[];
/**
 * A message of the server. The first one is hello.
 */
export type ServerMessage =
  | Hello
  | Feedback
  | Pong
  | ClockAnswer
  | AudioStart
  | Caption
  | AudioMove
  | AudioGain
  | AudioStop
  | Board
  | Steps
  | Targets
  | Pictures
  | Accepted
  | Refused;
/**
 * The start of a word, s from the start of the sound, and its place in the text, in Unicode characters: of its first one, and after its last one.
 *
 * @minItems 3
 * @maxItems 3
 */
export type CaptionedWord = [number, number, number];
/**
 * The name of a peg, and its times before and after.
 *
 * @minItems 3
 * @maxItems 3
 */
export type Change = [string, number | null, number | null];
/**
 * x and z of a point on the ground, in meters.
 *
 * @minItems 2
 * @maxItems 2
 */
export type Spot = [number, number];
/**
 * In answers to bml: the ids of the accepted blocks, in order; empty if no block could be read or accepted.
 */
export type Entered = string[];
/**
 * In answers to bml: the warnings, in the order of the document.
 */
export type Warnings = Warning[];
/**
 * In answers to bml: the number of warnings above the limit, which are not listed.
 */
export type MoreWarnings = number;

/**
 * A document with one or more blocks, in BML or another dialect: that of its media type, or else the one that its content shows. Each acceptable block is accepted, regardless of the others. Feedback reports every rejected block, and error reports the first. The answer lists the accepted blocks.
 */
export interface Bml {
  type: "bml";
  xml: string;
  mediaType?: string;
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
 * An event from which an anticipator makes predictions, with an optional value. If it is words, text contains them, and value is ignored.
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
 * Requests the realizer time.
 */
export interface Clock {
  type: "clock";
  ref?: Ref;
}
/**
 * The position of the page's camera. It moves the target camera.
 */
export interface Camera {
  type: "camera";
  position: Position;
  ref?: Ref;
}
/**
 * New positions of targets; null removes a target.
 */
export interface WorldChange {
  type: "world";
  set: {
    [k: string]: Position | Placed | null;
  };
  ref?: Ref;
}
/**
 * Where a target with an orientation is.
 */
export interface Placed {
  position: Position;
  orientation: Quaternion;
}
/**
 * Reports what is heard of a sound: which position of it (s), at the moment at which the frames of a time are shown. One client leads each sound; the reports of others have no effect.
 */
export interface Heard {
  type: "heard";
  id: string;
  position: number;
  time: Seconds;
  ref?: Ref;
}
/**
 * Pushes a character at a segment of its body: with a force (N, in the axes of the world), for a duration (s). It gives way only where controllers move it by forces.
 */
export interface Push {
  type: "push";
  character: string;
  /**
   * Joint of the segment, or within it, such as vt10.
   */
  joint: string;
  /**
   * @minItems 3
   * @maxItems 3
   */
  force: [number, number, number];
  duration: number;
  ref?: Ref;
}
/**
 * Sound of a speech whose description is a stream: mono PCM, 16 bits, little-endian, at the rate of the stream, in base64. It may be cut anywhere.
 */
export interface SpeechAudio {
  type: "speech";
  stream: Name1;
  audio?: string;
  /**
   * Further words of the text, in its order, each with its start, s from the start of the stream.
   *
   * @maxItems 10000
   */
  words?: TimedWord[];
  /**
   * Whether nothing follows.
   */
  end?: boolean;
  ref?: Ref;
}
/**
 * Restarts the performance of the demo.
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
 * A virtual human of the scene. Its joints and morphs are those of the avatar, in the order of its frames; the last morphs are the colors of its skin, skinBlush and skinPallor.
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
  /**
   * Where the morph targets are that a loader of glTF does not find by the names of its meshes' morph targets (extras.targetNames): name of a morph -> indices of meshes and of their targets, which all take its weight.
   */
  targets?: {
    [k: string]: MorphTarget[];
  };
}
/**
 * A morph target of a GLB file: the index of its mesh among the meshes of the file, and its own in that mesh.
 */
export interface MorphTarget {
  mesh: number;
  target: number;
}
/**
 * A message of BML feedback, with the time of the tick that reported it.
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
 * A sound that starts to play at start, announced before that or later; null while the start is unknown.
 */
export interface AudioStart {
  type: "audio";
  character: string;
  id: string;
  /**
   * URL of a WAV file.
   */
  url: string;
  start: Seconds | null;
  duration: number;
  /**
   * 1 is as recorded.
   */
  gain: number;
}
/**
 * The text of a speech, to be read while it is heard. Its id is that of the sound, if the speech has one; moves, gains and stops with this id are about both.
 */
export interface Caption {
  type: "caption";
  character: string;
  id: string;
  text: string;
  words: CaptionedWord[];
  start: Seconds | null;
  duration: number;
  /**
   * 1 is as recorded.
   */
  gain: number;
}
/**
 * A new start time of a sound, or of a caption; frames show it from the given time on.
 */
export interface AudioMove {
  type: "audio_move";
  id: string;
  start: Seconds;
  time: Seconds;
}
/**
 * A new gain of a sound from time on; at most one per tick and sound.
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
 * Fades a sound to silence from time on, within fade seconds.
 */
export interface AudioStop {
  type: "audio_stop";
  id: string;
  time: Seconds;
  fade: number;
}
/**
 * The board, and its commits since the previous message. Sent after changes to clients that request the stream board.
 */
export interface Board {
  type: "board";
  time: Seconds;
  pegs: Peg[];
  commits: Commit[];
}
/**
 * A peg of the board; source is the rule by which its time follows from other pegs.
 */
export interface Peg {
  key: string;
  time: number | null;
  state: "pinned" | "moving" | "unknown";
  source: string;
}
/**
 * A commit of the board: its time and cause, and each peg that it moved.
 */
export interface Commit {
  sequence: number;
  time: Seconds;
  cause: string;
  changes: Change[];
}
/**
 * The path of a character from where it is to where it goes, straight between points, and the prints of its feet. Sent while they change to clients that request the stream steps; both are empty for a character that stands.
 */
export interface Steps {
  type: "steps";
  time: Seconds;
  character: string;
  path: Spot[];
  prints: Footprint[];
}
/**
 * A print below the ankle of a foot, and where the foot points, in degrees to the left of +z. It is not made yet while the foot is on its way there.
 */
export interface Footprint {
  side: "left" | "right";
  position: Spot;
  heading: number;
  made: boolean;
}
/**
 * Where targets are, null for those that are gone, and where characters stand: all at first, then what has changed. Sent to clients that request the stream world.
 */
export interface Targets {
  type: "targets";
  time: Seconds;
  targets: {
    [k: string]: Position | Placed | null;
  };
  characters: {
    [k: string]: Standing;
  };
}
/**
 * Where a character stands, and where it faces, in degrees to the left of +z.
 */
export interface Standing {
  position: Position;
  heading: number;
}
/**
 * The pictures that show a character in place of its body, from the lowest to the uppermost, until the next message about it; GET /pictures/FILE. Without any, it is shown by its body. Sent to clients that request the stream pictures: first those of all characters, then what has changed.
 */
export interface Pictures {
  type: "pictures";
  time: Seconds;
  character: string;
  files: string[];
}
/**
 * The message with this ref has taken effect; feedback reports its results.
 */
export interface Accepted {
  type: "accepted";
  ref: Ref;
  blocks?: Entered;
  warnings?: Warnings;
  more_warnings?: MoreWarnings;
}
/**
 * A mistake in a document, or a part of it that this scene cannot play, as far as it is known at once. Feedback warns of it too.
 */
export interface Warning {
  /**
   * Of a block, block:behavior, or bml if no block could be read.
   */
  id: string;
  /**
   * Of the warningFeedback.
   */
  type: string;
  /**
   * One of the error codes.
   */
  code: string;
  /**
   * Of the start tag in the document, from 1.
   */
  line?: number;
  /**
   * Of the start tag, from 1.
   */
  column?: number;
  message: string;
}
/**
 * A message, or a part of a bml message, was rejected; code is one of the error codes.
 */
export interface Refused {
  type: "error";
  ref?: Ref;
  code: string;
  message: string;
  blocks?: Entered;
  warnings?: Warnings;
  more_warnings?: MoreWarnings;
}
