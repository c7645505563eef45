import {
  HalfFloatType,
  type PerspectiveCamera,
  type Scene,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { GTAOPass } from "three/addons/postprocessing/GTAOPass.js";
import { OutputPass } from "three/addons/postprocessing/OutputPass.js";
import { RenderPass } from "three/addons/postprocessing/RenderPass.js";

/** Reach of the occlusion, m: that of folds, arms and chins. */
const RADIUS = 0.12;

const SAMPLES = 4;

/** Renders a scene with ambient occlusion (ground-truth ambient occlusion, Jimenez et al. 2016). */
export function withOcclusion(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera): EffectComposer {
  const size = renderer.getDrawingBufferSize(new Vector2());
  const target = new WebGLRenderTarget(size.x, size.y, { type: HalfFloatType, samples: SAMPLES });
  const composer = new EffectComposer(renderer, target);
  const occlusion = new GTAOPass(scene, camera);
  occlusion.updateGtaoMaterial({ radius: RADIUS, distanceExponent: 1, thickness: 0.5, samples: 16 });
  occlusion.blendIntensity = 0.9;
  for (const pass of [new RenderPass(scene, camera), occlusion, new OutputPass()]) composer.addPass(pass);
  return composer;
}
