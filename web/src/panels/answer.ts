import { RequestError } from "../connection";
import { sentenceOf } from "../dom";
import type { Accepted, Warning } from "../protocol";

/** A mistake in the text of the editor; `line` is null if it has no place there. */
export interface Mistake {
  line: number | null;
  message: string;
  /** Whether something was refused because of it. */
  refused: boolean;
}

/** What the editor shows of the answer to its text. */
export interface EditorAnswer {
  state: "accepted" | "warned" | "refused";
  summary: string;
  mistakes: Mistake[];
}

/** The answer to an accepted text. */
export function acceptedAnswer({ warnings = [], more_warnings: more = 0 }: Accepted): EditorAnswer {
  const count = warnings.length + more;
  if (count === 0) return { state: "accepted", summary: "Accepted", mistakes: [] };
  const summary = `Accepted, ${count} warning${count === 1 ? "" : "s"}`;
  return { state: "warned", summary, mistakes: mistakesOf(warnings, more) };
}

/** The answer to a text of which a block was refused, or that was not answered at all. */
export function refusedAnswer(reason: unknown): EditorAnswer {
  if (!(reason instanceof RequestError) || reason.answer?.warnings === undefined) {
    return { state: "refused", summary: sentenceOf(reason), mistakes: [] };
  }
  const { code, blocks = [], warnings, more_warnings: more = 0 } = reason.answer;
  const summary = blocks.length === 0 ? "Refused" : `Refused, except for ${blocks.join(", ")}`;
  return { state: "refused", summary, mistakes: mistakesOf(warnings, more, code) };
}

/** The start and the end of a line, counted from 1, in a text. */
export function lineSpan(text: string, line: number): [start: number, end: number] {
  const before = text.split("\n").slice(0, line - 1);
  const start = Math.min(
    before.reduce((length, each) => length + each.length + 1, 0),
    text.length,
  );
  const end = text.indexOf("\n", start);
  return [start, end === -1 ? text.length : end];
}

function mistakesOf(warnings: Warning[], more: number, refusal?: string): Mistake[] {
  const mistakes: Mistake[] = warnings.map(({ code, line = null, message }) => ({
    line,
    message,
    refused: code === refusal,
  }));
  return more === 0 ? mistakes : [...mistakes, { line: null, message: `${more} more`, refused: false }];
}
