import { describe, expect, it } from "vitest";

import { decode, decodeFrames } from "../src/binary";
import { encodeFrame, joined } from "./frames";

describe("a binary message", () => {
  it("with a sound has its id and a WAV file", () => {
    const message = decode(new Uint8Array([2, 1, 2, 0, 0xc3, 0xa9, 82, 73]).buffer);
    expect(message).toMatchObject({ kind: "sound", id: "é" });
    expect(message.kind === "sound" && [...new Uint8Array(message.wav)]).toEqual([82, 73]);
  });

  it("with a sound is refused when its id is not whole", () => {
    expect(() => decode(new Uint8Array([2, 1, 2, 0, 65]).buffer)).toThrow("5 bytes");
  });
});

describe("a binary frame", () => {
  it("is read field by field, little-endian, with w first on the wire and last in the pose", () => {
    // Written out by hand from the layout, so that reader and writer cannot be wrong together.
    const bytes = [1, 1, 2, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f, 1, 0, 2, 0];
    bytes.push(0, 0, 0, 0x3f, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0);
    bytes.push(0xff, 0x7f, 0x01, 0x80, 0, 0, 0, 0x40, 0xff, 0xff, 0, 0);
    const [frame] = decodeFrames(new Uint8Array(bytes).buffer);
    expect(frame?.character).toBe(2);
    expect(frame?.sequence).toBe(7);
    expect(frame?.time).toBe(1.5);
    expect([...(frame?.root ?? [])]).toEqual([0.5, 1, -2]);
    expect(frame?.rotations[0]).toBe(-1);
    expect(frame?.rotations[1]).toBe(0);
    expect(frame?.rotations[2]).toBeCloseTo(0.5, 4);
    expect(frame?.rotations[3]).toBe(1);
    expect([...(frame?.weights ?? [])]).toEqual([1, 0]);
  });

  it("may have neither joints nor morphs", () => {
    const [frame] = decodeFrames(encodeFrame({ time: 0.02, rotations: [], weights: [] }));
    expect(frame?.time).toBe(0.02);
    expect(frame?.rotations).toHaveLength(0);
    expect(frame?.weights).toHaveLength(0);
  });

  it("is refused when its header is not whole", () => {
    expect(() => decodeFrames(new ArrayBuffer(31))).toThrow("31 bytes");
  });

  it("is refused when its kind or version is unknown", () => {
    const data = encodeFrame({});
    new DataView(data).setUint8(1, 2);
    expect(() => decodeFrames(data)).toThrow("kind 1 version 2");
  });

  it("is refused when its length is not that of its counts", () => {
    const data = encodeFrame({});
    expect(() => decodeFrames(data.slice(0, -2))).toThrow(`instead of ${data.byteLength}`);
  });

  it("is one of several in a message, which differ in their counts", () => {
    const frames = [
      { time: 0.04, weights: [0, 1, 0] },
      { time: 0.04, rotations: [], weights: [] },
      { time: 0.04, root: [1, 2, 3] as [number, number, number] },
    ];
    const read = decodeFrames(joined(frames.map(encodeFrame)));
    expect(read.map(({ weights }) => weights.length)).toEqual([3, 0, 1]);
    expect([...(read[2]?.root ?? [])]).toEqual([1, 2, 3]);
  });
});
