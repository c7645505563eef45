import { LessDepth, type Material, type Mesh, MeshStandardMaterial } from "three";

/** Alpha from which a cut-out material is opaque. */
const OPAQUE = 0.7;

/** Alpha of the faintest texel that is drawn. */
const FAINTEST = 0.02;

/** After everything that is transparent on the floor. */
const ORDER = 2;

/** Has the alpha of meshes with cut-out materials, such as hair, fade out instead of ending in hard texels. */
export function softenCutouts(meshes: Mesh[]): void {
  const cut = meshes.filter((mesh) => cutouts(mesh).length > 0);
  const guessed = new Set(cut.filter(giveTangents).flatMap(cutouts));
  // The loader has turned the scale around for guessed tangents. Meshes may share a material.
  for (const material of guessed) if (material instanceof MeshStandardMaterial) material.normalScale.y *= -1;
  for (const mesh of cut) mesh.parent?.add(fringe(mesh));
}

/** The materials of a mesh that are cut out by alpha. */
function cutouts(mesh: Mesh): Material[] {
  return [mesh.material].flat().filter(({ alphaTest }) => alphaTest > 0);
}

/**
 * Splits a mesh: it keeps the texels that are nearly opaque, which hide what is behind them, and the new mesh blends the
 * others over everything. Blending alone would need strands that are sorted; the samples of a pixel alone, as few as
 * there are, show as a grid of dots.
 */
function fringe(mesh: Mesh): Mesh {
  const soft = mesh.clone(false);
  if (mesh.morphTargetInfluences) soft.morphTargetInfluences = mesh.morphTargetInfluences;
  soft.material = Array.isArray(mesh.material) ? mesh.material.map(blended) : blended(mesh.material);
  soft.castShadow = false;
  soft.renderOrder = ORDER;
  for (const material of cutouts(mesh)) material.alphaTest = OPAQUE;
  return soft;
}

/** What of a material is not opaque; of one that is not cut out, nothing. */
function blended(material: Material): Material {
  const soft = material.clone();
  soft.visible = material.alphaTest > 0;
  soft.alphaTest = FAINTEST;
  soft.transparent = true;
  soft.forceSinglePass = true;
  soft.depthWrite = false;
  soft.depthFunc = LessDepth;
  return soft;
}

/**
 * Computes the tangents of a mesh without them; whether it did. Otherwise, those of the pixels of narrow triangles are
 * guesses, and show as bright and dark dots.
 */
function giveTangents(mesh: Mesh): boolean {
  const { index, attributes } = mesh.geometry;
  const { position, normal, uv, tangent } = attributes;
  if (!index || !position || !normal || !uv || tangent) return false;
  mesh.geometry.computeTangents();
  return true;
}
