import { describe, expect, it } from "vitest";

import { FaceClock, FrameClock, heardTime, PlayoutClock, PlayoutDelay } from "../src/clock";

describe("the frame clock", () => {
  it("knows nothing before the first message", () => {
    expect(new FrameClock().at(1)).toBeNull();
  });

  it("begins with the reading of the greeting", () => {
    const clock = new FrameClock();
    clock.reset(10, 3);
    expect(clock.at(12)).toBeCloseTo(5, 9);
  });

  it("follows the frame that was delayed least", () => {
    const clock = new FrameClock();
    clock.reset(10, 3);
    clock.take(10.1, 3.2);
    clock.take(10.5, 3.3);
    expect(clock.at(11)).toBeCloseTo(4.1, 9);
  });

  it("forgets old frames, so that a latency that grows is followed", () => {
    const clock = new FrameClock();
    clock.take(0, 5);
    for (let i = 1; i <= 100; i++) clock.take(0.02 * i, 4.7 + 0.02 * i);
    expect(clock.at(3)).toBeCloseTo(7.7, 9);
  });

  it("begins anew with a new greeting", () => {
    const clock = new FrameClock();
    clock.take(100, 50);
    clock.reset(110, 0);
    expect(clock.at(111)).toBeCloseTo(1, 9);
  });
});

describe("the playout delay", () => {
  it("is 50 ms without jitter", () => {
    const delay = new PlayoutDelay();
    for (let i = 0; i < 100; i++) delay.takeFrame(0);
    expect(delay.seconds).toBeCloseTo(0.05, 9);
  });

  it("covers the jitter of all frames but a few, and a frame more", () => {
    const delay = new PlayoutDelay();
    for (let i = 0; i < 100; i++) delay.takeFrame(i === 50 ? 0.4 : (i % 11) / 100);
    expect(delay.seconds).toBeCloseTo(0.12, 9);
    for (let i = 0; i < 500; i++) delay.takeFrame(0);
    expect(delay.seconds).toBeCloseTo(0.05, 9);
  });

  it("grows by what a sound was late, to at most 300 ms, and shrinks when sounds come in time", () => {
    const delay = new PlayoutDelay();
    expect(delay.takeSound(0.04)).toBeCloseTo(0.04, 9);
    expect(delay.seconds).toBeCloseTo(0.09, 9);
    expect(delay.takeSound(0.5)).toBeCloseTo(0.21, 9);
    expect(delay.seconds).toBeCloseTo(0.3, 9);
    for (let i = 0; i < 50; i++) delay.takeSound(-0.1);
    expect(delay.seconds).toBeCloseTo(0.05, 9);
  });
});

describe("the playout clock", () => {
  it("shows nothing before it knows the time", () => {
    expect(new PlayoutClock().at(1)).toBeNull();
  });

  it("begins at the time that is due and runs on between two readings", () => {
    const clock = new PlayoutClock();
    clock.follow(100, 5);
    expect(clock.at(100)).toBeCloseTo(5, 9);
    expect(clock.at(100.5)).toBeCloseTo(5.5, 9);
  });

  it.each([0.04, -0.04])("glides over a gap of %f s at a twentieth of its rate", (gap) => {
    const clock = new PlayoutClock();
    clock.follow(0, 10);
    clock.follow(0.4, 10.4 + gap);
    expect(clock.at(0.4)).toBeCloseTo(10.4 + gap / 2, 9);
    clock.follow(1.4, 11.4 + gap);
    expect(clock.at(1.4)).toBeCloseTo(11.4 + gap, 9);
  });

  it("stays behind at once by the time that it waits", () => {
    const clock = new PlayoutClock();
    clock.follow(100, 5);
    clock.wait(0.1);
    expect(clock.at(100.5)).toBeCloseTo(5.4, 9);
  });

  it("jumps over a gap of more than a quarter of a second", () => {
    const clock = new PlayoutClock();
    clock.follow(0, 10);
    clock.follow(0.01, 3);
    expect(clock.at(0.01)).toBeCloseTo(3, 9);
  });

  it("never goes backwards while the time that is due comes in coarse steps", () => {
    const clock = new PlayoutClock();
    let last = -Infinity;
    for (let page = 0; page < 1; page += 1 / 60) {
      clock.follow(page, Math.floor(page / 0.01) * 0.01);
      const shown = clock.at(page) ?? -Infinity;
      expect(shown).toBeGreaterThan(last);
      last = shown;
    }
  });
});

describe("what is heard", () => {
  it("was played one output latency ago", () => {
    expect(heardTime({ currentTime: 3, outputLatency: 0.04, baseLatency: 0.01 })).toBeCloseTo(2.96, 9);
  });
});

describe("the face clock", () => {
  it("shows the time of what is heard, within limits", () => {
    const face = new FaceClock();
    expect(face.at(10, 9.92)).toBeCloseTo(9.92, 9);
    expect(face.at(10.1, 12)).toBeCloseTo(10.4, 9);
  });

  it("glides back to the time shown when nothing is heard any more", () => {
    const face = new FaceClock();
    face.at(10, 9.9);
    expect(face.at(10.1, null)).toBeCloseTo(10.05, 9);
    expect(face.at(10.3, null)).toBeCloseTo(10.3, 9);
  });
});
