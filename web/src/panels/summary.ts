import { seconds } from "../dom";
import type { Feedback } from "../protocol";

export type FeedbackKind = "block" | "sync" | "prediction" | "warning" | "other";

/** A feedback message as one line: which kind, about what, and what of it. */
export interface Summary {
  kind: FeedbackKind;
  about: string;
  detail: string;
}

const KINDS: Record<string, FeedbackKind> = {
  blockProgress: "block",
  syncPointProgress: "sync",
  predictionFeedback: "prediction",
  warningFeedback: "warning",
};

/** Reads the BML 1.0 form of a feedback message. */
export function summarize(feedback: Feedback): Summary {
  const root = new DOMParser().parseFromString(feedback.xml, "application/xml").documentElement;
  const kind = KINDS[root.localName] ?? "other";
  switch (kind) {
    case "block":
      return { kind, about: attribute(root, "id"), detail: attribute(root, "status") };
    case "sync":
      return { kind, about: attribute(root, "id"), detail: `+${seconds(Number(attribute(root, "time")))}` };
    case "prediction":
      return { kind, ...prediction(root) };
    case "warning":
      return { kind, about: attribute(root, "id"), detail: `${attribute(root, "type")}: ${root.textContent.trim()}` };
    case "other":
      return { kind, about: root.localName, detail: "" };
  }
}

/** The block that a prediction is about, or of several the first, with its span. */
function prediction(root: Element): Omit<Summary, "kind"> {
  const block = [...root.children].find((child) => child.localName === "bml");
  if (block === undefined) return { about: `${root.children.length} behaviors`, detail: "" };
  const span = ["globalStart", "globalEnd"].map((name) => time(attribute(block, name)));
  return { about: attribute(block, "id"), detail: `${span.join(" to ")} ${attribute(block, "status")}`.trim() };
}

function time(value: string): string {
  return seconds(value === "" ? null : Number(value));
}

/** An attribute by its local name, in whatever namespace; empty when it is not there. */
function attribute(element: Element, localName: string): string {
  return [...element.attributes].find((candidate) => candidate.localName === localName)?.value ?? "";
}
