/** Helpers for the page's document, and for text that people read. */

/** The element with this id; throws when the page has none of this kind. */
export function element<E extends HTMLElement>(id: string, kind: abstract new () => E): E {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${kind.name} #${id}`);
  return found;
}

/** A new element; `text` is shown as it is, never parsed as markup. */
export function create<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  className = "",
  text = "",
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  made.className = className;
  made.textContent = text;
  return made;
}

/** Makes a row of tabs: each button shows the panel that it controls and hides the others. */
export function makeTabs(ids: readonly string[]): void {
  const tabs = ids.map((id) => element(id, HTMLButtonElement));
  for (const tab of tabs) {
    tab.addEventListener("click", () => {
      for (const other of tabs) select(other, other === tab);
    });
  }
}

function select(tab: HTMLButtonElement, selected: boolean): void {
  tab.setAttribute("aria-selected", String(selected));
  element(tab.getAttribute("aria-controls") ?? "", HTMLElement).hidden = !selected;
}

/** A time as text, in seconds; a dash when it is unknown. */
export function seconds(time: number | null): string {
  return time === null ? "–" : time.toFixed(2);
}

/** A failure as a sentence. */
export function sentenceOf(reason: unknown): string {
  return reason instanceof Error ? reason.message : String(reason);
}
