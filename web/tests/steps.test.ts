import { Mesh, Object3D } from "three";
import { expect, test } from "vitest";

import type { Footprint, Steps } from "../src/protocol";
import { StepsOverlay, Trail } from "../src/steps";

function print(side: "left" | "right", z: number, made = true, heading = 0): Footprint {
  return { side, position: [side === "left" ? 0.1 : -0.1, z], heading, made };
}

function steps(prints: Footprint[], path: [number, number][] = []): Steps {
  return { type: "steps", time: 0, character: "alice", path, prints };
}

test("prints stay, and each is shown once however often it is reported", () => {
  const trail = new Trail();
  trail.take([print("left", 0), print("right", 0)]);
  trail.take([print("left", 0), print("right", 0.6, false)]);
  trail.take([print("left", 0), print("right", 0.6)]);
  trail.take([print("left", 1.2, false), print("right", 0.6)]);
  expect(trail.prints.map(({ side, position: [, z], made }) => [side, z, made])).toEqual([
    ["left", 0, true],
    ["right", 0, true],
    ["right", 0.6, true],
    ["left", 1.2, false],
  ]);
});

test("a foot that turns on the spot makes another print, also across 180 degrees", () => {
  const trail = new Trail();
  trail.take([print("left", 0, true, 179.5)]);
  trail.take([print("left", 0, true, -179.5)]);
  expect(trail.prints).toHaveLength(1);
  trail.take([print("left", 0, true, -140)]);
  expect(trail.prints).toHaveLength(2);
});

test("older prints are fainter, one that is not made yet is faint, and only the last thirty stay", () => {
  const trail = new Trail();
  for (let step = 0; step < 40; step++) trail.take([print("left", step)]);
  trail.take([print("left", 40, false)]);
  const shown = trail.prints;
  expect(shown).toHaveLength(31);
  const opacities = shown.slice(0, -1).map(({ opacity }) => opacity);
  expect(opacities).toEqual([...opacities].sort());
  expect(shown.at(-1)?.opacity).toBeLessThan(opacities.at(-1) ?? 0);
});

test("the overlay draws soles where the prints are, and a path while there is one", () => {
  const scene = new Object3D();
  const overlay = new StepsOverlay(scene);
  overlay.take(
    steps(
      [print("left", 0), print("right", 0.5, false, 90)],
      [
        [0, 0],
        [0, 2],
      ],
    ),
  );
  expect(overlay.count).toBe(2);
  const [path, ...soles] = scene.children;
  expect(path).toBeInstanceOf(Mesh);
  expect(soles.map(({ position }) => [position.x, position.z])).toEqual([
    [0.1, 0],
    [-0.1, 0.5],
  ]);
  expect(soles[1]?.rotation.y).toBeCloseTo(Math.PI / 2);
  overlay.take(steps([]));
  expect(scene.children).toEqual(soles.slice(0, 1));
  overlay.remove();
  expect(scene.children).toEqual([]);
});
