/** What a test wants of a frame; the rest is a joint at rest and a morph of weight 0. */
export interface FrameFields {
  time?: number;
  root?: [number, number, number];
  /** w x y z each. */
  rotations?: [number, number, number, number][];
  weights?: number[];
}

/** Writes a frame as the server does. */
export function encodeFrame({
  time = 0,
  root = [0, 0, 0],
  rotations = [[1, 0, 0, 0]],
  weights = [0],
}: FrameFields): ArrayBuffer {
  const data = new ArrayBuffer(32 + 8 * rotations.length + 2 * weights.length);
  const view = new DataView(data);
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setFloat64(8, time, true);
  view.setUint16(16, rotations.length, true);
  view.setUint16(18, weights.length, true);
  root.forEach((value, axis) => {
    view.setFloat32(20 + 4 * axis, value, true);
  });
  rotations.flat().forEach((value, i) => {
    view.setInt16(32 + 2 * i, Math.round(value * 32767), true);
  });
  weights.forEach((value, i) => {
    view.setUint16(32 + 8 * rotations.length + 2 * i, Math.round(value * 65535), true);
  });
  return data;
}

/** Joins frames to a message. */
export function joined(frames: ArrayBuffer[]): ArrayBuffer {
  const bytes = frames.flatMap((frame) => [...new Uint8Array(frame)]);
  return new Uint8Array(bytes).buffer;
}
