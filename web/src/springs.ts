import type { VRMSpringBoneManager } from "@pixiv/three-vrm-springbone";
import type { GLTF } from "three/addons/loaders/GLTFLoader.js";

/** A step after which springs start anew at rest, s: the page was hidden, or time went back. */
const LONGEST = 0.5;

/** Hair, clothes and the like of a VRM avatar, which swing after the bones that they hang from. */
export class Springs {
  private last: number | null = null;

  private constructor(private readonly manager: VRMSpringBoneManager) {
    manager.setInitState();
  }

  /** The springs of a model, null if it has none. The code that moves them is loaded only for models that have some. */
  static async of(gltf: GLTF): Promise<Springs | null> {
    if (!hasSprings(gltf.parser.json)) return null;
    const { VRMSpringBoneLoaderPlugin } = await import("@pixiv/three-vrm-springbone");
    await new VRMSpringBoneLoaderPlugin(gltf.parser).afterRoot(gltf);
    const manager = gltf.userData.vrmSpringBoneManager as VRMSpringBoneManager | null | undefined;
    return manager ? new Springs(manager) : null;
  }

  /** Moves them to a time, s, after the pose of the other bones is set. */
  update(time: number): void {
    const step = time - (this.last ?? time);
    this.last = time;
    if (step < 0 || step > LONGEST) this.manager.reset();
    else if (step > 0) this.manager.update(step);
  }
}

/** Whether a model has spring bones of VRM 1 or VRM 0. */
export function hasSprings(json: unknown): boolean {
  const { extensions } = json as { extensions?: { VRMC_springBone?: object; VRM?: { secondaryAnimation?: object } } };
  return extensions?.VRMC_springBone !== undefined || extensions?.VRM?.secondaryAnimation !== undefined;
}
