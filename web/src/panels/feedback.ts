import { create, element, seconds } from "../dom";
import type { Feedback } from "../protocol";

/** Rows kept; older ones are removed. */
const ROWS = 300;

/** Distance from the bottom within which the log scrolls along with new rows, pixels. */
const FOLLOWING = 24;

type FeedbackKind = "block" | "sync" | "prediction" | "warning" | "fall" | "other";

const KINDS: Record<string, FeedbackKind> = {
  blockProgress: "block",
  syncPointProgress: "sync",
  predictionFeedback: "prediction",
  warningFeedback: "warning",
  fall: "fall",
};

/** A feedback message as one line: its kind, its subject and its content. */
interface Summary {
  kind: FeedbackKind;
  about: string;
  detail: string;
}

/** The log of feedback: one row per message, which opens to the message's XML. It is laid out when it is drawn. */
export class FeedbackPanel {
  /** Number of messages so far. */
  count = 0;
  /** What has come since the log was drawn: messages, and sentences between them. */
  private waiting: (Feedback | string)[] = [];
  private readonly log = element("feedback", HTMLElement);
  /** Whether the log scrolls along with new rows; false while the user has scrolled back. */
  private following = true;

  constructor() {
    this.log.addEventListener("scroll", () => {
      const { scrollHeight, scrollTop, clientHeight } = this.log;
      this.following = scrollHeight - scrollTop - clientHeight < FOLLOWING;
    });
    // Rows that were added while the log was hidden did not scroll it.
    new ResizeObserver(() => {
      this.follow();
    }).observe(this.log);
  }

  add(feedback: Feedback): void {
    this.count++;
    this.keep(feedback);
  }

  /** Marks the beginning of a new session of the realizer. */
  mark(sentence: string): void {
    this.keep(sentence);
  }

  /** Draws what has come since the last call; called once an animation frame. */
  draw(): void {
    if (this.waiting.length === 0) return;
    this.log.querySelector(".empty")?.remove();
    this.log.append(...this.waiting.map(lineOf));
    this.waiting = [];
    while (this.log.childElementCount > ROWS) this.log.firstElementChild?.remove();
    this.follow();
  }

  /** Keeps as much as there are rows: a page in the background is not drawn. */
  private keep(entry: Feedback | string): void {
    this.waiting.push(entry);
    if (this.waiting.length > ROWS) this.waiting.shift();
  }

  private follow(): void {
    if (this.following) this.log.scrollTop = this.log.scrollHeight;
  }
}

function lineOf(entry: Feedback | string): HTMLElement {
  return typeof entry === "string" ? create("p", "mark", entry) : row(entry, summarize(entry));
}

function row(feedback: Feedback, { kind, about, detail }: Summary): HTMLElement {
  const details = create("details", `row ${kind}`);
  const what = create("span", "what", about);
  what.append(create("span", "detail", detail));
  const line = create("summary");
  line.append(create("time", "", seconds(feedback.time)), create("span", "kind", kind), what);
  details.append(line, create("pre", "", feedback.xml));
  return details;
}

/** Reads the BML 1.0 form of a feedback message. */
function summarize(feedback: Feedback): Summary {
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
    case "fall":
      return { kind, about: attribute(root, "id"), detail: `${attribute(root, "characterId")} has fallen` };
    case "other":
      return { kind, about: root.localName, detail: "" };
  }
}

/** The first block of a prediction with its predicted span; without a block, the number of behaviors. */
function prediction(root: Element): Omit<Summary, "kind"> {
  const block = [...root.children].find((child) => child.localName === "bml");
  if (block === undefined) return { about: `${root.children.length} behaviors`, detail: "" };
  const span = ["globalStart", "globalEnd"].map((name) => time(attribute(block, name)));
  return { about: attribute(block, "id"), detail: `${span.join(" to ")} ${attribute(block, "status")}`.trim() };
}

function time(value: string): string {
  return seconds(value === "" ? null : Number(value));
}

/** An attribute by its local name, in any namespace; empty when it is absent. */
function attribute(element: Element, localName: string): string {
  return [...element.attributes].find((candidate) => candidate.localName === localName)?.value ?? "";
}
