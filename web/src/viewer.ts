import type { Scene } from "three";

import { Characters } from "./characters";
import type { Frame, Sound } from "./binary";
import { FrameClock, PlayoutClock, PlayoutDelay } from "./clock";
import { type AudioMessage, Connection, type ConnectionListener } from "./connection";
import { element } from "./dom";
import { AnticipatorsPanel } from "./panels/anticipators";
import { Captions } from "./captions";
import { BmlPanel } from "./panels/bml";
import { CaptionsPanel } from "./panels/captions";
import { FeedbackPanel } from "./panels/feedback";
import { PegsPanel } from "./panels/pegs";
import { PhysicsPanel } from "./panels/physics";
import { PicturesPanel } from "./panels/pictures";
import { ShotsPanel } from "./panels/shots";
import type { StatusPanel } from "./panels/status";
import { Pictures } from "./pictures";
import type { Board, Feedback, Hello, Pictures as PicturesMessage } from "./protocol";
import { SpeechPlayer } from "./speech";
import { CameraReport, type Quality, Viewport } from "./viewport";
import { World, type WorldState } from "./world";

/** The page: passes messages of the connection to its parts, and draws every animation frame. */
export class Viewer implements ConnectionListener {
  readonly connection: Connection;
  readonly characters: Characters;
  readonly speech: SpeechPlayer;
  readonly feedback = new FeedbackPanel();
  private readonly frameClock = new FrameClock();
  private readonly clock = new PlayoutClock();
  private readonly delay = new PlayoutDelay();
  private readonly audio = new AudioContext();
  private readonly viewport: Viewport;
  private readonly world: World;
  private readonly cameraReport: CameraReport;
  private readonly captions = new Captions((id) => this.speech.position(id));
  private readonly captionsPanel = new CaptionsPanel();
  private readonly pictures = new Pictures();
  private readonly picturesPanel = new PicturesPanel();
  private readonly pegs = new PegsPanel();
  private readonly physics: PhysicsPanel;
  private readonly soundButton = element("sound", HTMLButtonElement);
  private readonly demoButton = element("demo", HTMLButtonElement);

  constructor(
    socket: URL,
    readonly quality: Quality,
    private readonly status: StatusPanel,
  ) {
    const shots = new ShotsPanel((shot) => {
      this.viewport.show(shot, this.characters.figures());
    });
    this.viewport = new Viewport(element("viewport", HTMLElement), quality, (shot) => {
      shots.mark(shot);
    });
    this.world = new World(this.viewport.scene);
    this.characters = new Characters(this.viewport.scene, quality, status.report);
    this.speech = new SpeechPlayer(this.audio, this.clock, this.delay, status.report);
    this.connection = new Connection(socket, this);
    this.cameraReport = new CameraReport((position) => {
      this.connection.notify({ type: "camera", position });
    });
    new BmlPanel(this.connection);
    new AnticipatorsPanel(this.connection, status.report);
    this.physics = new PhysicsPanel(this.connection, (id) => this.characters.forward(id), status.report);
    this.bindButtons();
  }

  /** Where overlays are drawn. */
  get scene(): Scene {
    return this.viewport.scene;
  }

  /** Connects, and starts to play. */
  start(): void {
    this.connection.open();
    const animate = (page: number): void => {
      requestAnimationFrame(animate);
      this.play(page);
    };
    requestAnimationFrame(animate);
  }

  onHello(hello: Hello, renewed: boolean): void {
    this.status.connected(hello.version);
    this.demoButton.hidden = hello.demo !== true;
    this.cameraReport.reset();
    if (renewed) this.renew(hello);
    this.frameClock.reset(performance.now() / 1000, hello.time);
    this.followFrames();
    void this.loadWorld();
  }

  onLost(): void {
    this.status.lost();
  }

  onFrames(frames: Frame[]): void {
    const page = performance.now() / 1000;
    for (const { time } of frames.slice(0, 1)) {
      this.frameClock.take(page, time);
      this.delay.takeFrame((this.frameClock.at(page) ?? time) - time);
    }
    for (const frame of frames) this.characters.push(frame);
  }

  onSound(sound: Sound): void {
    this.speech.take(sound);
  }

  onFeedback(feedback: Feedback): void {
    this.feedback.add(feedback);
    this.physics.take(feedback);
  }

  onAudio(message: AudioMessage): void {
    this.speech.handle(message);
    this.captions.handle(message);
  }

  onPictures(message: PicturesMessage): void {
    this.pictures.handle(message);
  }

  onBoard(board: Board): void {
    this.pegs.take(board);
  }

  private renew(hello: Hello): void {
    this.characters.assign(hello.characters);
    this.physics.assign(hello.characters);
    this.speech.clear();
    this.captions.clear();
    this.pictures.clear();
    this.pegs.clear();
    this.feedback.mark(`Session ${hello.session.slice(0, 8)}`);
  }

  private play(page: number): void {
    const time = this.followFrames();
    for (const report of this.speech.report()) this.connection.notify(report);
    if (time !== null) {
      this.characters.show(time, (id) => this.speech.frameTime(id));
      this.captionsPanel.show(this.captions.at(time));
      const pictures = this.pictures.at(time);
      this.picturesPanel.show(pictures, this.characters.hide(pictures));
    }
    if (this.characters.complete) this.viewport.frame(page, this.characters.figures());
    this.viewport.draw(page);
    this.feedback.draw();
    this.pegs.draw();
    this.cameraReport.update(page, this.viewport.eye);
  }

  /** Moves the playout clock towards the frames'; returns the time to show, s. */
  private followFrames(): number | null {
    const page = performance.now() / 1000;
    const time = this.frameClock.at(page);
    if (time === null) return null;
    this.clock.follow(page, time - this.delay.seconds);
    return this.clock.at(page);
  }

  private async loadWorld(): Promise<void> {
    const response = await fetch(new URL("world", document.baseURI));
    if (response.ok) this.world.show((await response.json()) as WorldState);
    else this.status.report(`The world could not be loaded (HTTP ${response.status}).`);
  }

  private bindButtons(): void {
    const showSound = (): void => {
      this.soundButton.hidden = this.audio.state === "running";
    };
    this.audio.addEventListener("statechange", showSound);
    showSound();
    // Browsers allow sound only after the user has interacted with the page: any click or key will do.
    const resume = (): void => void this.audio.resume();
    for (const gesture of ["pointerdown", "keydown"]) document.addEventListener(gesture, resume);
    this.demoButton.addEventListener("click", () => {
      this.connection.request({ type: "demo" }).catch(this.status.report);
    });
  }
}
