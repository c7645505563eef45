import { BufferAttribute, type Material, Mesh, ShaderChunk, type WebGLProgramParametersWithUniforms } from "three";

/** The weights that color the skin, by their names in `morphs`. */
export const SKIN_COLORS = ["skinBlush", "skinPallor"] as const;

export type SkinColor = (typeof SKIN_COLORS)[number];

/** The blend shapes that move the parts of the face that blush most, and how much these blush. */
const BLUSHING = { cheekSquintLeft: 1, cheekSquintRight: 1, cheekPuff: 0.5 };

const ATTRIBUTE = "blushes";

/** The skin of an avatar: the materials with "skin" in their names, which blush, turn pale and let light through. */
export class Skin {
  private readonly uniforms = { skinBlush: { value: 0 }, skinPallor: { value: 0 } };

  constructor(meshes: Mesh[]) {
    for (const mesh of meshes) {
      const materials = [mesh.material].flat().filter(isSkin);
      if (materials.length > 0) mesh.geometry.setAttribute(ATTRIBUTE, new BufferAttribute(blushing(mesh), 1));
      for (const material of materials) {
        material.onBeforeCompile = (shader) => {
          this.extend(shader);
        };
      }
    }
  }

  /** The present weight of a color, 0 to 1; null for another name. */
  weight(name: string): number | null {
    return isSkinColor(name) ? this.uniforms[name].value : null;
  }

  /** Sets the weight of a color, 0 to 1. */
  color(name: SkinColor, weight: number): void {
    this.uniforms[name].value = weight;
  }

  private extend(shader: WebGLProgramParametersWithUniforms): void {
    Object.assign(shader.uniforms, this.uniforms);
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", `attribute float ${ATTRIBUTE};\nvarying float vBlushes;\nvoid main() {`)
      .replace("#include <begin_vertex>", `#include <begin_vertex>\nvBlushes = ${ATTRIBUTE};`);
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `varying float vBlushes;\n${UNIFORMS}\nvoid main() {`)
      .replace("#include <color_fragment>", `#include <color_fragment>\n${COLORS}`)
      .replace("#include <lights_physical_pars_fragment>", SOFT_LIGHT);
  }
}

const UNIFORMS = SKIN_COLORS.map((name) => `uniform float ${name};`).join("\n");

/**
 * Blood under the skin absorbs green and blue; all of the face reddens a little. Without blood, skin is lighter and
 * loses its red.
 */
const COLORS = `
  float blush = skinBlush * max(0.25, sqrt(vBlushes));
  diffuseColor.rgb *= mix(vec3(1.0), vec3(1.0, 0.62, 0.6), blush);
  float light = dot(diffuseColor.rgb, vec3(0.2126, 0.7152, 0.0722));
  diffuseColor.rgb = mix(diffuseColor.rgb, light * vec3(1.25, 1.14, 1.0), 0.45 * skinPallor);
`;

/** How far light wraps around skin, red farthest, because red is scattered farthest below the surface. */
const WRAP = "vec3( 0.30, 0.13, 0.09 )";

/** Three's physical lighting, with light that reaches around the edge of the lit side. */
const SOFT_LIGHT = ShaderChunk.lights_physical_pars_fragment.replace(
  "reflectedLight.directDiffuse += irradiance *",
  `vec3 wrapped = saturate( ( dot( geometryNormal, directLight.direction ) + ${WRAP} ) / ( 1.0 + ${WRAP} ) );
  reflectedLight.directDiffuse += wrapped * directLight.color *`,
);

export function isSkinColor(name: string): name is SkinColor {
  return (SKIN_COLORS as readonly string[]).includes(name);
}

function isSkin(material: Material): boolean {
  return material.name.toLowerCase().includes("skin");
}

/** How much each vertex blushes, 0 to 1: as far as the blend shapes of the cheeks move it, in relation to the furthest. */
export function blushing(mesh: Mesh): Float32Array {
  const shares = new Float32Array(mesh.geometry.getAttribute("position").count);
  for (const [morph, share] of Object.entries(BLUSHING)) {
    const index = mesh.morphTargetDictionary?.[morph];
    const moves = index === undefined ? undefined : mesh.geometry.morphAttributes.position?.[index];
    if (moves === undefined) continue;
    const lengths = shares.map((_, i) => Math.hypot(moves.getX(i), moves.getY(i), moves.getZ(i)));
    const furthest = lengths.reduce((a, b) => Math.max(a, b), 0);
    if (furthest === 0) continue;
    for (const [i, length] of lengths.entries()) shares[i] = Math.max(shares[i] ?? 0, (share * length) / furthest);
  }
  return shares;
}
