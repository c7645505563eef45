import { beforeEach, describe, expect, it, vi } from "vitest";

import { SpaceKey } from "../src/space_key";

class Key extends Event {
  constructor(
    type: "keydown" | "keyup",
    readonly code = "Space",
    readonly repeat = false,
  ) {
    super(type, { cancelable: true });
  }
}

describe("the space bar", () => {
  const onMove = vi.fn();
  let keys: EventTarget;
  let focus: string | null;

  beforeEach(() => {
    onMove.mockReset();
    keys = new EventTarget();
    focus = null;
    new SpaceKey(keys, () => focus === null, onMove);
  });

  it("is pressed and released", () => {
    keys.dispatchEvent(new Key("keydown"));
    expect(onMove.mock.calls).toEqual([["press"]]);
    keys.dispatchEvent(new Key("keyup"));
    expect(onMove.mock.calls).toEqual([["press"], ["release"]]);
  });

  it("is pressed once however long it is held, and does not scroll the page", () => {
    const held = [new Key("keydown"), new Key("keydown", "Space", true), new Key("keydown", "Space", true)];
    for (const key of held) keys.dispatchEvent(key);
    expect(onMove.mock.calls).toEqual([["press"]]);
    expect(held.map((key) => key.defaultPrevented)).toEqual([true, true, true]);
  });

  it("belongs to what has the focus", () => {
    focus = "text";
    const typed = new Key("keydown");
    keys.dispatchEvent(typed);
    keys.dispatchEvent(new Key("keyup"));
    expect(typed.defaultPrevented).toBe(false);
    expect(onMove).not.toHaveBeenCalled();
  });

  it("is released wherever the focus went, and when the window lost it", () => {
    keys.dispatchEvent(new Key("keydown"));
    focus = "text";
    keys.dispatchEvent(new Key("keyup"));
    focus = null;
    keys.dispatchEvent(new Key("keydown"));
    keys.dispatchEvent(new Event("blur"));
    keys.dispatchEvent(new Key("keyup"));
    expect(onMove.mock.calls).toEqual([["press"], ["release"], ["press"], ["release"]]);
  });

  it("is no other key", () => {
    keys.dispatchEvent(new Key("keydown", "Enter"));
    keys.dispatchEvent(new Key("keyup", "Enter"));
    expect(onMove).not.toHaveBeenCalled();
  });
});
