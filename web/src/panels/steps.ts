import type { Object3D } from "three";

import { element } from "../dom";
import type { ServerMessage } from "../protocol";
import { StepsOverlay } from "../steps";

/** Time before another attempt to connect, ms. */
const RETRY = 1000;

/** A button that shows the paths and footprints of characters. Only while it is pressed, a socket asks for them. */
export class StepsPanel {
  private readonly button = element("steps-switch", HTMLButtonElement);
  private readonly overlays = new Map<string, StepsOverlay>();
  private socket: WebSocket | null = null;

  constructor(
    private readonly url: URL,
    private readonly scene: Object3D,
  ) {
    this.button.addEventListener("click", () => {
      if (this.shown) this.hide();
      else this.show();
    });
  }

  /** Number of footprints of a character that are shown. */
  footprints(character: string): number {
    return this.overlays.get(character)?.count ?? 0;
  }

  private get shown(): boolean {
    return this.button.ariaPressed === "true";
  }

  private show(): void {
    this.button.ariaPressed = "true";
    this.connect();
  }

  private hide(): void {
    this.button.ariaPressed = "false";
    this.socket?.close();
    this.socket = null;
    this.clear();
  }

  private connect(): void {
    const socket = new WebSocket(this.url);
    socket.onmessage = (event: MessageEvent<string>) => {
      if (socket === this.socket) this.take(JSON.parse(event.data) as ServerMessage);
    };
    socket.onclose = () => {
      if (socket !== this.socket) return;
      this.clear();
      setTimeout(() => {
        if (socket === this.socket) this.connect();
      }, RETRY);
    };
    this.socket = socket;
  }

  private take(message: ServerMessage): void {
    if (message.type !== "steps") return;
    let overlay = this.overlays.get(message.character);
    if (overlay === undefined) {
      overlay = new StepsOverlay(this.scene);
      this.overlays.set(message.character, overlay);
    }
    overlay.take(message);
  }

  private clear(): void {
    for (const overlay of this.overlays.values()) overlay.remove();
    this.overlays.clear();
  }
}
