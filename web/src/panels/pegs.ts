import { create, element, seconds } from "../dom";
import type { Board, Commit, Peg } from "../protocol";

/** Most rows shown: a board may hold thousands of pegs. */
const PEGS = 200;
const COMMITS = 50;
const CHANGES = 6;

/**
 * The pegs of the board as a list, and the last commits: which pegs moved, from when to when, and why. It is laid out
 * when it is drawn, and only while it is visible.
 */
export class PegsPanel {
  private readonly panel = element("pegs", HTMLElement);
  private readonly rows = element("pegs-rows", HTMLTableSectionElement);
  private readonly more = element("pegs-more", HTMLElement);
  private readonly commits = element("commits", HTMLOListElement);

  private pegs: Peg[] = [];
  /** The last commits, oldest first. */
  private recent: Commit[] = [];
  private moved = new Set<string>();
  private changed = false;

  take({ pegs, commits }: Board): void {
    this.pegs = pegs;
    this.recent = [...this.recent, ...commits].slice(-COMMITS);
    this.moved = new Set(commits.flatMap(({ changes }) => changes.map(([key]) => key)));
    this.changed = true;
  }

  /** Removes all pegs and commits: the realizer is new. */
  clear(): void {
    this.pegs = this.recent = [];
    this.changed = true;
  }

  /** Draws what has changed since the last call; called once an animation frame. */
  draw(): void {
    if (!this.changed || this.panel.hidden) return;
    this.changed = false;
    const shown = this.pegs.slice(0, PEGS);
    this.rows.replaceChildren(...shown.map((peg) => pegRow(peg, this.moved.has(peg.key))));
    const hidden = this.pegs.length - shown.length;
    this.more.textContent = this.pegs.length === 0 ? "No pegs." : hidden > 0 ? `and ${hidden} more` : "";
    this.commits.replaceChildren(...this.recent.map(commitItem).reverse());
  }
}

function pegRow(peg: Peg, moved: boolean): HTMLElement {
  const row = create("tr", moved ? "moved" : "");
  const point = create("td", `peg ${peg.state}`, peg.key);
  point.title = peg.state;
  point.append(create("span", "source", peg.source));
  row.append(create("td", "number", seconds(peg.time)), point);
  return row;
}

function commitItem(commit: Commit): HTMLElement {
  const item = create("li");
  item.append(create("time", "", seconds(commit.time)), create("span", "cause", commit.cause));
  const list = create("ul");
  for (const [key, before, after] of commit.changes.slice(0, CHANGES)) {
    list.append(create("li", "", `${key}  ${seconds(before)} → ${seconds(after)}`));
  }
  if (commit.changes.length > CHANGES) list.append(create("li", "", `and ${commit.changes.length - CHANGES} more`));
  item.append(list);
  return item;
}
