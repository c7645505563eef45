import type { Connection } from "../connection";
import { element } from "../dom";
import { SpaceKey } from "../space_key";

/** Least time between two tempos that are sent while the slider is dragged, ms. */
const TEMPO_INTERVAL = 100;

/** Time from a click on the prediction button to the predicted moment, s. */
const AHEAD = 1;

/** The controls of the scene's anticipators: the metronome, a test prediction and the space bar. */
export class AnticipatorsPanel {
  private readonly tempo = element("tempo", HTMLInputElement);
  private readonly tempoValue = element("tempo-value", HTMLOutputElement);
  private tempoTimer: ReturnType<typeof setTimeout> | null = null;

  constructor(
    private readonly connection: Connection,
    private readonly onFailure: (reason: unknown) => void,
  ) {
    this.showTempo();
    this.tempo.addEventListener("input", () => {
      this.showTempo();
      this.sendTempoSoon();
    });
    element("hit", HTMLButtonElement).addEventListener("click", () => {
      this.predictHit();
    });
    // While a control has the focus, the space bar belongs to that control.
    const idle = (): boolean => document.activeElement === document.body;
    new SpaceKey(window, idle, (event) => {
      connection.request({ type: "event", anticipator: "spacebar", event }).catch(onFailure);
    });
  }

  private showTempo(): void {
    this.tempoValue.textContent = `${this.tempo.value} bpm`;
  }

  private sendTempoSoon(): void {
    this.tempoTimer ??= setTimeout(() => {
      this.tempoTimer = null;
      const value = this.tempo.valueAsNumber;
      this.connection.request({ type: "event", anticipator: "metronome", event: "tempo", value }).catch(this.onFailure);
    }, TEMPO_INTERVAL);
  }

  /** Predicts `anticipators:test:hit`; each click moves what is tied to it, even during its gesture. */
  private predictHit(): void {
    this.connection.request({ type: "predict", anticipator: "test", sync: "hit", in: AHEAD }).catch(this.onFailure);
  }
}
