import { beforeEach, describe, expect, it } from "vitest";

import { Follow } from "../src/follow";
import type { Position } from "../src/protocol";

describe("the camera", () => {
  let follow: Follow;
  let page: number;

  /** Whether the camera followed at each of some roots of one character, 20 ms apart. */
  function followed(...roots: Position[]): boolean[] {
    return roots.map((root) => follow.update((page += 20), [root], false));
  }

  /** The same of a camera that is close to the head. */
  function followedClosely(...roots: Position[]): boolean[] {
    return roots.map((root) => follow.update((page += 20), [root], true));
  }

  /** A second of rest. */
  function resting(root: Position): Position[] {
    return Array<Position>(50).fill(root);
  }

  beforeEach(() => {
    follow = new Follow();
    page = 0;
    followed(...resting([0, 0.9, 0]));
  });

  it("shows characters that have appeared", () => {
    expect(new Follow().update(0, [[0, 0.9, 0]], false)).toBe(true);
  });

  it("follows who rises, whose head would be cut", () => {
    const seated = new Follow();
    seated.update(0, [[0, 0.45, 0]], false);
    seated.update(1000, [[0, 0.45, 0]], false);
    expect(seated.update(1020, [[0, 0.6, 0]], false)).toBe(true);
  });

  it("follows who sits down when it is close to the head", () => {
    expect(followedClosely([0.05, 0.9, 0], [0, 0.85, 0], [0, 0.7, 0])).toEqual([false, false, true]);
  });

  it("does not follow who sways, bows or sits down", () => {
    expect(followed([0.1, 0.9, 0], [0, 0.8, 0.3], [0, 0.45, -0.3])).not.toContain(true);
  });

  it("follows who falls until rest", () => {
    const way = followed([0, 0.6, 0.3], [0, 0.4, 0.45], [0, 0.2, 0.6], [0, 0.1, 0.7]);
    expect(way).toEqual([false, true, true, true]);
    const rest = followed(...resting([0, 0.1, 0.7]));
    expect(rest[0]).toBe(true);
    expect(rest.at(-1)).toBe(false);
  });

  it("follows who collapses, and who returns", () => {
    expect(followed([0, 0.5, 0], [0, 0.2, 0])).toEqual([false, true]);
    followed(...resting([0, 0.2, 0]));
    expect(followed([0, 0.25, 0], [0, 0.5, 0], [0, 0.9, 0])).toEqual([false, true, true]);
  });
});
