import { Color, DoubleSide, MeshStandardMaterial, Texture } from "three";
import { describe, expect, it } from "vitest";

import { plain } from "../src/avatar";

describe("a material in low quality", () => {
  it("keeps its colors, also those of vertices, which darken the inside of a mouth", () => {
    const look = { name: "Teeth", map: new Texture(), vertexColors: true, side: DoubleSide };
    const low = plain(new MeshStandardMaterial({ ...look, color: 0x804020 }));
    expect(low).toMatchObject({ ...look, color: new Color(0x804020) });
  });
});
