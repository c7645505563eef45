import { CameraReport } from "./camera_report";
import { Cast } from "./cast";
import { PLAYOUT_DELAY, PlayoutClock, ServerClock } from "./clock";
import { type AudioMessage, Connection, type ConnectionListener } from "./connection";
import { element } from "./dom";
import { sentenceOf } from "./errors";
import type { Frame } from "./frame";
import { BmlPanel } from "./panels/bml";
import { FeedbackPanel } from "./panels/feedback";
import { PegsPanel } from "./panels/pegs";
import { bindPrediction } from "./panels/prediction";
import { bindSpaceBar } from "./panels/space_bar";
import type { StatusPanel } from "./panels/status";
import { TempoPanel } from "./panels/tempo";
import type { Board, Feedback, Hello } from "./protocol";
import type { Quality } from "./quality";
import { SpeechPlayer } from "./speech";
import { Stage } from "./stage";
import { World, type WorldState } from "./world";

/** The page as a whole: hands what the connection brings to whom it concerns, and shows every animation frame. */
export class Viewer implements ConnectionListener {
  readonly connection: Connection;
  readonly cast: Cast;
  readonly speech: SpeechPlayer;
  readonly feedback = new FeedbackPanel();
  private readonly serverClock = new ServerClock();
  private readonly clock = new PlayoutClock();
  private readonly audio = new AudioContext();
  private readonly stage: Stage;
  private readonly world: World;
  private readonly cameraReport: CameraReport;
  private readonly pegs = new PegsPanel();
  private readonly soundButton = element("sound", HTMLButtonElement);
  private readonly demoButton = element("demo", HTMLButtonElement);

  constructor(
    socket: URL,
    readonly quality: Quality,
    private readonly status: StatusPanel,
  ) {
    this.stage = new Stage(element("stage", HTMLElement), quality);
    this.world = new World(this.stage.scene);
    this.cast = new Cast(this.stage.scene, quality, status.say);
    this.speech = new SpeechPlayer(this.audio, this.clock, status.say);
    this.connection = new Connection(socket, this.serverClock, this);
    this.cameraReport = new CameraReport((position) => {
      this.connection.notify({ type: "camera", position });
    });
    new BmlPanel(this.connection);
    new TempoPanel(this.connection, status.say);
    bindPrediction(this.connection, status.say);
    bindSpaceBar(this.connection, status.say);
    this.bindButtons();
  }

  /** Connects, and plays from now on. */
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
    this.followMaster();
    void this.loadWorld();
  }

  onLost(): void {
    this.status.lost();
  }

  onFrame(frame: Frame): void {
    this.cast.push(frame);
  }

  onFeedback(feedback: Feedback): void {
    this.feedback.add(feedback);
  }

  onAudio(message: AudioMessage): void {
    this.speech.handle(message);
  }

  onBoard(board: Board): void {
    this.pegs.show(board);
  }

  private renew(hello: Hello): void {
    this.cast.assign(hello.characters);
    this.speech.clear();
    this.pegs.clear();
    this.feedback.mark(`Session ${hello.session.slice(0, 8)}`);
  }

  private play(page: number): void {
    const time = this.followMaster();
    if (time !== null) this.cast.show(time);
    if (this.cast.complete) this.stage.frame(this.cast.roots());
    this.stage.draw(page);
    this.cameraReport.update(page, this.stage.eye);
  }

  /** Lets the playout clock follow what is heard, or else the realizer; gives the time to show, s. */
  private followMaster(): number | null {
    const page = performance.now() / 1000;
    const server = this.serverClock.at(page);
    if (server === null) return null;
    this.clock.follow(page, this.speech.heard() ?? server - PLAYOUT_DELAY);
    return this.clock.at(page);
  }

  private async loadWorld(): Promise<void> {
    const response = await fetch(new URL("world", document.baseURI));
    if (response.ok) this.world.show((await response.json()) as WorldState);
    else this.status.say(`The world could not be loaded (HTTP ${response.status}).`);
  }

  private bindButtons(): void {
    const showSound = (): void => {
      this.soundButton.hidden = this.audio.state === "running";
    };
    this.audio.addEventListener("statechange", showSound);
    showSound();
    // A browser lets a page sound only after its user touched it: any gesture will do, the button says so.
    const resume = (): void => void this.audio.resume();
    for (const gesture of ["pointerdown", "keydown"]) document.addEventListener(gesture, resume);
    this.demoButton.addEventListener("click", () => {
      this.connection.request({ type: "demo" }).catch((error: unknown) => {
        this.status.say(sentenceOf(error));
      });
    });
  }
}
