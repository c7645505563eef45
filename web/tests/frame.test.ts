import { describe, expect, it } from "vitest";

import { decodeFrame } from "../src/frame";
import { encodeFrame } from "./frames";

describe("a binary frame", () => {
  it("is read field by field, little-endian, with w first on the wire and last in the pose", () => {
    // Written out by hand from the layout, so that reader and writer cannot be wrong together.
    const bytes = [1, 1, 2, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f, 1, 0, 2, 0];
    bytes.push(0, 0, 0, 0x3f, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0);
    bytes.push(0xff, 0x7f, 0x01, 0x80, 0, 0, 0, 0x40, 0xff, 0xff, 0, 0);
    const frame = decodeFrame(new Uint8Array(bytes).buffer);
    expect(frame.character).toBe(2);
    expect(frame.sequence).toBe(7);
    expect(frame.time).toBe(1.5);
    expect([...frame.root]).toEqual([0.5, 1, -2]);
    expect(frame.rotations[0]).toBe(-1);
    expect(frame.rotations[1]).toBe(0);
    expect(frame.rotations[2]).toBeCloseTo(0.5, 4);
    expect(frame.rotations[3]).toBe(1);
    expect([...frame.weights]).toEqual([1, 0]);
  });

  it("may have neither joints nor morphs", () => {
    const frame = decodeFrame(encodeFrame({ time: 0.02, rotations: [], weights: [] }));
    expect(frame.time).toBe(0.02);
    expect(frame.rotations).toHaveLength(0);
    expect(frame.weights).toHaveLength(0);
  });

  it("is refused when its header is not whole", () => {
    expect(() => decodeFrame(new ArrayBuffer(31))).toThrow("31 bytes");
  });

  it("is refused when its kind or version is unknown", () => {
    const data = encodeFrame({});
    new DataView(data).setUint8(1, 2);
    expect(() => decodeFrame(data)).toThrow("kind 1 version 2");
  });

  it("is refused when its length is not that of its counts", () => {
    const data = encodeFrame({});
    expect(() => decodeFrame(data.slice(0, -2))).toThrow(`instead of ${data.byteLength}`);
  });
});
