import type { Connection } from "../connection";
import { create, element } from "../dom";
import { modeBlock, type PhysicsMode, pushFrom, resetBlock, type Side } from "../physics";
import type { Character, Feedback, Position } from "../protocol";

const MODES: Record<string, PhysicsMode> = { "physics-bml": "bml", "physics-on": "on", "physics-off": "off" };
const SIDES: readonly Side[] = ["front", "back", "left", "right"];

/** The mode that the page has set for a character, and the block that sets it. */
interface Chosen {
  mode: PhysicsMode;
  block: string;
}

/** Turns the physics of a character on and off, pushes it, and puts it back on its feet. */
export class PhysicsPanel {
  private readonly character = element("physics-character", HTMLSelectElement);
  private readonly impulse = element("push-impulse", HTMLInputElement);
  private readonly impulseValue = element("push-value", HTMLOutputElement);
  private readonly radios = Object.entries(MODES).map(([id, mode]) => ({ mode, radio: element(id, HTMLInputElement) }));
  /** By character; none where others decide. */
  private readonly chosen = new Map<string, Chosen>();
  private blocks = 0;
  private readonly page = Math.random().toString(36).slice(2, 6);

  constructor(
    private readonly connection: Connection,
    private readonly forwardOf: (character: string) => Position | null,
    private readonly onFailure: (reason: unknown) => void,
  ) {
    for (const { mode, radio } of this.radios) radio.addEventListener("change", () => void this.choose(mode));
    for (const side of SIDES) {
      element(`push-${side}`, HTMLButtonElement).addEventListener("click", () => {
        this.push(side);
      });
    }
    element("reset", HTMLButtonElement).addEventListener(
      "click",
      () => void this.send((id) => resetBlock(id, this.character.value)),
    );
    this.character.addEventListener("change", () => {
      this.showMode();
    });
    this.impulse.addEventListener("input", () => {
      this.showImpulse();
    });
    this.showImpulse();
  }

  /** Begins a new session with these characters. */
  assign(characters: Character[]): void {
    this.character.replaceChildren(...characters.map(({ id }) => create("option", "", id)));
    this.character.hidden = characters.length < 2;
    this.chosen.clear();
    this.showMode();
  }

  /** Notes when a block of the page has ended, by whomever. */
  take({ xml }: Feedback): void {
    for (const [character, { block }] of this.chosen) {
      if (!xml.includes(`id="${block}:end"`)) continue;
      this.chosen.delete(character);
      this.showMode();
    }
  }

  private async choose(mode: PhysicsMode): Promise<void> {
    const character = this.character.value;
    const former = this.chosen.get(character)?.block ?? null;
    const block = await this.send((id) => modeBlock(id, character, mode, former));
    if (block !== null) this.chosen.set(character, { mode, block });
    this.showMode();
  }

  /** Sends a block, and returns its id; null if it failed. */
  private async send(blockOf: (id: string) => string): Promise<string | null> {
    const id = `physics-${this.page}-${++this.blocks}`;
    try {
      await this.connection.request({ type: "bml", xml: blockOf(id) });
      return id;
    } catch (error) {
      this.onFailure(error);
      return null;
    }
  }

  private push(side: Side): void {
    const character = this.character.value;
    const forward = this.forwardOf(character);
    if (forward === null) return; // its avatar is not loaded yet
    this.connection.request(pushFrom(side, character, forward, this.impulse.valueAsNumber)).catch(this.onFailure);
  }

  private showMode(): void {
    const mode = this.chosen.get(this.character.value)?.mode ?? "bml";
    for (const each of this.radios) each.radio.checked = each.mode === mode;
  }

  private showImpulse(): void {
    this.impulseValue.textContent = `${this.impulse.value} N s`;
  }
}
