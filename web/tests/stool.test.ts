import { Object3D } from "three";
import { describe, expect, it } from "vitest";

import { type Leg, seatOf, Stool } from "../src/stool";

const STANDING: Leg = { hip: [0.1, 0.9, 0], knee: [0.1, 0.48, 0.02], ankle: [0.1, 0.08, 0] };
const SITTING: Leg = { hip: [0.1, 0.52, 0], knee: [0.1, 0.5, 0.42], ankle: [0.1, 0.09, 0.4] };
const CROUCHING: Leg = { hip: [0.1, 0.36, -0.15], knee: [0.25, 0.42, 0.2], ankle: [0.15, 0.09, 0.02] };
const LYING: Leg = { hip: [0.1, 0.12, 0], knee: [0.1, 0.12, 0.42], ankle: [0.1, 0.1, 0.84] };

describe("the stool", () => {
  it("stands under who sits, below the hips", () => {
    const seat = seatOf([SITTING, SITTING]);
    expect(seat?.shown).toBe(1);
    expect(seat?.place[1]).toBeCloseTo(0.432);
    expect(seat?.place[2]).toBeGreaterThan(0);
  });

  it.each([
    ["stands", STANDING],
    ["crouches", CROUCHING],
    ["lies", LYING],
  ])("is absent from who %s", (_, leg) => {
    expect(seatOf([leg, leg])).toBeNull();
  });

  it("is absent from who has no legs of known names", () => {
    expect(seatOf([])).toBeNull();
  });

  it("fades in while somebody sits down", () => {
    const half: Leg = { hip: [0.1, 0.64, -0.1], knee: [0.1, 0.48, 0.22], ankle: [0.1, 0.08, 0.15] };
    expect(seatOf([half])?.shown).toBeGreaterThan(0);
    expect(seatOf([half])?.shown).toBeLessThan(1);
  });

  it("is absent while somebody has hardly begun to sit down, and is no higher than for one who sits", () => {
    const begun: Leg = { hip: [0.1, 0.75, -0.1], knee: [0.1, 0.48, 0.22], ankle: [0.1, 0.08, 0.15] };
    expect(seatOf([begun])).toBeNull();
    const nearly: Leg = { hip: [0.1, 0.6, -0.1], knee: [0.1, 0.5, 0.22], ankle: [0.1, 0.09, 0.2] };
    expect(seatOf([nearly])?.place[1]).toBeCloseTo(0.442);
  });

  it("is taken out of the scene with its figure", () => {
    const scene = new Object3D();
    const stool = new Stool(scene, "low");
    stool.show(seatOf([SITTING]));
    expect(scene.children).toHaveLength(3);
    stool.show(null);
    expect(scene.children).toHaveLength(0);
  });
});
