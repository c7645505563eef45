import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { PlayoutClock, PlayoutDelay } from "../src/clock";
import type { AudioMove, AudioStart } from "../src/protocol";
import { SpeechPlayer } from "../src/speech";
import { FakeAudio, played } from "./fake_audio";

const LATENCY = 0.04;

/** A page at realizer time `shown`, whose sound card is at `audioTime`. */
function playerAt(shown: number, audioTime: number): { player: SpeechPlayer; audio: FakeAudio; failures: string[] } {
  const clock = new PlayoutClock();
  clock.follow(performance.now() / 1000, shown);
  const audio = new FakeAudio(audioTime, LATENCY);
  const failures: string[] = [];
  const player = new SpeechPlayer(audio as unknown as AudioContext, clock, new PlayoutDelay(), (reason) =>
    failures.push(String(reason)),
  );
  return { player, audio, failures };
}

/** The position that is reported next, null if none is. */
function reported(player: SpeechPlayer): number | null {
  vi.advanceTimersByTime(300);
  return player.report()[0]?.position ?? null;
}

function announced(start: number, duration = 2): AudioStart {
  return { type: "audio", character: "alice", id: "s1", url: "/audio/s1.wav", start, duration, gain: 0.8 };
}

/** A new start, which the frames from `time` on show. */
function moved(start: number, time: number): AudioMove {
  return { type: "audio_move", id: "s1", start, time };
}

