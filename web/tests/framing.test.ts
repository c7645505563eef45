import { describe, expect, it } from "vitest";
import { PerspectiveCamera, Vector3 } from "three";

import { type Figure, framing, type Shot, shotOf } from "../src/framing";
import type { Position } from "../src/protocol";

const STANDING: Figure = { crown: [0, 1.7, 0], root: [0, 0.9, 0], feet: [[0.1, 0.02, 0.1]] };
const SITTING: Figure = { crown: [0, 1.25, 0.1], root: [0, 0.45, -0.1], feet: [[0.1, 0.02, 0.5]] };

/** Where a point is in the picture of a shot: 1 is its upper and its right edge. */
function seen(point: Position, shot: Shot, figures: Figure[], aspect = 16 / 9): { x: number; y: number } {
  const camera = new PerspectiveCamera(30, aspect, 0.05, 60);
  const { target, eye } = framing(shot, figures, aspect, camera.fov);
  camera.position.copy(eye);
  camera.lookAt(target);
  camera.updateMatrixWorld();
  const { x, y } = new Vector3(...point).project(camera);
  return { x, y };
}

describe("the framing", () => {
  it.each(["face", "bust", "upper", "full"] as const)("never cuts a head: %s", (shot) => {
    for (const figure of [STANDING, SITTING]) {
      const { y } = seen(figure.crown, shot, [figure]);
      expect(y).toBeLessThan(1);
      expect(y).toBeGreaterThan(0.5);
    }
  });

  it("shows a face in more than half of the height of the picture", () => {
    const chin: Position = [0, 1.47, 0];
    expect(seen(STANDING.crown, "face", [STANDING]).y - seen(chin, "face", [STANDING]).y).toBeGreaterThan(1);
  });

  it("shows the shoulders with the head", () => {
    const shoulder: Position = [0.2, 1.4, 0];
    expect(seen(shoulder, "bust", [STANDING]).y).toBeGreaterThan(-1);
    expect(seen(STANDING.root, "bust", [STANDING]).y).toBeLessThan(-1);
  });

  it("shows the hips with the upper body, and the feet with the full body", () => {
    expect(seen(STANDING.root, "upper", [STANDING]).y).toBeGreaterThan(-1);
    expect(seen([0, 0, 0], "upper", [STANDING]).y).toBeLessThan(-1);
    expect(seen([0, 0, 0], "full", [STANDING]).y).toBeGreaterThan(-1);
  });

  it("shows the shoes of a character that sits down after a full shot of it standing", () => {
    expect(seen([0.1, 0, 0.7], "full", [STANDING], 4 / 3).y).toBeGreaterThan(-0.95);
  });

  it("shows head and feet of a character that lies with its feet to the camera", () => {
    const lying: Figure = { crown: [0, 0.3, -0.85], root: [0, 0.1, 0], feet: [[0.1, 0.1, 0.9]] };
    for (const end of [lying.crown, ...lying.feet]) {
      expect(Math.abs(seen(end, "full", [lying], 4 / 3).y)).toBeLessThan(0.94);
    }
  });

  it("shows the tips of the shoes of a character that sits, and the whole of one that lies across the picture", () => {
    for (const aspect of [4 / 3, 0.6]) {
      const { y } = seen([0.1, 0, 0.62], "full", [SITTING], aspect);
      expect(y).toBeGreaterThan(-1);
      const lying: Figure = { crown: [-0.85, 0.1, 0], root: [0, 0.1, 0], feet: [[0.8, 0.1, 0]] };
      for (const place of [lying.crown, ...lying.feet]) {
        expect(Math.abs(seen(place, "full", [lying], aspect).x)).toBeLessThan(1);
      }
    }
  });

  it.each(["face", "bust", "upper", "full"] as const)("shows all characters, in narrow windows too: %s", (shot) => {
    const beside: Figure = { crown: [1.2, 1.8, 0], root: [1.2, 0.95, 0], feet: [] };
    for (const aspect of [2, 0.6]) {
      const places = [STANDING, beside].map(({ crown }) => seen(crown, shot, [STANDING, beside], aspect));
      for (const { x, y } of places) expect(Math.max(Math.abs(x), Math.abs(y))).toBeLessThan(1);
    }
  });
});

describe("the shot of a film", () => {
  it("is that of the address, the upper body for an unknown one, and none if no film is asked for", () => {
    const asked = ["http://host/?film=face", "http://host/?film=feet", "http://host/?quality=low"];
    expect(asked.map(shotOf)).toEqual(["face", "upper", null]);
  });
});
