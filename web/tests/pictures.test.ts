import { expect, test } from "vitest";

import { Pictures } from "../src/pictures";

const shown = (time: number, character: string, ...files: string[]) => ({
  type: "pictures" as const,
  time,
  character,
  files,
});

test("pictures are shown from the time of their message on", () => {
  const pictures = new Pictures();
  pictures.handle(shown(1, "paula", "head.png"));
  pictures.handle(shown(2, "paula", "head.png", "smile.png"));
  pictures.handle(shown(2, "pete", "hat.png"));
  expect(pictures.at(0.9)).toEqual(new Map());
  expect(pictures.at(1.5)).toEqual(new Map([["paula", ["head.png"]]]));
  expect(pictures.at(2)).toEqual(
    new Map([
      ["paula", ["head.png", "smile.png"]],
      ["pete", ["hat.png"]],
    ]),
  );
});

test("a character without pictures is shown by its body again", () => {
  const pictures = new Pictures();
  pictures.handle(shown(1, "paula", "head.png"));
  pictures.handle(shown(2, "paula"));
  expect(pictures.at(1)).toEqual(new Map([["paula", ["head.png"]]]));
  expect(pictures.at(2)).toEqual(new Map());
});

test("a new session has no pictures", () => {
  const pictures = new Pictures();
  pictures.handle(shown(1, "paula", "head.png"));
  pictures.clear();
  expect(pictures.at(3)).toEqual(new Map());
});