/** Has the player play a speech that is planned for `start`. */
async function spoken(player: SpeechPlayer, start: number): Promise<void> {
  player.handle({ ...announced(start), type: "caption", text: "One.", words: [] });
  player.handle(announced(start));
  await played.settled();
}

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("fetch", () => Promise.resolve(new Response(new ArrayBuffer(4))));
  vi.stubGlobal("GainNode", played.GainNode);
  vi.stubGlobal("AudioBufferSourceNode", played.Source);
  played.reset();
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("speech", () => {
  it("is scheduled such that it is heard, and not only played, at its realizer time", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    expect(played.last.at).toBeCloseTo(3.5 - LATENCY, 9);
    expect(played.last.offset).toBe(0);
    expect(player.records[0]).toMatchObject({ id: "s1", start: 10.5, end: 12.5 });
  });

  it("is not fetched when it was sent before its announcement", async () => {
    const fetched = vi.fn();
    vi.stubGlobal("fetch", fetched);
    const { player } = playerAt(10, 3);
    player.take({ id: "s1", wav: new ArrayBuffer(4) });
    player.handle(announced(10.5));
    await played.settled();
    expect(played.last.at).toBeCloseTo(3.5 - LATENCY, 9);
    expect(fetched).not.toHaveBeenCalled();
  });

  it("waits for a start that is not known yet", async () => {
    const { player } = playerAt(10, 3);
    player.handle({ ...announced(0), start: null });
    await played.settled();
    expect(played.sources).toEqual([]);
    player.handle(moved(10.5, 10));
    expect(played.last.at).toBeCloseTo(3.5 - LATENCY, 9);
  });

  it("is played from its first word when it comes late, which is reported", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10.2));
    audio.currentTime = 3.7;
    vi.advanceTimersByTime(700);
    await played.settled();
    expect(played.last).toMatchObject({ at: 3.7, offset: 0 });
    audio.currentTime = 4;
    expect(reported(player)).toBeCloseTo(0.3 - LATENCY, 9);
  });

  it("is joined in the middle when it comes too late for the realizer to follow", async () => {
    const { player } = playerAt(12, 3);
    player.handle(announced(10.5));
    await played.settled();
    expect(played.last.at).toBe(3);
    expect(played.last.offset).toBeCloseTo(1.5 + LATENCY, 9);
  });

  it("is not played any more when its end has passed", async () => {
    const { player } = playerAt(20, 3);
    player.handle(announced(10.5));
    await played.settled();
    expect(played.sources).toEqual([]);
  });

  it("waits while the browser forbids sound and is joined late when that is lifted", async () => {
    const { player, audio } = playerAt(11, 0);
    audio.state = "suspended";
    player.handle(announced(10.5));
    await played.settled();
    expect(played.sources).toEqual([]);
    audio.change("running");
    expect(played.last.offset).toBeCloseTo(0.5 + LATENCY, 9);
  });

  it("is reported, with the time that is shown, exactly while it is heard", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    audio.currentTime += 0.3;
    expect(reported(player)).toBeNull();
    audio.currentTime = 4.5;
    expect(reported(player)).toBeCloseTo(1, 9);
    audio.currentTime = 5.6;
    expect(reported(player)).toBeNull();
  });

  it("is scheduled again when the playout clock has changed before it begins", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(11));
    await played.settled();
    expect(played.last.at).toBeCloseTo(4 - LATENCY, 9);
    vi.advanceTimersByTime(100);
    player.report();
    expect(played.last.at).toBeCloseTo(3.9 - LATENCY, 9);
  });

  it("is reported twice soon after it began late", async () => {
    const { player, audio } = playerAt(1.3, 10);
    player.handle(announced(1));
    await vi.advanceTimersByTimeAsync(0);
    const reports = Array.from({ length: 30 }, () => {
      vi.advanceTimersByTime(10);
      audio.currentTime += 0.01;
      return player.report().length;
    });
    expect(reports.reduce((sum, number) => sum + number, 0)).toBe(2);
  });

  it("is reported four times a second", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10.05));
    await played.settled();
    audio.currentTime = 3.1;
    const reports = Array.from({ length: 60 }, () => {
      vi.advanceTimersByTime(1000 / 60);
      return player.report();
    }).flat();
    expect(reports).toHaveLength(4);
    expect(reports[0]).toMatchObject({
      type: "heard",
      id: "s1",
      position: expect.closeTo(0.09 - LATENCY, 9) as number,
    });
    expect((reports[1]?.time ?? 0) - (reports[0]?.time ?? 0)).toBeCloseTo(0.25, 1);
  });

  it("is not reported while the browser forbids sound", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10));
    await played.settled();
    audio.currentTime = 3.5;
    audio.state = "suspended";
    expect(reported(player)).toBeNull();
  });

  it("goes on when the plan moves to what is heard", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10));
    await played.settled();
    audio.currentTime = 3.4; // 0.2 s late
    vi.advanceTimersByTime(600);
    player.handle(moved(10.2, 10.6));
    expect(played.sources).toHaveLength(1);
    expect(player.records[0]).toMatchObject({ start: 10.2, end: 12.2 });
    player.handle({ type: "audio_stop", id: "s1", time: 11.2, fade: 0 });
    expect(played.last.stoppedAt).toBeCloseTo(4, 9);
  });

  it("skips when the plan moves away from what is heard", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10));
    await played.settled();
    audio.currentTime = 3.6;
    vi.advanceTimersByTime(600);
    player.handle(moved(10.2, 10.6));
    expect(played.sources).toHaveLength(2);
    expect(played.last.offset).toBeCloseTo(0.4, 9);
  });

  it("skips to its place when the realizer does not follow it", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10, 5));
    await played.settled();
    for (let step = 1; step <= 7; step++) {
      vi.advanceTimersByTime(260);
      audio.currentTime = 3 + 0.26 * step - 0.1;
      player.report();
      expect(played.sources).toHaveLength(1);
    }
    vi.advanceTimersByTime(260);
    audio.currentTime = 4.98;
    player.report();
    expect(played.sources).toHaveLength(2);
  });

  it("is scheduled anew when it moves", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    const first = played.last;
    player.handle(moved(10.8, 10));
    expect(first.stopped).toBe(true);
    expect(played.sources).toHaveLength(2);
    expect(played.last.at).toBeCloseTo(3.8 - LATENCY, 9);
  });

  it("falls silent at the time it is stopped at, within the fade", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    player.handle({ type: "audio_stop", id: "s1", time: 11, fade: 0.1 });
    expect(played.last.stoppedAt).toBeCloseTo(4.1 - LATENCY, 9);
    audio.currentTime = 4.05;
    expect(reported(player)).toBeCloseTo(0.55, 9);
    audio.currentTime = 4.3;
    expect(reported(player)).toBeNull();
  });

  it("is not heard at all when it is stopped before it begins, or as it begins", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    player.handle({ type: "audio_stop", id: "s1", time: 10.5, fade: 0.1 });
    expect(played.last.stopped).toBe(true);
    expect(played.last.stoppedAt).toBeUndefined();
  });

  it("stays silent when it was stopped before its sound had come", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    player.handle({ type: "audio_stop", id: "s1", time: 10, fade: 0 });
    await played.settled();
    expect(played.sources).toEqual([]);
  });

  it("glides to another gain when the realizer time of that is heard", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    player.handle({ type: "audio_gain", id: "s1", gain: 0.2, time: 11 });
    expect(played.gains.at(-1)?.initial).toBe(0.8);
    expect(played.gains.at(-1)?.told).toMatchObject([{ gain: 0.2, sudden: false }]);
    expect(played.gains.at(-1)?.told[0]?.at).toBeCloseTo(4 - LATENCY, 9);
  });

  it("glides at once to a gain whose time was heard already", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    audio.currentTime = 4.5;
    player.handle({ type: "audio_gain", id: "s1", gain: 0.2, time: 11 });
    expect(played.gains.at(-1)?.told).toEqual([{ gain: 0.2, at: 4.5, sudden: false }]);
  });

  it("has the gain of its start from its first sample on", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    player.handle({ type: "audio_gain", id: "s1", gain: 0, time: 10.5 });
    expect(played.gains.at(-1)?.told).toMatchObject([{ gain: 0, sudden: true }]);
    expect(played.gains.at(-1)?.told[0]?.at).toBeCloseTo(3.5 - LATENCY, 9);
  });

  it("goes through the gains that were told before its sound had come", async () => {
    const { player } = playerAt(12, 3);
    player.handle(announced(10.5));
    player.handle({ type: "audio_gain", id: "s1", gain: 0.4, time: 11.9 });
    player.handle({ type: "audio_gain", id: "s1", gain: 0.2, time: 12.3 });
    await played.settled();
    expect(played.gains.at(-1)?.initial).toBe(0.4);
    expect(played.gains.at(-1)?.told.map(({ gain }) => gain)).toEqual([0.2]);
  });

  it("that cannot be fetched is said by name", async () => {
    vi.stubGlobal("fetch", () => Promise.resolve(new Response(null, { status: 404 })));
    const { player, failures } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    expect(failures).toEqual(["Error: The audio of s1 could not be loaded (HTTP 404)."]);
  });

  it("remembers the last twenty pieces", async () => {
    const { player } = playerAt(10, 3);
    for (let i = 0; i < 25; i++) player.handle({ ...announced(10), id: `s${i}` });
    await played.settled();
    expect(player.records.map(({ id }) => id)).toEqual(Array.from({ length: 20 }, (_, i) => `s${i + 5}`));
  });

  it("is forgotten with the realizer that announced it", async () => {
    const { player } = playerAt(10, 3);
    player.handle(announced(10.5));
    await played.settled();
    player.clear();
    expect(played.last.stopped).toBe(true);
    expect(player.records).toEqual([]);
  });
});

