import {
  DirectionalLight,
  HemisphereLight,
  NeutralToneMapping,
  PMREMGenerator,
  type Scene,
  type WebGLRenderer,
} from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

/** Lights for the cheapest shading: no shadows, and much light from everywhere. */
export function lightSimply(scene: Scene): void {
  scene.add(keyLight(2.2), rimLight(0.9), new HemisphereLight("#ffffff", "#b9b2a8", 2));
}

/** A key light with soft shadows, a weak fill from the other side, a rim from behind, and the light of a room. */
export function lightWell(scene: Scene, renderer: WebGLRenderer): void {
  renderer.shadowMap.enabled = true;
  renderer.toneMapping = NeutralToneMapping;
  const generator = new PMREMGenerator(renderer);
  scene.environment = generator.fromScene(new RoomEnvironment(), 0.04).texture;
  scene.environmentIntensity = 0.42;
  generator.dispose();
  const fill = new DirectionalLight("#e6eeff", 0.55);
  fill.position.set(-1.9, 1.1, 2.6);
  scene.add(withShadow(keyLight(2.5)), fill, rimLight(1.9), new HemisphereLight("#ffffff", "#b9a898", 0.35));
}

function keyLight(intensity: number): DirectionalLight {
  const key = new DirectionalLight("#fff1e0", intensity);
  key.position.set(1.6, 3.0, 2.9);
  return key;
}

function rimLight(intensity: number): DirectionalLight {
  const rim = new DirectionalLight("#dcecff", intensity);
  rim.position.set(-2.2, 2.6, -2.6);
  return rim;
}

function withShadow(light: DirectionalLight): DirectionalLight {
  light.castShadow = true;
  light.shadow.mapSize.set(2048, 2048);
  light.shadow.radius = 2;
  light.shadow.bias = -0.0004;
  light.shadow.normalBias = 0.02;
  Object.assign(light.shadow.camera, { left: -2.5, right: 2.5, top: 2.5, bottom: -2.5, near: 0.5, far: 9 });
  return light;
}
