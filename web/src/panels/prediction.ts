import type { Connection } from "../connection";
import { element } from "../dom";
import { sentenceOf } from "../errors";

/** How far ahead the button predicts, s. */
const AHEAD = 1;

/** Lets a button predict `anticipators:test:hit` again and again: what hangs on it moves, even in mid-gesture. */
export function bindPrediction(connection: Connection, onFailure: (sentence: string) => void): void {
  element("hit", HTMLButtonElement).addEventListener("click", () => {
    connection.request({ type: "predict", anticipator: "test", sync: "hit", in: AHEAD }).catch((error: unknown) => {
      onFailure(sentenceOf(error));
    });
  });
}