describe("the face of a speech", () => {
  /** Has the audio clock play the last sound until a position is heard, s. */
  function hear(audio: FakeAudio, position: number): void {
    audio.currentTime = played.last.at + position + LATENCY;
  }

  it("is that of the frame which shows the position that is heard", async () => {
    const { player, audio } = playerAt(9.9, 3);
    await spoken(player, 10);
    hear(audio, 0.5);
    expect(player.frameTime("alice")).toBeCloseTo(10.5, 9);
  });

  it("is that of an earlier frame than the body while a sound plays late", async () => {
    const { player, audio } = playerAt(10.1, 3);
    await spoken(player, 10);
    hear(audio, 0);
    expect(player.frameTime("alice")).toBeCloseTo(10, 9);
  });

  it("passes without a jump to the frames that show the speech as late as it is", async () => {
    const { player, audio } = playerAt(10, 3);
    await spoken(player, 10.5);
    vi.advanceTimersByTime(1100);
    hear(audio, 0.5); // 0.1 s late
    player.handle(moved(10.6, 11.1));
    const times = [0.5, 0.59, 0.61, 0.7].map((position) => {
      hear(audio, position);
      return player.frameTime("alice");
    });
    expect(times).toEqual([11, 11.09, 11.21, 11.3].map((time) => expect.closeTo(time, 6) as number));
  });

  it("approaches its first shape before the sound, and is free after it", async () => {
    const { player, audio } = playerAt(10, 3);
    await spoken(player, 10.5);
    const times = [-0.3, -0.1, 1.9, 2.1].map((position) => {
      hear(audio, position);
      return player.frameTime("alice");
    });
    expect(times).toEqual([null, expect.closeTo(10.4, 6), expect.closeTo(12.4, 6), null]);
  });

  it("does not follow the speech of others, nor a sound that is not spoken", async () => {
    const { player, audio } = playerAt(10, 3);
    player.handle(announced(10));
    await played.settled();
    hear(audio, 0.5);
    expect(player.frameTime("alice")).toBeNull();
    await spoken(player, 10);
    hear(audio, 0.5);
    expect(player.frameTime("alice")).not.toBeNull();
    expect(player.frameTime("bert")).toBeNull();
  });
});
