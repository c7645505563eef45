import { type BinaryMessage, decode, type Frame, type Sound } from "./binary";
import type {
  Accepted,
  AudioGain,
  AudioMove,
  AudioStart,
  AudioStop,
  Bml,
  Board,
  Camera,
  Caption,
  ClientMessage,
  Demo,
  Event,
  Feedback,
  Heard,
  Hello,
  Predict,
  Push,
  Pictures,
  Ref,
  Refused,
  ServerMessage,
} from "./protocol";

/** Time before the first and the last attempts to reconnect, ms. */
const FIRST_RETRY = 500;
const LONGEST_RETRY = 8000;

/** A message about what is heard, or read. */
export type AudioMessage = AudioStart | Caption | AudioMove | AudioGain | AudioStop;

/** A message that the realizer answers. */
export type Request = Bml | Predict | Event | Push | Demo;

/** A message without an answer. */
export type Notice = Camera | Heard;

/** Receives what arrives on the connection. */
export interface ConnectionListener {
  /** The realizer greeted; `renewed` when this is a new session, so that all earlier state is void. */
  onHello(hello: Hello, renewed: boolean): void;
  onLost(): void;
  /** The frames of all characters at one time. */
  onFrames(frames: Frame[]): void;
  /** A sound, before its announcement. */
  onSound(sound: Sound): void;
  onFeedback(feedback: Feedback): void;
  onAudio(message: AudioMessage): void;
  onBoard(board: Board): void;
  onPictures(message: Pictures): void;
}

/** A request that the realizer refused, with its answer, or that lost its answer with the connection. */
export class RequestError extends Error {
  constructor(
    readonly code: string,
    message: string,
    readonly answer?: Refused,
  ) {
    super(message);
  }
}

interface Pending {
  resolve: (answer: Accepted) => void;
  reject: (error: RequestError) => void;
}

/**
 * The socket to the realizer. It reconnects by itself, waits longer each time, and asks for the feedback after the
 * last it received, so that none is lost or repeated.
 */
export class Connection {
  private socket: WebSocket | null = null;
  private session: string | null = null;
  private lastFeedback: number | null = null;
  private retryDelay = FIRST_RETRY;
  private requests = 0;
  private readonly pending = new Map<Ref, Pending>();
  private greeted = false;

  constructor(
    private readonly url: URL,
    private readonly listener: ConnectionListener,
  ) {}

  /** Whether the realizer has greeted on the current socket. */
  get connected(): boolean {
    return this.greeted;
  }

  open(): void {
    const socket = new WebSocket(this.address());
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => {
      this.receive(event.data);
    };
    socket.onclose = () => {
      this.lost();
    };
    this.socket = socket;
  }

  /** Sends a request and returns its answer; rejects with a RequestError if it is refused or the connection breaks before the answer. */
  request(request: Request): Promise<Accepted> {
    if (!this.connected) return Promise.reject(new RequestError("not_connected", "Not connected to the realizer."));
    const ref = String(++this.requests);
    return new Promise((resolve, reject) => {
      this.pending.set(ref, { resolve, reject });
      this.transmit({ ...request, ref });
    });
  }

  /** Sends a message that needs no answer; does nothing without a connection. */
  notify(message: Notice): void {
    if (this.connected) this.transmit(message);
  }

  private address(): URL {
    const url = new URL(this.url);
    if (this.lastFeedback !== null) url.searchParams.set("after", String(this.lastFeedback));
    return url;
  }

  private transmit(message: ClientMessage): void {
    this.socket?.send(JSON.stringify(message));
  }

  private receive(data: ArrayBuffer | string): void {
    if (data instanceof ArrayBuffer) this.passOn(decode(data));
    else this.dispatch(JSON.parse(data) as ServerMessage);
  }

  private passOn(message: BinaryMessage): void {
    if (message.kind === "frames") this.listener.onFrames(message.frames);
    else this.listener.onSound(message);
  }

  private dispatch(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        this.greet(message);
        break;
      case "feedback":
        this.takeFeedback(message);
        break;
      case "accepted":
        this.settle(message.ref)?.resolve(message);
        break;
      case "error":
        this.refuse(message);
        break;
      case "board":
        this.listener.onBoard(message);
        break;
      case "pictures":
        this.listener.onPictures(message);
        break;
      case "steps": // these come by a socket of their own
      case "targets": // these are for planners
        break;
      case "audio":
      case "caption":
      case "audio_move":
      case "audio_gain":
      case "audio_stop":
        this.listener.onAudio(message);
        break;
    }
  }

  private greet(hello: Hello): void {
    const renewed = hello.session !== this.session;
    const resumedElsewhere = renewed && this.lastFeedback !== null;
    this.session = hello.session;
    if (renewed) this.lastFeedback = null;
    if (resumedElsewhere) {
      // The realizer was restarted and took `after` for a number of its own session: ask again without it.
      this.session = null;
      this.socket?.close();
      return;
    }
    this.retryDelay = FIRST_RETRY;
    this.greeted = true;
    this.listener.onHello(hello, renewed);
  }

  private takeFeedback(feedback: Feedback): void {
    if (feedback.session !== this.session) return;
    if (this.lastFeedback !== null && feedback.seq <= this.lastFeedback) return;
    this.lastFeedback = feedback.seq;
    this.listener.onFeedback(feedback);
  }

  private refuse(error: Refused): void {
    const pending = error.ref === undefined ? undefined : this.settle(error.ref);
    if (pending === undefined) console.warn(`The realizer refused a message: ${error.message}`);
    else pending.reject(new RequestError(error.code, error.message, error));
  }

  private settle(ref: Ref): Pending | undefined {
    const pending = this.pending.get(ref);
    this.pending.delete(ref);
    return pending;
  }

  private lost(): void {
    this.greeted = false;
    for (const ref of [...this.pending.keys()]) {
      this.settle(ref)?.reject(new RequestError("connection_lost", "The connection was lost before the answer came."));
    }
    this.listener.onLost();
    setTimeout(() => {
      this.open();
    }, this.retryDelay);
    this.retryDelay = Math.min(2 * this.retryDelay, LONGEST_RETRY);
  }
}
