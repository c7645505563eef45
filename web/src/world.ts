import { BoxGeometry, Mesh, MeshLambertMaterial, type Object3D, SphereGeometry } from "three";

import type { Position } from "./protocol";

/** Targets of the world that can be seen; all others (the viewer, the camera, the characters) need no marker. */
const MARKERS = {
  bluebox: () => marker(new BoxGeometry(0.12, 0.12, 0.12), "#2f6fed"),
  greensphere: () => marker(new SphereGeometry(0.07, 32, 24), "#35a853"),
};

/** What `GET /world` tells: the position (m) of each named target. */
export interface WorldState {
  targets: Record<string, { position: Position }>;
}

/** The things in the scene that a virtual human can look at and point to. */
export class World {
  private readonly markers = new Map<string, Mesh>();

  constructor(private readonly scene: Object3D) {}

  /** Puts every marker where its target is, and takes away those whose target is gone. */
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
