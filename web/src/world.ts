import { BoxGeometry, Mesh, MeshLambertMaterial, type Object3D, SphereGeometry } from "three";

import type { Position } from "./protocol";

/** Makers of the visible targets' markers; the viewer, the camera and the characters need none. */
const MARKERS = {
  bluebox: () => marker(new BoxGeometry(0.12, 0.12, 0.12), "#2f6fed"),
  greensphere: () => marker(new SphereGeometry(0.07, 32, 24), "#35a853"),
};

/** The answer to `GET /world`: the position (m) of each named target. */
export interface WorldState {
  targets: Record<string, { position: Position }>;
}

/** The visible targets that a virtual human can look at and point to. */
export class World {
  private readonly markers = new Map<string, Mesh>();

  constructor(private readonly scene: Object3D) {}

  /** Moves every marker to its target, and removes markers without a target. */
  show({ targets }: WorldState): void {
    for (const [name, make] of Object.entries(MARKERS)) {
      const position = targets[name]?.position;
      const known = this.markers.get(name);
      if (position === undefined) {
        known?.removeFromParent();
        continue;
      }
      const mesh = known ?? make();
      this.markers.set(name, mesh);
      mesh.position.fromArray(position);
      this.scene.add(mesh);
    }
  }
}

function marker(geometry: BoxGeometry | SphereGeometry, color: string): Mesh {
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ color }));
  mesh.castShadow = true;
  return mesh;
}
