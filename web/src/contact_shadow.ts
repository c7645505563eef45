import {
  BackSide,
  type Camera,
  Frustum,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshDepthMaterial,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  type ShaderMaterialParameters,
  ShaderMaterial,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { HorizontalBlurShader } from "three/addons/shaders/HorizontalBlurShader.js";
import { VerticalBlurShader } from "three/addons/shaders/VerticalBlurShader.js";

/** Side of the square in which the floor is darkened, and height up to which things darken it, m. */
const SIDE = 3;
const HEIGHT = 0.3;

const PIXELS = 384;
const DARKNESS = 0.75;

/** Standard deviations of two passes of blurring, in 256ths of the square: a core and a penumbra. */
const BLURS = [1.6, 0.7];

/** Darkens the floor near to what stands on it, as ambient light does: the scene seen from below, blurred. */
export class ContactShadow {
  readonly plane: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly seen = new WebGLRenderTarget(PIXELS, PIXELS);
  private readonly blurred = new WebGLRenderTarget(PIXELS, PIXELS);
  private readonly camera = new OrthographicCamera(-SIDE / 2, SIDE / 2, SIDE / 2, -SIDE / 2, 0, HEIGHT);
  private readonly depth = nearness();
  private readonly horizontally = blur(HorizontalBlurShader);
  private readonly vertically = blur(VerticalBlurShader);
  private readonly screen = new Scene();
  private readonly screenCamera = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
  private readonly frustum = new Frustum();
  private readonly toScreen = new Matrix4();

  constructor(
    private readonly scene: Scene,
    private readonly floor: Mesh,
  ) {
    // as the camera below sees the floor: its back is above
    const material = new MeshBasicMaterial({
      map: this.seen.texture,
      side: BackSide,
      transparent: true,
      depthWrite: false,
    });
    this.plane = new Mesh(new PlaneGeometry(SIDE, SIDE), material);
    this.plane.geometry.rotateX(Math.PI / 2);
    this.plane.position.y = 0.002;
    this.plane.renderOrder = 1;
    this.camera.rotation.x = Math.PI / 2;
    this.screen.add(new Mesh(new PlaneGeometry(2, 2)));
    scene.add(this.plane);
  }

  /** Renders the shadow around a place on the floor (m), if a camera sees it. */
  update(renderer: WebGLRenderer, camera: Camera, x: number, z: number): void {
    this.plane.position.setX(x).setZ(z);
    this.plane.updateMatrixWorld();
    this.frustum.setFromProjectionMatrix(
      this.toScreen.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    if (!this.frustum.intersectsObject(this.plane)) return;
    this.camera.position.set(x, 0, z);
    const { background } = this.scene;
    const opacity = renderer.getClearAlpha();
    renderer.setClearAlpha(0);
    this.scene.background = null;
    this.floor.visible = this.plane.visible = false;
    this.scene.overrideMaterial = this.depth;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(this.seen);
    renderer.render(this.scene, this.camera);
    this.scene.overrideMaterial = null;
    this.floor.visible = this.plane.visible = true;
    this.scene.background = background;
    for (const sigma of BLURS) this.blur(renderer, sigma);
    renderer.setRenderTarget(null);
    renderer.shadowMap.autoUpdate = true;
    renderer.setClearAlpha(opacity);
  }

  private blur(renderer: WebGLRenderer, sigma: number): void {
    const passes = [
      [this.horizontally, "h", this.seen, this.blurred],
      [this.vertically, "v", this.blurred, this.seen],
    ] as const;
    for (const [material, axis, from, to] of passes) {
      material.uniforms.tDiffuse = { value: from.texture };
      material.uniforms[axis] = { value: sigma / 256 };
      this.screen.overrideMaterial = material;
      renderer.setRenderTarget(to);
      renderer.render(this.screen, this.screenCamera);
    }
  }
}

/** Black, and the more opaque the nearer to the floor. */
function nearness(): MeshDepthMaterial {
  const material = new MeshDepthMaterial();
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );",
      `gl_FragColor = vec4( vec3( 0.0 ), pow( 1.0 - fragCoordZ, 2.0 ) * ${DARKNESS.toFixed(2)} );`,
    );
  };
  return material;
}

function blur(shader: ShaderMaterialParameters): ShaderMaterial {
  return new ShaderMaterial({ ...shader, depthTest: false });
}
