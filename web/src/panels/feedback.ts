import { create, element, seconds } from "../dom";
import type { Feedback } from "../protocol";
import { summarize, type Summary } from "./summary";

/** Rows kept; older ones go. */
const ROWS = 300;

/** Distance from the bottom, in pixels, within which the log goes along with what comes. */
const FOLLOWING = 24;

/** The log of feedback: a line a message, which opens to the message itself. */
export class FeedbackPanel {
  /** Number of messages so far. */
  count = 0;
  private readonly log = element("feedback", HTMLElement);
  /** Whether the log goes along with what comes: it does unless the user scrolls back. */
  private following = true;

  constructor() {
    this.log.addEventListener("scroll", () => {
      const { scrollHeight, scrollTop, clientHeight } = this.log;
      this.following = scrollHeight - scrollTop - clientHeight < FOLLOWING;
    });
    // What came while the log was hidden did not move it.
    new ResizeObserver(() => {
      this.follow();
    }).observe(this.log);
  }

  add(feedback: Feedback): void {
    this.count++;
    this.append(row(feedback, summarize(feedback)));
  }

  /** Marks in the log that a new session of the realizer began. */
  mark(sentence: string): void {
    this.append(create("p", "mark", sentence));
  }

  private append(line: HTMLElement): void {
    this.log.querySelector(".empty")?.remove();
    this.log.append(line);
    if (this.log.childElementCount > ROWS) this.log.firstElementChild?.remove();
    this.follow();
  }

  private follow(): void {
    if (this.following) this.log.scrollTop = this.log.scrollHeight;
  }
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
