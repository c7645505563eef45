import {
  BufferAttribute,
  BufferGeometry,
  Mesh,
  MeshStandardMaterial,
  type WebGLProgramParametersWithUniforms,
} from "three";
import { expect, it } from "vitest";

import { blushing, Skin } from "../src/skin";

/** A mesh of three vertices; the blend shape of the left cheek moves the second one most. */
function face(material: string): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(9), 3));
  const moves = new BufferAttribute(new Float32Array([0, 0, 0, 0, 0.004, 0, 0.001, 0, 0]), 3);
  moves.name = "cheekSquintLeft";
  geometry.morphAttributes.position = [moves];
  return new Mesh(geometry, new MeshStandardMaterial({ name: material }));
}

function compiled(mesh: Mesh): WebGLProgramParametersWithUniforms {
  const shader = {
    uniforms: {},
    vertexShader: "void main() {\n#include <begin_vertex>\n}",
    fragmentShader: "void main() {\n#include <color_fragment>\n}\n#include <lights_physical_pars_fragment>",
  } as WebGLProgramParametersWithUniforms;
  (mesh.material as MeshStandardMaterial).onBeforeCompile(shader, undefined as never);
  return shader;
}

it("lets the cheeks blush most", () => {
  expect([...blushing(face("Skin"))]).toEqual([0, 1, 0.25]);
});

it("lets light reach around the edge of skin, and of nothing else", () => {
  const meshes = [face("BodySkin"), face("Hair")];
  new Skin(meshes);
  const [body, hair] = meshes.map(compiled);
  expect(body?.fragmentShader).toContain("directDiffuse += wrapped *");
  expect(hair?.fragmentShader).not.toContain("wrapped");
});

it("colors the materials of the skin by the weights, and no others", () => {
  const meshes = [face("BodySkin"), face("Hair")];
  const skin = new Skin(meshes);
  skin.color("skinBlush", 0.7);
  expect(skin.weight("skinBlush")).toBe(0.7);
  expect(skin.weight("jawOpen")).toBeNull();
  const [body, hair] = meshes.map(compiled);
  expect(body?.uniforms).toMatchObject({ skinBlush: { value: 0.7 }, skinPallor: { value: 0 } });
  expect(body?.fragmentShader).toContain("uniform float skinPallor;");
  expect(hair?.uniforms).toEqual({});
});
