import { element } from "../dom";

/** Makes a row of tabs: each button shows the panel that it controls and hides the others'. */
export function makeTabs(ids: readonly string[]): void {
  const tabs = ids.map((id) => element(id, HTMLButtonElement));
  for (const tab of tabs) {
    tab.addEventListener("click", () => {
      for (const other of tabs) show(other, other === tab);
    });
  }
}

function show(tab: HTMLButtonElement, selected: boolean): void {
  tab.setAttribute("aria-selected", String(selected));
  element(tab.getAttribute("aria-controls") ?? "", HTMLElement).hidden = !selected;
}
