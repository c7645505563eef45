import type { Connection } from "../connection";
import { sentenceOf } from "../errors";
import { SpaceKey } from "../space_key";

/** Tells the anticipator `spacebar` of the key, while nothing on the page has the focus. */
export function bindSpaceBar(connection: Connection, onFailure: (sentence: string) => void): void {
  const idle = (): boolean => document.activeElement === document.body;
  new SpaceKey(window, idle, (event) => {
    connection.request({ type: "event", anticipator: "spacebar", event }).catch((error: unknown) => {
      onFailure(sentenceOf(error));
    });
  });
}
