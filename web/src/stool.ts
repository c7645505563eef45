import {
  CylinderGeometry,
  type Material,
  MathUtils,
  Mesh,
  MeshLambertMaterial,
  MeshStandardMaterial,
  type Object3D,
} from "three";

import type { Position } from "./protocol";
import type { Quality } from "./viewport";

/** Places of the joints of a leg, m. */
export interface Leg {
  hip: Position;
  knee: Position;
  ankle: Position;
}

/** The middle of a seat (m), and how visible it is, 0 to 1. */
export interface Seat {
  place: Position;
  shown: number;
}

/** Slopes of a thigh, in degrees from the horizontal, at which a seat begins to appear and is complete. */
const SLOPES: [number, number] = [38, 16];

/** Slopes of a shin from the vertical, likewise: one that leans forward more is that of somebody who crouches. */
const LEANS: [number, number] = [28, 21];

/** Depth of the seat below the hip joints, and distance of its middle before them, m. */
const FLESH = 0.088;
const FORWARD = 0.03;

/** Highest height of hip joints that sit, above the knees, m: the seat does not rise with a figure that stands up. */
const HIGHEST = 0.03;

const RADIUS = 0.185;
const THICKNESS = 0.05;
const FOOT = 0.16;
const COLOR = "#8d8378";

/** The seat of a figure with these legs; null if it does not sit. */
export function seatOf(legs: Leg[]): Seat | null {
  const shown = Math.min(...legs.map(sitting));
  if (legs.length === 0 || shown <= 0) return null;
  const hip = mean(legs.map((leg) => leg.hip));
  const knee = mean(legs.map((leg) => leg.knee));
  const [x, z] = [knee[0] - hip[0], knee[2] - hip[2]];
  const share = FORWARD / (Math.hypot(x, z) || 1);
  const height = Math.min(hip[1], knee[1] + HIGHEST) - FLESH;
  return { place: [hip[0] + share * x, height, hip[2] + share * z], shown };
}

/** How much a leg is that of a sitting figure, 0 to 1. */
function sitting({ hip, knee, ankle }: Leg): number {
  const thigh = degrees(Math.abs(knee[1] - hip[1]), Math.hypot(knee[0] - hip[0], knee[2] - hip[2]));
  const shin = degrees(Math.hypot(knee[0] - ankle[0], knee[2] - ankle[2]), knee[1] - ankle[1]);
  return Math.min(between(thigh, SLOPES), between(shin, LEANS));
}

function degrees(opposite: number, adjacent: number): number {
  return MathUtils.radToDeg(Math.atan2(opposite, adjacent));
}

function between(slope: number, [start, end]: [number, number]): number {
  return MathUtils.clamp((start - slope) / (start - end), 0, 1);
}

function mean(places: Position[]): Position {
  const sum = (axis: 0 | 1 | 2): number => places.reduce((total, place) => total + place[axis], 0);
  return [sum(0) / places.length, sum(1) / places.length, sum(2) / places.length];
}

/** A round stool that stands under a sitting figure and fades in and out. */
export class Stool {
  private readonly seat: Mesh;
  private readonly leg: Mesh;
  private readonly foot: Mesh;
  private readonly parts: Mesh[];
  private readonly material: Material;

  constructor(
    private readonly scene: Object3D,
    quality: Quality,
  ) {
    const look = { color: COLOR, transparent: true };
    this.material =
      quality === "low" ? new MeshLambertMaterial(look) : new MeshStandardMaterial({ ...look, roughness: 0.7 });
    this.seat = this.part(new CylinderGeometry(RADIUS, RADIUS * 0.94, THICKNESS, 48));
    this.leg = this.part(new CylinderGeometry(0.026, 0.03, 1, 24));
    this.foot = this.part(new CylinderGeometry(FOOT * 0.96, FOOT, 0.018, 48));
    this.parts = [this.seat, this.leg, this.foot];
  }

  /** Puts the stool under a figure, or away. */
  show(seat: Seat | null): void {
    if (seat === null) {
      this.remove();
      return;
    }
    const [x, top, z] = seat.place;
    this.material.opacity = seat.shown;
    this.seat.position.set(x, top - THICKNESS / 2, z);
    this.leg.position.set(x, (top - THICKNESS) / 2, z);
    this.leg.scale.setY(Math.max(top - THICKNESS, 0.01));
    this.foot.position.set(x, 0.009, z);
    this.scene.add(...this.parts);
  }

  /** Takes the stool out of the scene. */
  remove(): void {
    for (const part of this.parts) part.removeFromParent();
  }

  private part(geometry: CylinderGeometry): Mesh {
    const mesh = new Mesh(geometry, this.material);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  }
}
