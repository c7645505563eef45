import { type Object3D, Vector3 } from "three";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { describe, expect, it } from "vitest";

import { hasSprings, Springs } from "../src/springs";

/** A model with a braid of two bones that hangs from the hips; VRM 1 springs swing it. */
function model(extensions: object): Promise<GLTF> {
  const nodes = [
    { name: "Hips", translation: [0, 1, 0], children: [1] },
    { name: "Braid", translation: [0, 0, -0.1], children: [2] },
    { name: "End", translation: [0, -0.3, 0] },
  ];
  const json = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes, extensions };
  return new GLTFLoader().parseAsync(JSON.stringify(json), "");
}

const BRAID = {
  VRMC_springBone: { specVersion: "1.0", springs: [{ joints: [{ node: 1, stiffness: 0.2 }, { node: 2 }] }] },
};

async function braid(): Promise<[Springs, Object3D, () => Vector3]> {
  const gltf = await model(BRAID);
  const hips = gltf.scene.getObjectByName("Hips");
  const springs = await Springs.of(gltf);
  if (springs === null || hips === undefined) throw new Error("the model has no springs");
  const end = (): Vector3 => {
    gltf.scene.updateMatrixWorld(true);
    return gltf.scene.getObjectByName("End")?.getWorldPosition(new Vector3()).sub(hips.position) ?? new Vector3();
  };
  return [springs, hips, end];
}

describe("springs", () => {
  it("lag behind the bones that they hang from, and return", async () => {
    const [springs, hips, end] = await braid();
    springs.update(0);
    const rest = end();
    hips.position.x += 0.2;
    springs.update(0.02);
    expect(end().x).toBeLessThan(rest.x - 0.05);
    for (let time = 0.04; time < 10; time += 0.02) springs.update(time);
    expect(end().distanceTo(rest)).toBeLessThan(0.01);
  });

  it("start anew after a gap and when time goes back", async () => {
    const [springs, hips, end] = await braid();
    springs.update(5);
    const rest = end();
    for (const time of [7, 6]) {
      hips.position.x += 1;
      springs.update(time);
      expect(end().distanceTo(rest)).toBeLessThan(1e-6);
    }
  });

  it("are found in VRM 1 and VRM 0 only", async () => {
    expect(hasSprings({ extensions: BRAID })).toBe(true);
    expect(hasSprings({ extensions: { VRM: { secondaryAnimation: {} } } })).toBe(true);
    expect(hasSprings({ extensions: { VRMC_vrm: {} } })).toBe(false);
    expect(await Springs.of(await model({}))).toBeNull();
  });
});
