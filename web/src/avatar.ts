import {
  Bone,
  Box3,
  type Material,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  MeshStandardMaterial,
  type Object3D,
  Quaternion,
  Texture,
  Vector3,
} from "three";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import type { Pose } from "./binary";
import { softenCutouts } from "./cutout";
import type { Figure } from "./framing";
import type { Character, MorphTarget, Position } from "./protocol";
import { isSkinColor, Skin } from "./skin";
import { Springs } from "./springs";
import { type Leg, type Seat, seatOf } from "./stool";
import type { Quality } from "./viewport";

/** Names of the bone of a head, also with a prefix: `Head`, `mixamorig:Head`. */
const HEAD = /(^|[^a-z])head$/i;

/** Names of the bones of the legs, with or without a prefix: `LeftUpLeg`, `mixamorig:LeftUpLeg`. */
const LEGS = ["Left", "Right"].map((side) => ({
  hip: `${side}UpLeg`,
  knee: `${side}Leg`,
  ankle: `${side}Foot`,
  toes: `${side}ToeBase`,
}));

/** Names of the materials inside a mouth and between lids, where the shadow map is too coarse; their colors have shade. */
const INSIDE = /mouth|teeth|tongue|eyes?$/i;

/** One mesh's entry for a morph's weight: a face consists of several meshes that share their morphs. */
interface MorphSlot {
  influences: number[];
  index: number;
}

/** A loaded avatar: bones and morphs in the order of the character's frames. */
export class Avatar {
  /** The topmost bone, which carries the root's position. */
  private readonly root: Object3D | undefined;

  /** From the world to the nodes above the root, which may be scaled and turned. */
  private readonly fromWorld = new Matrix4();

  /** The bone of the head, and the height of the crown above it, m. */
  private readonly head: Object3D | undefined;
  private readonly crown: number;

  /** The inverse of the root's orientation in the model, in which the character faces +z. */
  private readonly unturned = new Quaternion();

  private constructor(
    readonly object: Object3D,
    private readonly character: Character,
    private readonly bones: (Object3D | undefined)[],
    private readonly slots: MorphSlot[][],
    private readonly skin: Skin,
    private readonly springs: Springs | null,
  ) {
    this.root = bones.find((bone) => !bones.includes(bone?.parent ?? undefined));
    if (this.root?.parent) this.fromWorld.copy(this.root.parent.matrixWorld).invert();
    this.root?.getWorldQuaternion(this.unturned).invert();
    this.head = bones.find((bone) => bone !== undefined && HEAD.test(bone.name));
    this.crown = new Box3().setFromObject(object).max.y - worldPosition(this.head ?? object)[1];
  }

  /** Loads the character's model; rejects when it cannot be loaded. */
  static async load(character: Character, quality: Quality): Promise<Avatar> {
    const gltf = await new GLTFLoader().loadAsync(character.avatar);
    const { scene } = gltf;
    scene.updateMatrixWorld(true);
    const meshes = meshesOf(scene);
    for (const mesh of meshes) prepare(mesh, quality);
    softenCutouts(meshes);
    const nodes = nodesOf(gltf);
    const bones = character.joints.map((name) => nodes.get(name));
    const slots = character.morphs.map((name) => {
      const targets = character.targets?.[name];
      return targets === undefined ? slotsOf(meshes, name) : slotsAt(gltf, meshes, targets);
    });
    return new Avatar(scene, character, bones, slots, new Skin(meshes), await Springs.of(gltf));
  }

  /**
   * Applies a pose as of a time, s: the root's position, rotations to the bones, weights to the morphs and to the colors
   * of the skin. Hair and clothes follow.
   */
  apply(pose: Pose, time: number): void {
    this.root?.position.fromArray(pose.root).applyMatrix4(this.fromWorld);
    for (const [i, bone] of this.bones.entries()) bone?.quaternion.fromArray(pose.rotations, 4 * i);
    for (const [i, slots] of this.slots.entries()) {
      for (const slot of slots) slot.influences[slot.index] = pose.weights[i] ?? 0;
    }
    for (const [i, name] of this.character.morphs.entries()) {
      if (isSkinColor(name)) this.skin.color(name, pose.weights[i] ?? 0);
    }
    this.springs?.update(time);
  }

  /** Its crown, its root and its feet in the world, m. */
  get figure(): Figure {
    const [x, y, z] = worldPosition(this.head ?? this.object);
    const feet = LEGS.map(({ ankle, toes }) => this.ending(toes) ?? this.ending(ankle)).filter((foot) => foot !== null);
    return { crown: [x, y + this.crown, z], root: worldPosition(this.root ?? this.object), feet };
  }

