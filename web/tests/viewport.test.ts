import { describe, expect, it, vi } from "vitest";

import { CameraReport } from "../src/viewport";

describe("the camera report", () => {
  it("sends the first position at once and a resting camera only once", () => {
    const send = vi.fn();
    const report = new CameraReport(send);
    for (let page = 0; page < 2000; page += 16) report.update(page, [0, 1.6, 2]);
    expect(send).toHaveBeenCalledExactlyOnceWith([0, 1.6, 2]);
  });

  it("sends a moving camera at most five times a second, and last the position where it stops", () => {
    const send = vi.fn();
    const report = new CameraReport(send);
    for (let page = 0; page < 2000; page += 10) report.update(page, [Math.min(page, 1100) / 1000, 1.6, 2]);
    expect(send).toHaveBeenCalledTimes(7);
    expect(send).toHaveBeenLastCalledWith([1.1, 1.6, 2]);
  });

  it("sends the position again to a new realizer", () => {
    const send = vi.fn();
    const report = new CameraReport(send);
    report.update(0, [0, 1.6, 2]);
    report.reset();
    report.update(1000, [0, 1.6, 2]);
    expect(send).toHaveBeenCalledTimes(2);
  });
});
