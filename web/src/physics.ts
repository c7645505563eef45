import type { Position, Push } from "./protocol";

/** Who decides which joints forces move: the BML that others send, or the page. */
export type PhysicsMode = "bml" | "on" | "off";

/** From where a character is pushed, as it sees it. */
export type Side = "front" | "back" | "left" | "right";

/** Time for which a push lasts, s. */
const PUSH_DURATION = 0.2;

/** The joint of the upper body, the segment that is pushed. */
const TRUNK = "vl5";

/** The replacement groups that the page takes, each with its controller. Controllers of these groups in other blocks give way. */
const CONTROLLERS = {
  legs: 'class="BalanceController"',
  leftarm: 'class="CompoundController" name="leftarmhang"',
  rightarm: 'class="CompoundController" name="rightarmhang"',
};

const NONE = 'class="NoController"';

/** A block that sets the mode of a character, and ends the block that set it before. */
export function modeBlock(id: string, character: string, mode: PhysicsMode, former: string | null): string {
  const interrupt = former === null ? "" : `<bmla:interrupt id="former" target="${former}"/>`;
  const controllers =
    mode === "bml"
      ? []
      : Object.entries(CONTROLLERS).map(([group, kind]) => controller(group, mode === "on" ? kind : NONE));
  return block(id, character, interrupt + controllers.join(""));
}

/** A block that ends all others of a character, which puts it back on its feet. */
export function resetBlock(id: string, character: string): string {
  return block(id, character, "", ' composition="REPLACE"');
}

/**
 * A push at the trunk.
 *
 * @param forward where the character faces, horizontally, of length 1
 * @param impulse N s
 */
export function pushFrom(side: Side, character: string, forward: Position, impulse: number): Push {
  const [x, , z] = forward;
  const directions: Record<Side, [number, number]> = { front: [-x, -z], back: [x, z], left: [-z, x], right: [z, -x] };
  const newtons = impulse / PUSH_DURATION;
  const [along, across] = directions[side];
  return {
    type: "push",
    character,
    joint: TRUNK,
    force: [newtons * along, 0, newtons * across],
    duration: PUSH_DURATION,
  };
}

function controller(group: string, kind: string): string {
  const parameter = `<bmlt:parameter name="replacementgroup" value="${group}"/>`;
  return `<bmlt:controller id="${group}" ${kind} start="0">${parameter}</bmlt:controller>`;
}

function block(id: string, character: string, content: string, composition = ""): string {
  const spaces =
    'xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" ' +
    'xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"';
  return `<bml ${spaces} id="${id}" characterId="${escaped(character)}"${composition}>${content}</bml>`;
}

function escaped(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
}