  /** Where the root faces in the world, horizontally, of length 1. */
  get forward(): Position {
    const turn = (this.root ?? this.object).getWorldQuaternion(new Quaternion()).multiply(this.unturned);
    return new Vector3(0, 0, 1).applyQuaternion(turn).setY(0).normalize().toArray();
  }

  /** The seat under it; null if it does not sit, or has no legs of known names. */
  get seat(): Seat | null {
    const legs = LEGS.map(({ hip, knee, ankle }) => [hip, knee, ankle].map((name) => this.ending(name)));
    return seatOf(legs.flatMap(([hip, knee, ankle]): Leg[] => (hip && knee && ankle ? [{ hip, knee, ankle }] : [])));
  }

  /** World position of a bone, m; null when the avatar has none of this name. */
  bone(name: string): Position | null {
    const bone = this.bones[this.character.joints.indexOf(name)];
    return bone === undefined ? null : worldPosition(bone);
  }

  /** World position of the bone with a name, after a prefix or none, m. */
  private ending(name: string): Position | null {
    const bone = this.bones.find((other) => other?.name === name || other?.name.endsWith(`mixamorig${name}`));
    return bone === undefined ? null : worldPosition(bone);
  }

  /** Present weight of a morph or of a color of the skin; null when the avatar has none of this name. */
  morph(name: string): number | null {
    if (isSkinColor(name)) return this.skin.weight(name);
    const [slot] = this.slots[this.character.morphs.indexOf(name)] ?? [];
    return slot?.influences[slot.index] ?? null;
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const mesh of meshesOf(this.object)) {
      mesh.geometry.dispose();
      for (const material of [mesh.material].flat()) disposeMaterial(material);
    }
  }
}

function worldPosition(object: Object3D): Position {
  return object.getWorldPosition(new Vector3()).toArray();
}

function meshesOf(root: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  root.traverse((node) => {
    if (node instanceof Mesh) meshes.push(node as Mesh);
  });
  return meshes;
}

function disposeMaterial(material: Material): void {
  for (const value of Object.values(material)) if (value instanceof Texture) value.dispose();
  material.dispose();
}

/** The nodes of a file by their names in it, which the loader changes; a bone has precedence over what shares its name. */
function nodesOf({ scene, parser }: GLTF): Map<string, Object3D> {
  const { nodes = [] } = parser.json as { nodes?: { name?: string }[] };
  const found = new Map<string, Object3D>();
  scene.traverse((object) => {
    const index = parser.associations.get(object)?.nodes;
    if (index === undefined) return;
    const name = nodes[index]?.name ?? `node ${index}`;
    const known = found.get(name);
    if (known === undefined || (object instanceof Bone && !(known instanceof Bone))) found.set(name, object);
  });
  return found;
}

function slotsOf(meshes: Mesh[], morph: string): MorphSlot[] {
  return meshes.flatMap((mesh) => {
    const index = mesh.morphTargetDictionary?.[morph];
    const influences = mesh.morphTargetInfluences;
    return index === undefined || influences === undefined ? [] : [{ influences, index }];
  });
}

/** The entries of morph targets that a file does not name: the primitives of a mesh of the file are meshes here. */
function slotsAt({ parser }: GLTF, meshes: Mesh[], targets: MorphTarget[]): MorphSlot[] {
  return targets.flatMap(({ mesh: index, target }) =>
    meshes.flatMap((mesh) => {
      const influences = mesh.morphTargetInfluences;
      const found = parser.associations.get(mesh)?.meshes === index && influences?.[target] !== undefined;
      return found ? [{ influences, index: target }] : [];
    }),
  );
}

function prepare(mesh: Mesh, quality: Quality): void {
  // The bounds of a skinned mesh are those of its rest pose, which may be out of view while the avatar is not.
  mesh.frustumCulled = false;
  const material = mesh.material;
  mesh.castShadow = true;
  mesh.receiveShadow = ![material].flat().some(({ name }) => INSIDE.test(name));
  if (!(material instanceof MeshStandardMaterial)) return;
  if (quality === "low") mesh.material = plain(material);
}

/** The same material with the cheapest lit shading. */
export function plain(material: MeshStandardMaterial): MeshLambertMaterial {
  const { name, color, vertexColors, map, alphaTest, transparent, side } = material;
  return new MeshLambertMaterial({ name, color, vertexColors, map, alphaTest, transparent, side });
}
