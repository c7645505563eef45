import { describe, expect, it } from "vitest";

import { RequestError } from "../src/connection";
import { acceptedAnswer, lineSpan, refusedAnswer } from "../src/panels/answer";
import type { Warning } from "../src/protocol";

function warning(code: string, line?: number): Warning {
  const place = line === undefined ? {} : { line, column: 1 };
  return { id: "b:g", type: "CANNOT_CREATE_BEHAVIOR", code, message: `${code}!`, ...place };
}

describe("the answer to an accepted text", () => {
  it("is accepted without more if there are no warnings", () => {
    const answer = acceptedAnswer({ type: "accepted", ref: 1, blocks: ["b"], warnings: [] });
    expect(answer).toEqual({ state: "accepted", summary: "Accepted", mistakes: [] });
  });

  it("counts the warnings and lists them with their lines", () => {
    const one = acceptedAnswer({ type: "accepted", ref: 1, warnings: [warning("no-target", 3)] });
    expect(one.state).toBe("warned");
    expect(one.summary).toBe("Accepted, 1 warning");
    expect(one.mistakes).toEqual([{ line: 3, message: "no-target!", refused: false }]);
    const two = acceptedAnswer({ type: "accepted", ref: 1, warnings: [warning("a", 1), warning("b")] });
    expect(two.summary).toBe("Accepted, 2 warnings");
    expect(two.mistakes.map(({ line }) => line)).toEqual([1, null]);
  });

  it("counts the warnings that are not listed too", () => {
    const answer = acceptedAnswer({ type: "accepted", ref: 1, warnings: [warning("a", 1)], more_warnings: 12 });
    expect(answer.summary).toBe("Accepted, 13 warnings");
    expect(answer.mistakes.at(-1)).toEqual({ line: null, message: "12 more", refused: false });
  });
});

describe("the answer to a refused text", () => {
  function refusal(blocks: string[], warnings: Warning[]): RequestError {
    const answer = { type: "error" as const, code: "duplicate-block", message: "line 2, column 1: twice" };
    return new RequestError(answer.code, answer.message, { ...answer, blocks, warnings });
  }

  it("lists the reason as refused, beside warnings", () => {
    const answer = refusedAnswer(refusal([], [warning("duplicate-block", 2), warning("no-target", 3)]));
    expect(answer.state).toBe("refused");
    expect(answer.summary).toBe("Refused");
    expect(answer.mistakes.map(({ line, refused }) => [line, refused])).toEqual([
      [2, true],
      [3, false],
    ]);
  });

  it("names the blocks that were accepted", () => {
    const answer = refusedAnswer(refusal(["b1", "b2"], [warning("duplicate-block", 2)]));
    expect(answer.summary).toBe("Refused, except for b1, b2");
  });

  it("is the reason alone if nothing is known of the text", () => {
    const lost = new RequestError("connection_lost", "The connection was lost.");
    expect(refusedAnswer(lost)).toEqual({ state: "refused", summary: "The connection was lost.", mistakes: [] });
  });
});

describe("the span of a line", () => {
  const text = "<bml>\n  <head/>\n</bml>";

  it("is the line without its break", () => {
    const lines = [1, 2, 3].map((line) => text.slice(...lineSpan(text, line)));
    expect(lines).toEqual(["<bml>", "  <head/>", "</bml>"]);
  });

  it("is empty at the end for a line that is no longer there", () => {
    expect(lineSpan(text, 9)).toEqual([text.length, text.length]);
  });
});
