import type { ServerMessage } from "../src/protocol";

/** Stands for the browser's WebSocket; the test plays the server. */
export class FakeSocket {
  static opened: FakeSocket[] = [];

  onmessage: ((event: { data: ArrayBuffer | string }) => void) | null = null;
  onclose: (() => void) | null = null;
  readonly sent: Record<string, unknown>[] = [];

  constructor(readonly url: URL) {
    FakeSocket.opened.push(this);
  }

  static get last(): FakeSocket {
    const socket = FakeSocket.opened.at(-1);
    if (socket === undefined) throw new Error("no socket was opened");
    return socket;
  }

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }

  close(): void {
    this.onclose?.();
  }

  deliver(message: ServerMessage): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }

  deliverBinary(data: ArrayBuffer): void {
    this.onmessage?.({ data });
  }

  greet(session: string): void {
    this.deliver({ type: "hello", protocol: 2, version: "0", session, time: 4, tick: 400, characters: [] });
  }

  feedback(session: string, seq: number): void {
    this.deliver({ type: "feedback", session, seq, time: 0, xml: "<x/>" });
  }
}
