import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { Connection, RequestError } from "../src/connection";
import type { Refused, ServerMessage } from "../src/protocol";
import { FakeSocket } from "./fake_socket";
import { encodeFrame } from "./frames";

const listener = {
  onHello: vi.fn(),
  onLost: vi.fn(),
  onFrames: vi.fn(),
  onSound: vi.fn(),
  onFeedback: vi.fn(),
  onAudio: vi.fn(),
  onBoard: vi.fn(),
  onPictures: vi.fn(),
};

function opened(): Connection {
  const connection = new Connection(new URL("ws://host/ws?streams=feedback"), listener);
  connection.open();
  return connection;
}

/** The feedback numbers that the page has been handed. */
function handedOn(): number[] {
  return listener.onFeedback.mock.calls.map(([feedback]: { seq: number }[]) => feedback?.seq ?? NaN);
}

beforeEach(() => {
  vi.useFakeTimers();
  vi.clearAllMocks();
  vi.stubGlobal("WebSocket", FakeSocket);
  FakeSocket.opened = [];
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("a connection", () => {
  it("is one only when the realizer has greeted", () => {
    const connection = opened();
    expect(connection.connected).toBe(false);
    FakeSocket.last.greet("a");
    expect(connection.connected).toBe(true);
    expect(listener.onHello).toHaveBeenCalledWith(expect.objectContaining({ session: "a" }), true);
  });

  it("asks for no past feedback at first", () => {
    opened();
    expect(FakeSocket.last.url.href).toBe("ws://host/ws?streams=feedback");
  });

  it("hands on frames, sound and the board", () => {
    opened();
    FakeSocket.last.greet("a");
    FakeSocket.last.deliverBinary(encodeFrame({ time: 2 }));
    FakeSocket.last.deliverBinary(new Uint8Array([2, 1, 1, 0, 115, 82, 73]).buffer);
    FakeSocket.last.deliver({ type: "audio_move", id: "s", start: 3, time: 2.5 });
    FakeSocket.last.deliver({ type: "board", time: 1, pegs: [], commits: [] });
    expect(listener.onFrames).toHaveBeenCalledWith([expect.objectContaining({ time: 2 })]);
    expect(listener.onSound).toHaveBeenCalledWith(expect.objectContaining({ id: "s" }));
    expect(listener.onAudio).toHaveBeenCalledWith({ type: "audio_move", id: "s", start: 3, time: 2.5 });
    expect(listener.onBoard).toHaveBeenCalledOnce();
  });
});

describe("a request", () => {
  it("is fulfilled with the answer when the realizer accepts it", async () => {
    const connection = opened();
    FakeSocket.last.greet("a");
    const request = connection.request({ type: "bml", xml: "<bml/>" });
    expect(FakeSocket.last.sent).toEqual([{ type: "bml", xml: "<bml/>", ref: "1" }]);
    const answer: ServerMessage = { type: "accepted", ref: "1", blocks: ["b"], warnings: [] };
    FakeSocket.last.deliver(answer);
    await expect(request).resolves.toEqual(answer);
  });

  it("is rejected with the realizer's words when that refuses it", async () => {
    const connection = opened();
    FakeSocket.last.greet("a");
    const request = connection.request({ type: "demo" });
    const answer: Refused = { type: "error", ref: "1", code: "busy", message: "The demo is playing." };
    FakeSocket.last.deliver(answer);
    await expect(request).rejects.toEqual(new RequestError("busy", "The demo is playing.", answer));
  });

  it("is rejected when the connection breaks before the answer", async () => {
    const connection = opened();
    FakeSocket.last.greet("a");
    const request = connection.request({ type: "demo" });
    FakeSocket.last.close();
    await expect(request).rejects.toMatchObject({ code: "connection_lost" });
  });

  it("is rejected at once without a connection", async () => {
    await expect(opened().request({ type: "demo" })).rejects.toMatchObject({ code: "not_connected" });
    expect(FakeSocket.last.sent).toEqual([]);
  });
});

describe("a lost connection", () => {
  it("is tried again, waiting twice as long each time, eight seconds at most", () => {
    opened();
    for (const delay of [500, 1000, 2000, 4000, 8000, 8000]) {
      const tries = FakeSocket.opened.length;
      FakeSocket.last.close();
      vi.advanceTimersByTime(delay - 1);
      expect(FakeSocket.opened).toHaveLength(tries);
      vi.advanceTimersByTime(1);
      expect(FakeSocket.opened).toHaveLength(tries + 1);
    }
  });

  it("is tried again soon after one that stood", () => {
    opened();
    FakeSocket.last.close();
    vi.advanceTimersByTime(500);
    FakeSocket.last.greet("a");
    FakeSocket.last.close();
    vi.advanceTimersByTime(500);
    expect(FakeSocket.opened).toHaveLength(3);
  });

  it("is said", () => {
    const connection = opened();
    FakeSocket.last.greet("a");
    FakeSocket.last.close();
    expect(listener.onLost).toHaveBeenCalled();
    expect(connection.connected).toBe(false);
  });

  it("resumes after the last feedback seen, and keeps the session", () => {
    opened();
    FakeSocket.last.greet("a");
    FakeSocket.last.feedback("a", 41);
    FakeSocket.last.feedback("a", 42);
    FakeSocket.last.close();
    vi.advanceTimersByTime(500);
    expect(FakeSocket.last.url.searchParams.get("after")).toBe("42");
    FakeSocket.last.greet("a");
    expect(listener.onHello).toHaveBeenLastCalledWith(expect.anything(), false);
    FakeSocket.last.feedback("a", 42);
    FakeSocket.last.feedback("a", 43);
    expect(handedOn()).toEqual([41, 42, 43]);
  });

  it("asks anew, without a past, when the realizer was restarted meanwhile", () => {
    opened();
    FakeSocket.last.greet("a");
    FakeSocket.last.feedback("a", 42);
    FakeSocket.last.close();
    vi.advanceTimersByTime(500);
    FakeSocket.last.greet("b");
    FakeSocket.last.feedback("b", 43);
    vi.advanceTimersByTime(1000);
    expect(FakeSocket.opened).toHaveLength(3);
    expect(FakeSocket.last.url.searchParams.has("after")).toBe(false);
    FakeSocket.last.greet("b");
    FakeSocket.last.feedback("b", 1);
    expect(listener.onHello).toHaveBeenLastCalledWith(expect.objectContaining({ session: "b" }), true);
    expect(handedOn()).toEqual([42, 1]);
  });
});
