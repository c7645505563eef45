import { create, element, seconds } from "../dom";
import type { Board, Commit, Peg } from "../protocol";

/** Most rows shown: a board may hold thousands of pegs. */
const PEGS = 200;
const COMMITS = 50;
const CHANGES = 6;

/** The pegs of the board as a list, and the last commits: which pegs moved, from when to when, and why. */
export class PegsPanel {
  private readonly rows = element("pegs-rows", HTMLTableSectionElement);
  private readonly more = element("pegs-more", HTMLElement);
  private readonly commits = element("commits", HTMLOListElement);

  show(board: Board): void {
    const moved = new Set(board.commits.flatMap((commit) => commit.changes.map(([key]) => key)));
    const shown = board.pegs.slice(0, PEGS);
    this.rows.replaceChildren(...shown.map((peg) => pegRow(peg, moved.has(peg.key))));
    const hidden = board.pegs.length - shown.length;
    this.more.textContent = board.pegs.length === 0 ? "No pegs." : hidden > 0 ? `and ${hidden} more` : "";
    this.commits.prepend(...board.commits.map(commitItem).reverse());
    while (this.commits.childElementCount > COMMITS) this.commits.lastElementChild?.remove();
  }

  /** Removes all pegs and commits: the realizer is new. */
  clear(): void {
    this.rows.replaceChildren();
    this.commits.replaceChildren();
    this.more.textContent = "No pegs.";
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
