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

/** A character as the camera sees it: places in the world, m. */
export interface Figure {
  crown: Position;
  root: Position;
  /** All its joints, in any order. */
  joints: Position[];
}

/** The point that the camera looks at, and its position, m. */
export interface View {
  target: Vector3;
  eye: Vector3;
}

/** A figure that is shown while no character is known. */
const USUAL: Figure = { crown: [0, 1.7, 0], root: [0, 0.9, 0], joints: [] };

/** Space above the head and below what is shown, m: hands are raised above the head, and feet are set forward. */
const ABOVE: Record<Shot, number> = { face: 0.05, bust: 0.1, upper: 0.13, full: 0.2 };
const BELOW: Record<Shot, number> = { face: 0.05, bust: 0.05, upper: 0.05, full: 0.25 };

/** Space to each side of the characters, m: a gesture reaches farther than a face. */
const REACH: Record<Shot, number> = { face: 0.16, bust: 0.27, upper: 0.5, full: 0.5 };

/** How far shoes, fingers and hair reach from the joints, and how far before the root the shoes of a sitting figure are, m. */
const FLESH = 0.12;
const SEATED_FEET = 0.75;

/** How much farther away the camera goes at a time, until it sees all, and how often at most. */
const STEP_BACK = 1.02;
const STEPS = 100;

/** Share of the picture, in each direction, in which it shows all: the rest is margin. */
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
  const lowest = isNear(shot) ? min.y : top / 2;
  const middle = shot === "full" ? (top + min.y - BELOW.full) / 2 : Math.max(top - height / 2, lowest);
  const target = new Vector3((min.x + max.x) / 2, middle, max.z);
  const distance = height / 2 / Math.tan(MathUtils.degToRad(fov / 2));
  const above = isNear(shot) ? Math.max(LOWEST, max.y - EYES) : EYE_HEIGHT;
  const view = { target, eye: new Vector3(target.x, above, target.z + distance) };
  if (shot === "full") stepBack(view, shown, aspect, fov);
  return view;
}

/** Whether a view shows all of all figures: their joints, and what is around these. */
export function showsAll(view: View, figures: Figure[], aspect: number, fov: number): boolean {
  return shows(view, figures.flatMap(corners), aspect, fov, 1);
}

/** Moves the camera away until it shows all of the figures, also once they sit: a foot set forward is lower in the picture. */
function stepBack(view: View, figures: Figure[], aspect: number, fov: number): void {
  const seated = figures.map(({ root: [x, , z] }) => new Vector3(x, 0, z + SEATED_FEET));
  const points = [...figures.flatMap(corners), ...seated];
  for (let i = 0; i < STEPS && !shows(view, points, aspect, fov, WITHIN); i++) {
    view.eye.z = view.target.z + STEP_BACK * (view.eye.z - view.target.z);
  }
}

/** Whether points are within a share of the picture of a camera that is upright. */
function shows({ target, eye }: View, points: Vector3[], aspect: number, fov: number, share: number): boolean {
  const ahead = target.clone().sub(eye).normalize();
  const right = new Vector3(0, 1, 0).cross(ahead).normalize();
  const up = ahead.clone().cross(right);
  const half = share * Math.tan(MathUtils.degToRad(fov / 2));
  return points.every((point) => {
    const from = point.clone().sub(eye);
    const limit = half * from.dot(ahead);
    return Math.abs(from.dot(up)) < limit && Math.abs(from.dot(right)) < limit * aspect;
  });
}

/** The corners of the box around a figure; the floor is its lowest place. */
function corners({ joints }: Figure): Vector3[] {
  if (joints.length === 0) return [];
  const box = new Box3().setFromPoints(joints.map((joint) => new Vector3(...joint))).expandByScalar(FLESH);
  const { min, max } = box;
  const heights = [Math.max(min.y, 0), max.y];
  return [min.x, max.x].flatMap((x) => heights.flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))));
}

/** Whether a shot shows heads only, and so has to follow a small move. */
export function isNear(shot: Shot): boolean {
  return shot === "face" || shot === "bust";
}

/** Points of a figure that a shot shows. */
function outline(shot: Shot, { crown, root }: Figure): Vector3[] {
  const [x, y, z] = crown;
  switch (shot) {
    case "face":
      return [new Vector3(x, y, z), new Vector3(x, y - FACE, z)];
    case "bust":
      return [new Vector3(x, y, z), new Vector3(x, y - BUST, z)];
    case "upper":
      return [new Vector3(...root), new Vector3(x, y, root[2])];
    case "full":
      return [new Vector3(root[0], 0, root[2]), new Vector3(...root), new Vector3(x, y, root[2])];
  }
}
