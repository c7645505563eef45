import { describe, expect, it } from "vitest";

import { modeBlock, pushFrom, resetBlock, type Side } from "../src/physics";

/** The class and the replacement group of each controller in a block. */
function controllers(block: string): Record<string, string> {
  const found = block.matchAll(/ class="(\w+)"[^>]*><bmlt:parameter name="replacementgroup" value="(\w+)"/g);
  return Object.fromEntries([...found].map(([, kind = "", group = ""]): [string, string] => [group, kind]));
}

describe("the block that turns physics on", () => {
  it("has the legs balance and both arms hang", () => {
    const block = modeBlock("p1", "alice", "on", null);
    expect(controllers(block)).toEqual({
      legs: "BalanceController",
      leftarm: "CompoundController",
      rightarm: "CompoundController",
    });
    expect(block).not.toContain("interrupt");
  });

  it("is for the character, whatever its name is", () => {
    expect(modeBlock("p1", 'a"&<b', "on", null)).toContain('characterId="a&quot;&amp;&lt;b"');
  });

  it("ends the block before it", () => {
    expect(modeBlock("p2", "alice", "on", "p1")).toContain('<bmla:interrupt id="former" target="p1"/>');
  });
});

it("the block that turns physics off takes the place of the same controllers", () => {
  const none = { legs: "NoController", leftarm: "NoController", rightarm: "NoController" };
  expect(controllers(modeBlock("p1", "alice", "off", null))).toEqual(none);
});

it("the block that leaves physics to others only ends the block before it", () => {
  const block = modeBlock("p2", "alice", "bml", "p1");
  expect(controllers(block)).toEqual({});
  expect(block).toContain('target="p1"');
});

it("the block that puts a character back replaces all others", () => {
  expect(resetBlock("p1", "alice")).toContain('composition="REPLACE"');
});

describe("a push", () => {
  const sides: Side[] = ["front", "back", "left", "right"];

  it("moves a character that faces the viewer away from the side that it comes from", () => {
    const forces = sides.map((side) => pushFrom(side, "alice", [0, 0, 1], 20).force.map((f) => Math.round(f) + 0));
    expect(forces).toEqual([
      [0, 0, -100],
      [0, 0, 100],
      [-100, 0, 0],
      [100, 0, 0],
    ]);
  });

  it("turns with the character", () => {
    const forces = sides.map((side) => pushFrom(side, "alice", [1, 0, 0], 20).force.map((f) => Math.round(f) + 0));
    expect(forces).toEqual([
      [-100, 0, 0],
      [100, 0, 0],
      [0, 0, 100],
      [0, 0, -100],
    ]);
  });

  it("has the impulse that is asked for", () => {
    const { force, duration } = pushFrom("left", "alice", [0.6, 0, 0.8], 15);
    expect(Math.hypot(...force) * duration).toBeCloseTo(15);
  });
});
