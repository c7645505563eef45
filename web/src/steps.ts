import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Shape,
  ShapeGeometry,
} from "three";

import type { Footprint, Steps } from "./protocol";
import { OVERLAY } from "./viewport";

/** Most prints of a character that stay; the oldest are the faintest. */
const MOST = 30;

/** Distance (m) and turn (degrees) up to which two prints are the same. */
const SAME = 0.01;
const SAME_TURN = 2;

/** How opaque a new print is, the oldest one, and one that is not made yet. */
const NEW = 0.8;
const OLDEST = 0.1;
const AHEAD = 0.3;

/** Half the width of the path, m. */
const PATH_WIDTH = 0.012;

/** Heights above the floor and its shadows, m. */
const PATH_HEIGHT = 0.004;
const PRINT_HEIGHT = 0.005;

/** Of the path, and of the prints of the left and the right foot. */
const COLORS = { path: "#d97b29", left: "#2f6fb2", right: "#b23a48" };

/** Extent of a sole from the point below the ankle: behind it, before it, and to each side, m. */
const HEEL = -0.055;
const TOE = 0.19;
const WIDTH = 0.042;

/** A print as it is shown. */
export interface ShownPrint extends Footprint {
  opacity: number;
}

/** The prints of a character: those that it has made, and those that its feet are on the way to. */
export class Trail {
  private made: Footprint[] = [];
  private next: Footprint[] = [];

  /** Takes the present prints of both feet. */
  take(prints: readonly Footprint[]): void {
    this.next = prints.filter(({ made }) => !made);
    for (const print of prints) {
      const last = this.made.filter(({ side }) => side === print.side).at(-1);
      if (print.made && (last === undefined || !same(last, print))) this.made.push(print);
    }
    this.made = this.made.slice(-MOST);
  }

  /** All prints, oldest first. */
  get prints(): ShownPrint[] {
    const fading = (NEW - OLDEST) / MOST;
    const made = this.made.map((print, index) => ({
      ...print,
      opacity: NEW - fading * (this.made.length - 1 - index),
    }));
    return [...made, ...this.next.map((print) => ({ ...print, opacity: AHEAD }))];
  }
}

function same(one: Footprint, other: Footprint): boolean {
  const [x, z] = one.position;
  const turn = Math.abs(((one.heading - other.heading + 540) % 360) - 180);
  return Math.hypot(x - other.position[0], z - other.position[1]) < SAME && turn < SAME_TURN;
}

/** Draws the path and the footprints of a character on the floor. */
export class StepsOverlay {
  private readonly trail = new Trail();
  private readonly path = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ color: COLORS.path, side: DoubleSide, depthWrite: false }),
  );
  private readonly soles: Mesh<ShapeGeometry, MeshBasicMaterial>[] = [];

  constructor(private readonly scene: Object3D) {
    this.path.frustumCulled = false;
    this.path.renderOrder = 2;
    this.path.layers.set(OVERLAY);
  }

  /** Number of footprints that are shown. */
  get count(): number {
    return this.soles.length;
  }

  /** Shows what a character does now. */
  take({ path, prints }: Steps): void {
    this.trail.take(prints);
    this.path.geometry.dispose();
    this.path.geometry = ribbon(path);
    if (path.length > 1) this.scene.add(this.path);
    else this.path.removeFromParent();
    const shown = this.trail.prints;
    while (this.soles.length < shown.length) this.soles.push(sole());
    for (const extra of this.soles.splice(shown.length)) discard(extra);
    shown.forEach((print, index) => {
      const mesh = this.soles[index];
      if (mesh === undefined) return;
      mesh.position.set(print.position[0], PRINT_HEIGHT, print.position[1]);
      mesh.rotation.set(0, (print.heading * Math.PI) / 180, 0);
      mesh.material.color.set(COLORS[print.side]);
      mesh.material.opacity = print.opacity;
      this.scene.add(mesh);
    });
  }

  /** Takes everything out of the scene. */
  remove(): void {
    this.path.removeFromParent();
    this.path.geometry.dispose();
    this.path.material.dispose();
    for (const mesh of this.soles.splice(0)) discard(mesh);
  }
}

/** A ribbon along straight lines between points on the ground. */
function ribbon(path: Steps["path"]): BufferGeometry {
  const corners = path.slice(1).flatMap(([x, z], index) => {
    const [startX, startZ] = path[index] ?? [x, z];
    const length = Math.hypot(x - startX, z - startZ) || 1;
    const [sideX, sideZ] = [(PATH_WIDTH * (z - startZ)) / length, (-PATH_WIDTH * (x - startX)) / length];
    const quad = [
      [startX + sideX, startZ + sideZ],
      [startX - sideX, startZ - sideZ],
      [x + sideX, z + sideZ],
      [x - sideX, z - sideZ],
    ];
    return [0, 1, 2, 2, 1, 3].flatMap((corner) => quad[corner] ?? []);
  });
  const positions = Array.from({ length: corners.length / 2 }, (_, index) => [
    corners[2 * index] ?? 0,
    PATH_HEIGHT,
    corners[2 * index + 1] ?? 0,
  ]);
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(positions.flat(), 3));
}

/** A sole that points to +z. */
function sole(): Mesh<ShapeGeometry, MeshBasicMaterial> {
  const outline = new Shape();
  outline.moveTo(0, HEEL);
  outline.bezierCurveTo(WIDTH, HEEL, 0.6 * WIDTH, 0.03, WIDTH, 0.1);
  outline.bezierCurveTo(1.1 * WIDTH, 0.16, 0.6 * WIDTH, TOE, 0, TOE);
  outline.bezierCurveTo(-0.6 * WIDTH, TOE, -1.1 * WIDTH, 0.16, -WIDTH, 0.1);
  outline.bezierCurveTo(-0.6 * WIDTH, 0.03, -WIDTH, HEEL, 0, HEEL);
  const geometry = new ShapeGeometry(outline, 8).rotateX(Math.PI / 2); // y of the shape becomes z
  const material = new MeshBasicMaterial({ transparent: true, depthWrite: false, side: DoubleSide });
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 2;
  mesh.layers.set(OVERLAY);
  return mesh;
}

function discard(mesh: Mesh<ShapeGeometry, MeshBasicMaterial>): void {
  mesh.removeFromParent();
  mesh.geometry.dispose();
  mesh.material.dispose();
}
