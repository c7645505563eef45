/** Binary messages: frames with the poses of characters, and sounds. */

const FRAME = 1;
const SOUND = 2;
const SOUND_HEADER_BYTES = 4;
const VERSION = 1;
const HEADER_BYTES = 32;
const QUATERNION_BYTES = 8;
const WEIGHT_BYTES = 2;
const QUATERNION_SCALE = 32767;
const WEIGHT_SCALE = 65535;

/** A pose of the avatar's own bones, in the order of the character's `joints` and `morphs`. */
export interface Pose {
  /** HumanoidRoot in the world, m. */
  root: Float32Array;
  /** Local rotations, x y z w each (the order of three.js; the wire has w first), 4 J numbers. */
  rotations: Float32Array;
  /** Morph weights, 0..1. */
  weights: Float32Array;
}

/** A pose with its time. */
export interface Frame extends Pose {
  /** Index of the character in `hello`. */
  character: number;
  sequence: number;
  /** Scheduled realizer time, s. */
  time: number;
}

/** A pose of this many joints and morphs, all zero. */
export function emptyPose(joints: number, morphs: number): Pose {
  return { root: new Float32Array(3), rotations: new Float32Array(4 * joints), weights: new Float32Array(morphs) };
}

/** A sound ahead of its announcement. */
export interface Sound {
  /** The id of its announcement. */
  id: string;
  /** A WAV file. */
  wav: ArrayBuffer;
}

/** A binary message: the frames of all characters at one time, or a sound. */
export type BinaryMessage = { kind: "frames"; frames: Frame[] } | ({ kind: "sound" } & Sound);

/** Reads a binary message; throws a RangeError that says what is wrong with a malformed one. */
export function decode(data: ArrayBuffer): BinaryMessage {
  if (data.byteLength > 0 && new DataView(data).getUint8(0) === SOUND) return { kind: "sound", ...decodeSound(data) };
  return { kind: "frames", frames: decodeFrames(data) };
}

function decodeSound(data: ArrayBuffer): Sound {
  const length = data.byteLength < SOUND_HEADER_BYTES ? Infinity : new DataView(data).getUint16(2, true);
  const end = SOUND_HEADER_BYTES + length;
  if (data.byteLength < end) throw new RangeError(`a sound of ${data.byteLength} bytes has no complete header`);
  return { id: new TextDecoder().decode(data.slice(SOUND_HEADER_BYTES, end)), wav: data.slice(end) };
}

/** Reads the frames of all characters. */
export function decodeFrames(data: ArrayBuffer): Frame[] {
  const frames: Frame[] = [];
  for (let offset = 0; offset < data.byteLength;) {
    const frame = decodeFrame(new DataView(data, offset));
    frames.push(frame);
    offset += frameBytes(frame.rotations.length / 4, frame.weights.length);
  }
  return frames;
}

/** Reads the frame at the beginning of a view. */
function decodeFrame(view: DataView): Frame {
  const [joints, morphs] = checkedCounts(view);
  const frame: Frame = {
    character: view.getUint16(2, true),
    sequence: view.getUint32(4, true),
    time: view.getFloat64(8, true),
    ...emptyPose(joints, morphs),
  };
  for (let axis = 0; axis < 3; axis++) frame.root[axis] = view.getFloat32(20 + 4 * axis, true);
  readRotations(view, HEADER_BYTES, frame.rotations);
  readWeights(view, HEADER_BYTES + joints * QUATERNION_BYTES, frame.weights);
  return frame;
}

function frameBytes(joints: number, morphs: number): number {
  return HEADER_BYTES + joints * QUATERNION_BYTES + morphs * WEIGHT_BYTES;
}

function checkedCounts(view: DataView): [joints: number, morphs: number] {
  if (view.byteLength < HEADER_BYTES)
    throw new RangeError(`a frame of ${view.byteLength} bytes has no complete header`);
  const kind = view.getUint8(0);
  const version = view.getUint8(1);
  if (kind !== FRAME || version !== VERSION) throw new RangeError(`unknown frame kind ${kind} version ${version}`);
  const joints = view.getUint16(16, true);
  const morphs = view.getUint16(18, true);
  const expected = frameBytes(joints, morphs);
  if (view.byteLength < expected) throw new RangeError(`a frame has ${view.byteLength} bytes instead of ${expected}`);
  return [joints, morphs];
}

function readRotations(view: DataView, offset: number, rotations: Float32Array): void {
  for (let i = 0; i < rotations.length; i += 4) {
    const at = offset + 2 * i;
    rotations[i] = view.getInt16(at + 2, true) / QUATERNION_SCALE;
    rotations[i + 1] = view.getInt16(at + 4, true) / QUATERNION_SCALE;
    rotations[i + 2] = view.getInt16(at + 6, true) / QUATERNION_SCALE;
    rotations[i + 3] = view.getInt16(at, true) / QUATERNION_SCALE;
  }
}

function readWeights(view: DataView, offset: number, weights: Float32Array): void {
  for (let i = 0; i < weights.length; i++) weights[i] = view.getUint16(offset + 2 * i, true) / WEIGHT_SCALE;
}
