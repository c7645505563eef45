/** A block as text, with the default namespace on a line of its own. */
function block(id: string, content: string, composition = ""): string {
  return `<bml id="${id}"${composition}
  xmlns="http://www.bml-initiative.org/bml/bml-1.0">${content}</bml>
`;
}

const HELLO = `
  <gaze id="look" target="camera" end="talk:end"/>
  <speech id="talk" start="0.3"><text>
    Hello there, <sync id="nice"/>nice to meet you.
  </text></speech>
  <gesture id="beat" lexeme="BEAT" mode="RIGHT_HAND"
    stroke="talk:nice"/>
  <faceLexeme id="smile" lexeme="RAISE_MOUTH_CORNERS"
    start="talk:start" end="talk:end+1"/>
`;

const NOD = `
  <head id="nod" lexeme="NOD" repetition="2"/>
  <faceLexeme id="brows" lexeme="RAISE_BROWS"
    start="nod:start" end="nod:end"/>
`;

const BEATS = `
  <gesture id="left" lexeme="BEAT" mode="LEFT_HAND"/>
  <gesture id="right" lexeme="BEAT" mode="RIGHT_HAND"
    start="left:end"/>
  <gesture id="both" lexeme="BEAT" mode="BOTH_HANDS"
    start="right:end"/>
`;

const LOOK = `
  <gaze id="box" target="bluebox" influence="HEAD"
    start="0" end="2"/>
  <gaze id="sphere" target="greensphere" influence="HEAD"
    start="box:end" end="4"/>
`;

const HIT = `
  <gesture id="beat" lexeme="BEAT" mode="RIGHT_HAND"
    stroke="anticipators:test:hit"/>
`;

const SPACE = `
  <head id="nod" lexeme="NOD"
    start="anticipators:spacebar:press"/>
`;

/** Example blocks by title; each function takes the id of its block. */
export const SAMPLES: Record<string, (id: string) => string> = {
  "Say hello": (id) => block(id, HELLO),
  "Nod and raise the brows": (id) => block(id, NOD),
  "Beat with one hand, then both": (id) => block(id, BEATS),
  "Look at the box, then at the sphere": (id) => block(id, LOOK),
  "Beat at a predicted time": (id) => block(id, HIT),
  "Nod on the space bar": (id) => block(id, SPACE),
  "Stop everything": (id) => block(id, "\n", ' composition="REPLACE"'),
};
