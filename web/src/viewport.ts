import {
  CanvasTexture,
  CircleGeometry,
  Color,
  Mesh,
  MeshLambertMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  type Texture,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";

import { ContactShadow } from "./contact_shadow";
import { Follow } from "./follow";
import { type Figure, framing, isNear, type Shot } from "./framing";
import { lightSimply, lightWell } from "./lighting";
import { withOcclusion } from "./occlusion";
import type { Position } from "./protocol";

/**
 * How much the page spends on looks: `?quality=low` is for machines without a graphics card, `?quality=high` adds
 * ambient occlusion.
 */
export type Quality = "low" | "normal" | "high";

/** The layer of objects that cast no shadow on the floor, not even that of what stands near it. */
export const OVERLAY = 1;

/** Least time between two reports of the camera's position, ms. */
const REPORT_INTERVAL = 200;

/** Smallest move of the camera that is reported, m. */
const STILL = 0.005;

const BACKDROP_TOP = "#eef1f4";
const BACKDROP_BOTTOM = "#c3cad3";
const FLOOR = "#c4cad2";
const FLOOR_RADIUS = 5;

/** Number of pixels and highest frame rate (1/s) in low quality. */
const LOW_PIXELS = 320 * 240;
const LOW_RATE = 12;

/** The quality that the page's address asks for. */
export function qualityOf(address: string): Quality {
  const asked = new URL(address).searchParams.get("quality");
  return asked === "low" || asked === "high" ? asked : "normal";
}

/** The 3D view: light, floor, backdrop and camera. Other modules add their objects to `scene`. */
export class Viewport {
  readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(30, 1, 0.05, 60);
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  /** How much of the characters the camera keeps in view; null once the user has moved the camera. */
  private shot: Shot | null = "bust";
  private figures: Figure[] = [];
  private readonly follow = new Follow();
  private contactShadow: ContactShadow | null = null;
  private composer: EffectComposer | null = null;
  private nextDraw = 0;

  /** Throws when the browser has no WebGL 2. */
  constructor(
    private readonly container: HTMLElement,
    private readonly quality: Quality,
    private readonly onShot: (shot: Shot | null) => void,
  ) {
    const canvas = document.createElement("canvas");
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: quality === "normal",
    });
    container.prepend(canvas);
    this.controls = this.orbit(canvas);
    const ground = floor(quality);
    this.scene.add(ground);
    if (quality === "low") this.simplify();
    else this.embellish(ground);
    new ResizeObserver(() => {
      this.resize();
    }).observe(container);
  }

  /** Position of the camera, m. */
  get eye(): Position {
    return this.camera.position.toArray();
  }

  /** Keeps all characters in view, at a page time (ms), unless the user has moved the camera. */
  frame(page: number, figures: Figure[]): void {
    const roots = figures.map(({ root }) => root);
    if (this.shot === null || !this.follow.update(page, roots, isNear(this.shot))) return;
    this.figures = figures;
    this.look();
  }

  /** Shows as much of the characters as a shot asks for. */
  show(shot: Shot, figures: Figure[]): void {
    this.figures = figures;
    this.take(shot);
    this.look();
  }

  /** Draws at a page time (ms), if a picture is due. */
  draw(page: number): void {
    if (page < this.nextDraw) return;
    if (this.quality === "low") this.nextDraw = page + 1000 / LOW_RATE;
    this.controls.update();
    const { x, z } = this.controls.target;
    this.contactShadow?.update(this.renderer, this.camera, x, z);
    if (this.composer === null) this.renderer.render(this.scene, this.camera);
    else this.composer.render();
  }

  private orbit(canvas: HTMLCanvasElement): OrbitControls {
    this.camera.layers.enable(OVERLAY);
    const controls = new OrbitControls(this.camera, canvas);
    controls.enableDamping = true;
    controls.minDistance = 0.4;
    controls.maxDistance = 8;
    controls.maxPolarAngle = 0.52 * Math.PI;
    controls.zoomToCursor = true;
    controls.addEventListener("start", () => {
      this.take(null);
    });
    return controls;
  }

  private take(shot: Shot | null): void {
    this.shot = shot;
    this.onShot(shot);
  }

  private simplify(): void {
    lightSimply(this.scene);
    this.scene.background = new Color(BACKDROP_TOP);
  }

  private embellish(ground: Mesh): void {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    lightWell(this.scene, this.renderer);
    this.contactShadow = new ContactShadow(this.scene, ground);
    this.scene.background = gradientTexture(2, 512, (context) => {
      const gradient = context.createLinearGradient(0, 0, 0, 512);
      gradient.addColorStop(0, BACKDROP_TOP);
      gradient.addColorStop(1, BACKDROP_BOTTOM);
      return gradient;
    });
    if (this.quality === "high") this.composer = withOcclusion(this.renderer, this.scene, this.camera);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (clientWidth === 0 || clientHeight === 0) return;
    const scale = this.quality === "low" ? Math.sqrt(LOW_PIXELS / (clientWidth * clientHeight)) : 1;
    this.renderer.setSize(Math.round(clientWidth * scale), Math.round(clientHeight * scale), false);
    this.composer?.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.look();
  }

  private look(): void {
    if (this.shot === null) return;
    const { target, eye } = framing(this.shot, this.figures, this.camera.aspect, this.camera.fov);
    this.controls.target.copy(target);
    this.camera.position.copy(eye);
    this.controls.update();
  }
}

/** Reports the camera's position to the realizer when it has moved: virtual humans look at the camera. */
export class CameraReport {
  private reported: Position | null = null;
  private nextReport = 0;

  constructor(private readonly send: (position: Position) => void) {}

  /** Takes the camera's position (m) at a page time (ms). */
  update(page: number, eye: Position): void {
    if (page < this.nextReport || (this.reported !== null && distance(this.reported, eye) < STILL)) return;
    this.reported = eye;
    this.nextReport = page + REPORT_INTERVAL;
    this.send(eye);
  }

  /** Has the next update report, also without a move: the realizer is new. */
  reset(): void {
    this.reported = null;
  }
}

function distance(a: Position, b: Position): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** A disc that fades into the backdrop. */
function floor(quality: Quality): Mesh {
  const options = { color: FLOOR, transparent: true, alphaMap: fadingDisc() };
  const material =
    quality === "low" ? new MeshLambertMaterial(options) : new MeshStandardMaterial({ ...options, roughness: 0.95 });
  const disc = new Mesh(new CircleGeometry(FLOOR_RADIUS, 64), material);
  disc.rotation.x = -Math.PI / 2;
  disc.receiveShadow = true;
  return disc;
}

function fadingDisc(): Texture {
  return gradientTexture(256, 256, (context) => {
    const gradient = context.createRadialGradient(128, 128, 10, 128, 128, 128);
    gradient.addColorStop(0, "#fff");
    gradient.addColorStop(1, "#000");
    return gradient;
  });
}

function gradientTexture(
  width: number,
  height: number,
  fill: (context: CanvasRenderingContext2D) => CanvasGradient,
): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser cannot draw on a canvas");
  context.fillStyle = fill(context);
  context.fillRect(0, 0, width, height);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
