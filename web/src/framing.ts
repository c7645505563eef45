import { Box3, MathUtils, Vector3 } from "three";

import type { Position } from "./protocol";

/** How much of the characters the camera shows. */
export type Shot = "face" | "bust" | "upper" | "full";

const SHOTS: readonly Shot[] = ["face", "bust", "upper", "full"];

/** The shot of a film that the page's address asks for (`?film=upper`); null if it asks for none. */
export function shotOf(address: string): Shot | null {
  const asked = new URL(address).searchParams.get("film");
  return asked === null ? null : (SHOTS.find((shot) => shot === asked) ?? "upper");
}

/** A character as the camera sees it: places in the world, m; no feet if its avatar has none of known names. */
export interface Figure {
  crown: Position;
  root: Position;
  feet: Position[];
}

/** The point that the camera looks at, and its position, m. */
export interface View {
  target: Vector3;
  eye: Vector3;
}

/** A figure that is shown while no character is known. */
const USUAL: Figure = { crown: [0, 1.7, 0], root: [0, 0.9, 0], feet: [] };

/** Space above the head and below what is shown, m: hands are raised above the head, and shoes go beyond the joints. */
const ABOVE: Record<Shot, number> = { face: 0.05, bust: 0.1, upper: 0.13, full: 0.2 };
const BELOW: Record<Shot, number> = { face: 0.05, bust: 0.05, upper: 0.05, full: 0.25 };

/** Space to each side of the characters, m: a gesture reaches farther than a face. */
const REACH: Record<Shot, number> = { face: 0.16, bust: 0.27, upper: 0.5, full: 0.5 };

/** How far before its root the shoes of a figure that sits are, m: the camera does not follow one that sits down. */
const SEATED_FEET = 0.75;

/** How much farther away the camera goes at a time until a full shot contains heads and feet, and how often at most. */
const STEP_BACK = 1.02;
const STEPS = 100;

/** Share of the half of the picture's height in which they are: the rest is margin. */
const WITHIN = 0.93;

/** Heights of a face with hair and neck, and of head and shoulders, m. */
const FACE = 0.32;
const BUST = 0.5;

/** Distance of the eyes from the crown, m. */
const EYES = 0.12;

/** Usual and lowest height of the camera, m: it looks down on characters that lie on the floor. */
const EYE_HEIGHT = 1.6;
const LOWEST = 0.5;

/** The view that shows all figures as a shot asks for; `fov` is the camera's vertical angle of view, in degrees. */
export function framing(shot: Shot, figures: Figure[], aspect: number, fov: number): View {
  const shown = figures.length === 0 ? [USUAL] : figures;
  const { min, max } = new Box3().setFromPoints(shown.flatMap((figure) => outline(shot, figure)));
  const top = max.y + ABOVE[shot];
  const width = max.x - min.x + 2 * REACH[shot];
  const height = Math.max(top - min.y + BELOW[shot], width / aspect);
  // A narrow window shows more height: it shows more of the legs, and at most as much above the heads as below.
  const target = new Vector3((min.x + max.x) / 2, Math.max(top - height / 2, isNear(shot) ? min.y : top / 2), max.z);
  const distance = height / 2 / Math.tan(MathUtils.degToRad(fov / 2));
  const above = isNear(shot) ? Math.max(LOWEST, max.y - EYES) : EYE_HEIGHT;
  const view = { target, eye: new Vector3(target.x, above, target.z + distance) };
  if (shot === "full") stepBack(view, shown, fov);
  return view;
}

/**
 * Moves the camera away until it shows heads and feet of all figures, also if they sit down: feet that are set forward
 * are lower in the picture, and the head of a figure that lies is higher.
 */
function stepBack(view: View, figures: Figure[], fov: number): void {
  const seated = figures.map(({ root: [x, , z] }): Position => [x, 0, z + SEATED_FEET]);
  const ends = [...seated, ...figures.flatMap(({ crown, feet }) => [crown, ...feet])];
  for (let i = 0; i < STEPS && !ends.every((end) => isBetweenEdges(end, view, fov)); i++) {
    view.eye.z = view.target.z + STEP_BACK * (view.eye.z - view.target.z);
  }
}

/** Whether a place is between the upper and the lower edge of the picture, with a margin. */
function isBetweenEdges([, y, z]: Position, { target, eye }: View, fov: number): boolean {
  const down = Math.atan2(eye.y - y, eye.z - z) - Math.atan2(eye.y - target.y, eye.z - target.z);
  return Math.abs(Math.tan(down)) < WITHIN * Math.tan(MathUtils.degToRad(fov / 2));
}

/** Whether a shot shows heads only, and so has to follow a small move. */
export function isNear(shot: Shot): boolean {
  return shot === "face" || shot === "bust";
}

/** Points of a figure that a shot shows. */
function outline(shot: Shot, { crown, root, feet }: Figure): Vector3[] {
  const [x, y, z] = crown;
  switch (shot) {
    case "face":
      return [new Vector3(x, y, z), new Vector3(x, y - FACE, z)];
    case "bust":
      return [new Vector3(x, y, z), new Vector3(x, y - BUST, z)];
    case "upper":
      return [new Vector3(...root), new Vector3(x, y, root[2])];
    case "full":
      return [
        new Vector3(root[0], 0, root[2]),
        new Vector3(...root),
        new Vector3(x, y, root[2]),
        ...feet.map((foot) => new Vector3(...foot)),
      ];
  }
}
