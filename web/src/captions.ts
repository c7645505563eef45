import type { AudioMessage } from "./connection";
import type { Caption } from "./protocol";

/** Time for which a caption stays after its speech has ended, s. */
const LINGER = 1.5;

/** Characters shown at once: two lines, which are read at a glance. */
const PAGE = 84;

/** Number of captions kept. */
const REMEMBERED = 20;

/** What is shown of a speech: a part of its text, with the word that is heard. */
export interface Reading {
  character: string;
  before: string;
  /** The word that is heard; empty once the speech has ended by itself. */
  word: string;
  after: string;
  /** Whether the speech was cut after the word. */
  cut: boolean;
  /** Of the sound; 1 is as recorded. */
  gain: number;
}

/** A word of a text: its start, s from the start of the speech, and its place. */
interface Word {
  start: number;
  first: number;
  last: number;
}

/** The text of one speech, page by page. Positions in the speech are in s from its start. */
class CaptionedSpeech {
  /** Realizer time of its start, s; Infinity while it is unknown. */
  start: number;
  gain: number;
  /** Realizer time at which it is cut, s; Infinity if it is not. */
  stop = Infinity;
  private readonly text: string[];
  private readonly words: Word[];
  /** The first word of each page, in order. */
  private readonly pages: number[];
  /** Whether the speech goes on after its sound, with another part, which has a caption of its own. */
  private readonly goesOn: boolean;

  constructor(readonly announced: Caption) {
    this.start = announced.start ?? Infinity;
    this.gain = announced.gain;
    this.text = Array.from(announced.text); // places are in Unicode characters
    this.words = announced.words.map(([start, first, last]) => ({ start, first, last }));
    this.pages = pagesOf(this.text, this.words);
    this.goesOn = this.words.some(({ start }) => start >= announced.duration);
  }

  /** Whether it has begun at a position. */
  begun(position: number): boolean {
    return position >= 0 && this.end > 0;
  }

  /** Whether it goes on at a position, or has ended only a moment ago. */
  shown(position: number): boolean {
    return position < this.end + LINGER;
  }

  read(position: number): Reading {
    const { character } = this.announced;
    const heard = Math.min(position, this.end, this.announced.duration);
    const number = this.words.filter(({ start }) => start < heard).length - 1;
    const [from, to] = this.page(Math.max(number, 0));
    const word = this.words[number];
    const ended = position >= this.end;
    const cut = ended && (this.goesOn || this.end < this.announced.duration);
    if (word === undefined || (ended && !cut)) {
      return { character, before: this.slice(from, to), word: "", after: "", cut, gain: this.gain };
    }
    const [before, after] = [this.slice(from, word.first), cut ? "" : this.slice(word.last, to)];
    return { character, before, word: this.slice(word.first, word.last), after, cut, gain: this.gain };
  }

  /** The position at which it ends, or is cut; Infinity while it waits for its next part. */
  private get end(): number {
    return Math.min(this.goesOn ? Infinity : this.announced.duration, this.stop - this.start);
  }

  /** The place in the text of the page with a word. */
  private page(word: number): [number, number] {
    const index = this.pages.filter((first) => first <= word).length - 1;
    const at = (page: number, otherwise: number): number => this.words[this.pages[page] ?? -1]?.first ?? otherwise;
    return [index <= 0 ? 0 : at(index, 0), at(index + 1, this.text.length)];
  }

  private slice(first: number, last: number): string {
    return this.text.slice(first, last).join("");
  }
}

/** The captions of all speeches, as messages announce and change them. */
export class Captions {
  private readonly speeches = new Map<string, CaptionedSpeech>();

  /** `heardPosition` gives the position of a sound that plays, s, on the audio clock; null if it does not play. */
  constructor(private readonly heardPosition: (id: string) => number | null) {}

  handle(message: AudioMessage): void {
    if (message.type === "caption") this.add(message);
    const speech = this.speeches.get(message.id);
    if (speech === undefined) return;
    if (message.type === "audio_move") speech.start = message.start;
    else if (message.type === "audio_gain") speech.gain = message.gain;
    else if (message.type === "audio_stop") speech.stop = message.time;
  }

  /** What is read at a realizer time, s: of each character the speech that began last. */
  at(time: number): Reading[] {
    const last = new Map<string, { speech: CaptionedSpeech; position: number }>();
    for (const [id, speech] of this.speeches) {
      const position = this.heardPosition(id) ?? time - speech.start;
      const { character } = speech.announced;
      const before = last.get(character)?.speech.start ?? -Infinity;
      if (speech.begun(position) && speech.start >= before) last.set(character, { speech, position });
    }
    const shown = [...last.values()].filter(({ speech, position }) => speech.shown(position));
    return shown.map(({ speech, position }) => speech.read(position));
  }

  /** Forgets everything: the realizer is new. */
  clear(): void {
    this.speeches.clear();
  }

  private add(message: Caption): void {
    this.speeches.set(message.id, new CaptionedSpeech(message));
    for (const id of [...this.speeches.keys()].slice(0, -REMEMBERED)) this.speeches.delete(id);
  }
}

/** The first word of each page: it ends with a sentence or a clause, unless that leaves it mostly empty. */
function pagesOf(text: string[], words: Word[]): number[] {
  const pages = [0];
  let [sentence, clause] = [0, 0];
  const begin = (word: number): number => words[word]?.first ?? 0;
  for (const [number, word] of words.entries()) {
    const page = pages.at(-1) ?? 0;
    const between = text.slice(words[number - 1]?.last ?? 0, word.first).join("");
    if (/[.!?…]/.test(between)) sentence = number;
    if (/[,;:–—]/.test(between)) clause = number;
    if (word.last - begin(page) <= PAGE || number === page) continue;
    const full = (candidate: number): boolean => candidate > page && begin(candidate) - begin(page) > PAGE / 3;
    pages.push([sentence, clause].find(full) ?? number);
  }
  return pages;
}
