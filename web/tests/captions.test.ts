import { describe, expect, it } from "vitest";

import { Captions } from "../src/captions";
import type { Caption } from "../src/protocol";

/** A caption whose words begin every half second. */
function caption(text: string, more: Partial<Caption> = {}): Caption {
  const words: Caption["words"] = [];
  for (const found of text.matchAll(/[\p{L}\p{N}]+/gu)) {
    const first = Array.from(text.slice(0, found.index)).length;
    words.push([words.length / 2, first, first + Array.from(found[0]).length]);
  }
  const duration = words.length / 2;
  return { type: "caption", character: "alice", id: "s1", text, words, start: 10, duration, gain: 1, ...more };
}

/** What is read at a time: before [word] after, with — where it is cut. */
function read(captions: Captions, time: number): string[] {
  return captions.at(time).map(({ before, word, after, cut }) => `${before}[${word}]${after}${cut ? "—" : ""}`);
}

const silent = (): null => null;

describe("captions", () => {
  it("mark the word that is heard, from the start of the speech until a little after its end", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One, two three."));
    expect([9.9, 10.1, 10.7, 11.2, 11.6, 12.9, 13.1].map((time) => read(captions, time).join())).toEqual([
      "",
      "[One], two three.",
      "One, [two] three.",
      "One, two [three].",
      "One, two three.[]",
      "One, two three.[]",
      "",
    ]);
  });

  it("follow the audio clock while the sound plays", () => {
    let heard: number | null = 0.6;
    const captions = new Captions((id) => (id === "s1" ? heard : null));
    captions.handle(caption("One, two three."));
    expect(read(captions, 10.1)).toEqual(["One, [two] three."]);
    heard = -0.1;
    expect(read(captions, 10.1)).toEqual([]);
    heard = null;
    expect(read(captions, 10.1)).toEqual(["[One], two three."]);
  });

  it("end where the speech was cut", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One, two three."));
    captions.handle({ type: "audio_stop", id: "s1", time: 11, fade: 0.03 });
    expect(read(captions, 10.9)).toEqual(["One, [two] three."]);
    expect(read(captions, 11.1)).toEqual(["One, [two]—"]);
    expect(read(captions, 12.6)).toEqual([]);
  });

  it("stay in a pause between two parts of a speech, however long", () => {
    const captions = new Captions(silent);
    const text = "One, two three.";
    const [one, two, three]: Caption["words"] = caption(text).words;
    if (!one || !two || !three) throw new Error("three words");
    const moved = (words: Caption["words"], by: number): Caption["words"] =>
      words.map(([start, first, last]) => [start + by, first, last]);
    captions.handle(caption(text, { duration: 0.5, words: [one, ...moved([two, three], 4)] }));
    expect(read(captions, 13.9)).toEqual(["[One], two three."]);
    captions.handle(
      caption(text, {
        id: "s2",
        start: 14.5,
        duration: 1,
        words: [...moved([one], -4.5), ...moved([two, three], -0.5)],
      }),
    );
    expect([14.4, 14.6, 15.2, 16, 17.1].map((time) => read(captions, time).join())).toEqual([
      "[One], two three.",
      "One, [two] three.",
      "One, two [three].",
      "One, two three.[]",
      "",
    ]);
  });

  it("end when the speech is cut in such a pause", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One, two three.", { duration: 0.7 }));
    captions.handle({ type: "audio_stop", id: "s1", time: 12, fade: 0.03 });
    expect([11.9, 12.1, 13.6].map((time) => read(captions, time).join())).toEqual([
      "One, [two] three.",
      "One, [two]—",
      "",
    ]);
  });

  it("move with the speech, and wait while its start is unknown", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One, two three.", { start: null }));
    expect(read(captions, 10.7)).toEqual([]);
    captions.handle({ type: "audio_move", id: "s1", start: 10.6, time: 10 });
    expect(read(captions, 10.7)).toEqual(["[One], two three."]);
  });

  it("show nothing of a speech that is stopped before its start", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One, two three."));
    captions.handle({ type: "audio_stop", id: "s1", time: 10, fade: 0.03 });
    expect(read(captions, 10.1)).toEqual([]);
  });

  it("show the last speech of each character, with its gain", () => {
    const captions = new Captions(silent);
    captions.handle(caption("One.", { start: 9.8 }));
    captions.handle(caption("Two.", { id: "s2" }));
    captions.handle(caption("Three.", { id: "s3", character: "bert" }));
    captions.handle({ type: "audio_gain", id: "s3", gain: 1.8, time: 10 });
    const shown = captions.at(10.2).map(({ character, word, gain }) => [character, word, gain]);
    expect(shown).toEqual([
      ["alice", "Two", 1],
      ["bert", "Three", 1.8],
    ]);
  });

  it("turn the pages of a long text at sentences and clauses", () => {
    const captions = new Captions(silent);
    const text =
      "This is the first sentence of three. The second one is longer, because it has two clauses. " +
      "The third one does not fit on one page and is turned at its comma, " +
      "because a page that ends there is easier to read than one that ends wherever it is full up.";
    captions.handle(caption(text));
    const times = Array.from({ length: 90 }, (_, index) => 10.1 + index / 2);
    const pages = times.flatMap((time) => captions.at(time).map(({ before, word, after }) => before + word + after));
    expect([...new Set(pages)]).toEqual([
      "This is the first sentence of three. ",
      "The second one is longer, because it has two clauses. ",
      "The third one does not fit on one page and is turned at its comma, ",
      "because a page that ends there is easier to read than one that ends wherever it is ",
      "full up.",
    ]);
  });

  it("count characters as Unicode does", () => {
    const captions = new Captions(silent);
    captions.handle(caption("😀 Ärger 𝒳 da"));
    expect(read(captions, 10.2)).toEqual(["😀 [Ärger] 𝒳 da"]);
  });
});
