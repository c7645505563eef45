import { describe, expect, it } from "vitest";

import { decodeFrames } from "../src/binary";
import { Playout } from "../src/playout";
import { encodeFrame, type FrameFields } from "./frames";

function playoutOf(...frames: FrameFields[]): Playout {
  const playout = new Playout();
  for (const frame of frames) for (const decoded of decodeFrames(encodeFrame(frame))) playout.push(decoded);
  return playout;
}

/** Frames 20 ms apart whose weight counts them in hundredths. */
function counted(count: number): FrameFields[] {
  return Array.from({ length: count }, (_, i) => ({ time: 0.02 * i, weights: [0.01 * i] }));
}

const QUARTER_TURN: [number, number, number, number] = [Math.SQRT1_2, 0, Math.SQRT1_2, 0];

describe("the playout buffer", () => {
  it("has no pose before any frame came", () => {
    expect(new Playout().sample(1)).toBeNull();
  });

  it("turns evenly between two frames, along the arc", () => {
    const playout = playoutOf({ time: 1 }, { time: 1.02, rotations: [QUARTER_TURN] });
    const pose = playout.sample(1.01);
    expect(pose?.rotations[1]).toBeCloseTo(Math.sin(Math.PI / 8), 4);
    expect(pose?.rotations[3]).toBeCloseTo(Math.cos(Math.PI / 8), 4);
  });

  it("turns the short way when the next quaternion has the other sign", () => {
    const playout = playoutOf({ time: 1 }, { time: 1.02, rotations: [[-1, 0, 0, 0]] });
    expect(Math.abs(playout.sample(1.01)?.rotations[3] ?? 0)).toBeCloseTo(1, 4);
  });

  it("moves root and weights evenly between two frames", () => {
    const playout = playoutOf({ time: 1, root: [0, 1, 0] }, { time: 1.02, root: [0, 2, 4], weights: [1] });
    const pose = playout.sample(1.005);
    expect([...(pose?.root ?? [])]).toEqual([0, 1.25, 1]);
    expect(pose?.weights[0]).toBeCloseTo(0.25, 4);
  });

  it("holds the last pose when no further frame has come", () => {
    const playout = playoutOf(...counted(3));
    expect(playout.sample(0.5)?.weights[0]).toBeCloseTo(0.02, 4);
    expect(playout.sample(9)?.weights[0]).toBeCloseTo(0.02, 4);
  });

  it("shows the first pose while its time is still ahead", () => {
    const playout = playoutOf({ time: 5, weights: [1] }, { time: 5.02 });
    expect(playout.sample(1)?.weights[0]).toBe(1);
    expect(playout.played).toBe(0);
  });

  it("goes on from the held pose when frames come again", () => {
    const playout = playoutOf({ time: 0 });
    playout.sample(0.5);
    for (const frame of decodeFrames(encodeFrame({ time: 1, weights: [1] }))) playout.push(frame);
    expect(playout.sample(0.75)?.weights[0]).toBeCloseTo(0.75, 4);
  });

  it("leaves out a frame that is not newer than the last", () => {
    const playout = playoutOf({ time: 1 }, { time: 2, weights: [1] }, { time: 2, weights: [0.5] }, { time: 1.5 });
    expect(playout.sample(2)?.weights[0]).toBe(1);
  });

  it("drops the oldest frames when nobody samples", () => {
    const playout = playoutOf(...counted(101));
    expect(playout.sample(0)?.weights[0]).toBeCloseTo(0.01, 4);
  });

  it("counts every frame whose time has come, those passed over too, once", () => {
    const playout = playoutOf(...counted(10));
    playout.sample(0.05);
    expect(playout.played).toBe(3);
    playout.sample(0.05);
    expect(playout.played).toBe(3);
    playout.sample(1);
    expect(playout.played).toBe(10);
    expect(playout.lastTime).toBeCloseTo(0.18, 9);
  });

  it("shows the face of another time than the body", () => {
    const playout = playoutOf(
      ...counted(30).map((frame, i) => ({ ...frame, root: [i, 0, 0] as [number, number, number] })),
    );
    const pose = playout.sample(0.4, 0.15);
    expect(pose?.root[0]).toBeCloseTo(20, 4);
    expect(pose?.weights[0]).toBeCloseTo(0.075, 4);
  });
});
