import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LessDepth,
  type Material,
  Mesh,
  MeshStandardMaterial,
  PlaneGeometry,
} from "three";
import { expect, it } from "vitest";

import { softenCutouts } from "../src/cutout";

/** A mesh of an avatar, and what stands beside it once its avatar has been softened. */
function softened(material: Material | Material[], geometry: BufferGeometry = new PlaneGeometry()): [Mesh, Mesh[]] {
  const mesh = new Mesh(geometry, material);
  const avatar = new Group().add(mesh);
  softenCutouts([mesh]);
  return [mesh, avatar.children.filter((child): child is Mesh => child instanceof Mesh && child !== mesh)];
}

it("draws what of hair is nearly opaque first, and blends the rest over everything", () => {
  const [hair, [fringe]] = softened(new MeshStandardMaterial({ alphaTest: 0.4 }));
  expect(hair.material).toMatchObject({ transparent: false, depthWrite: true });
  expect((hair.material as Material).alphaTest).toBeGreaterThan(0.5);
  expect(fringe?.geometry).toBe(hair.geometry);
  expect(fringe?.material).toMatchObject({ transparent: true, depthWrite: false, depthFunc: LessDepth });
  expect((fringe?.material as Material).alphaTest).toBeLessThan(0.05);
  expect(fringe?.renderOrder).toBeGreaterThan(1);
  expect(fringe?.castShadow).toBe(false);
});

it("leaves what is not cut out as it is", () => {
  const [, added] = softened(new MeshStandardMaterial());
  expect(added).toEqual([]);
});

it("draws only the cut-out materials of a mesh twice", () => {
  const [, [fringe]] = softened([new MeshStandardMaterial(), new MeshStandardMaterial({ alphaTest: 0.5 })]);
  expect((fringe?.material as Material[]).map(({ visible }) => visible)).toEqual([false, true]);
});

it("moves both parts of a mesh by the same weights", () => {
  const geometry = new PlaneGeometry();
  geometry.morphAttributes.position = [new BufferAttribute(new Float32Array(12), 3)];
  const [lashes, [fringe]] = softened(new MeshStandardMaterial({ alphaTest: 0.5 }), geometry);
  expect(fringe?.morphTargetInfluences).toBe(lashes.morphTargetInfluences);
});

it("gives hair tangents, for which the relief is turned around", () => {
  const [hair] = softened(new MeshStandardMaterial({ alphaTest: 0.4 }));
  expect(hair.geometry.getAttribute("tangent").count).toBe(4);
  expect((hair.material as MeshStandardMaterial).normalScale.y).toBe(-1);
});

it("turns around the relief of a material once, however many meshes share it", () => {
  const shared = new MeshStandardMaterial({ alphaTest: 0.4 });
  const meshes = [new Mesh(new PlaneGeometry(), shared), new Mesh(new PlaneGeometry(), shared)];
  const avatar = new Group().add(...meshes);
  softenCutouts(meshes);
  const drawn = avatar.children.filter((child): child is Mesh => child instanceof Mesh);
  const scales = drawn.map(({ material }) => (material as MeshStandardMaterial).normalScale.y);
  expect(scales).toEqual([-1, -1, -1, -1]);
});
