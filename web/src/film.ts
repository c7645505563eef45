import type { Frame } from "./binary";
import { Captions } from "./captions";
import { Characters } from "./characters";
import { type AudioMessage, Connection, type ConnectionListener } from "./connection";
import { element } from "./dom";
import type { Shot } from "./framing";
import { CaptionsPanel } from "./panels/captions";
import { PicturesPanel } from "./panels/pictures";
import { Pictures } from "./pictures";
import type { Hello, Pictures as PicturesMessage } from "./protocol";
import { type Quality, Viewport } from "./viewport";
import { World, type WorldState } from "./world";

/** Difference between two times that are the same, s. */
const SAME = 1e-6;

/**
 * The page without controls, sound and a clock: it draws a time when it is asked to, for pictures of a video
 * (`?film=upper`, with the name of a shot).
 */
export class Film implements ConnectionListener {
  private readonly connection: Connection;
  private readonly characters: Characters;
  private readonly viewport: Viewport;
  private readonly world: World;
  private readonly captions = new Captions(() => null);
  private readonly captionsPanel = new CaptionsPanel();
  private readonly pictures = new Pictures();
  private readonly picturesPanel = new PicturesPanel();
  private newest = -Infinity;
  private framed = false;
  private failure: Error | null = null;

  constructor(
    socket: URL,
    quality: Quality,
    private readonly shot: Shot,
  ) {
    document.body.classList.add("film");
    this.viewport = new Viewport(element("viewport", HTMLElement), quality, () => undefined);
    this.world = new World(this.viewport.scene);
    this.characters = new Characters(this.viewport.scene, quality, (reason) => {
      this.failure = new Error(String(reason));
    });
    this.connection = new Connection(socket, this);
    this.connection.open();
  }

  /** Whether the realizer has greeted: it sends all frames from then on. */
  get connected(): boolean {
    return this.connection.connected;
  }

  /**
   * Draws a realizer time, s, as soon as its frame and all avatars are there; times must not go back. Resolves when the
   * picture is on the screen, and rejects if an avatar could not be loaded.
   */
  async show(time: number): Promise<void> {
    while (!this.pose(time)) {
      if (this.failure !== null) throw this.failure;
      await animationFrame();
    }
    this.captionsPanel.show(this.captions.at(time));
    await this.showPictures(time);
    const figures = this.characters.figures();
    if (this.framed) this.viewport.frame(1000 * time, figures);
    else this.viewport.show(this.shot, figures);
    this.framed = true;
    this.viewport.draw(1000 * time);
    await animationFrame();
    await animationFrame();
  }

  onHello(hello: Hello): void {
    this.characters.assign(hello.characters);
    void this.loadWorld();
  }

  onLost(): void {
    this.failure = new Error("The connection was lost.");
  }

  onFrames(frames: Frame[]): void {
    for (const frame of frames) {
      this.characters.push(frame);
      this.newest = Math.max(this.newest, frame.time);
    }
  }

  onAudio(message: AudioMessage): void {
    this.captions.handle(message);
  }

  onPictures(message: PicturesMessage): void {
    this.pictures.handle(message);
  }

  onSound(): void {
    // The sound is not played.
  }

  onFeedback(): void {
    // Nothing shows it.
  }

  onBoard(): void {
    // Nothing shows it.
  }

  private async showPictures(time: number): Promise<void> {
    const pictures = this.pictures.at(time + SAME);
    this.picturesPanel.show(pictures, this.characters.hide(pictures));
    await this.picturesPanel.loaded();
  }

  private pose(time: number): boolean {
    if (this.newest < time - SAME) return false;
    this.characters.show(time, () => null);
    return this.characters.complete;
  }

  private async loadWorld(): Promise<void> {
    const response = await fetch(new URL("world", document.baseURI));
    if (response.ok) this.world.show((await response.json()) as WorldState);
    else this.failure = new Error(`The world could not be loaded (HTTP ${response.status}).`);
  }
}

function animationFrame(): Promise<number> {
  return new Promise((resolve) => requestAnimationFrame(resolve));
}
