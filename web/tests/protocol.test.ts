import { compile, type JSONSchema } from "json-schema-to-typescript";
import { describe, expect, it } from "vitest";

import schema from "../../reactive_realizer/server/protocol.json";

const BANNER = `/* eslint-disable */
/**
 * The messages of the socket, made from the server's protocol.json by \`npm run types\`: change that, not this.
 */`;

/** The compiler knows tuples by their older name. */
function withOlderTuples(json: object): JSONSchema {
  return JSON.parse(JSON.stringify(json).replaceAll('"prefixItems"', '"items"')) as JSONSchema;
}

describe("the types of the protocol", () => {
  it("are those of the server's schema (if not: npm run types)", async () => {
    const types = await compile(withOlderTuples(schema), "Message", {
      additionalProperties: false,
      bannerComment: BANNER,
      style: { printWidth: 120 },
    });
    await expect(types).toMatchFileSnapshot("../src/protocol.ts");
  });
});
