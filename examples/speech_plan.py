"""Preparing an answer while the question is still being asked (thesis, example 11).

While a user asks "how much is the doll", word by word, several beginnings of an answer are prepared, then several
middle parts, then the end. None of them plays. When the answer is due, an empty block selects a path: it activates the
pieces of the path, which wait for each other, and interrupts the other pieces.

    eh ─┐ ┌─ it costs ────────┐
        ├─┼─ let's say ───────┼─ 40 crowns
  well ─┘ └─ you can have it ─┘

Watch the pieces: each starts exactly when the previous one ends, and the first one in the tick in which the path was
selected, because its speech was already synthesized.
"""

import asyncio

from example_scene import ExampleScene, open_example

PIECE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="{id}" bmla:preplan="true" {after}>
  <speech id="words"><text>{text}</text></speech>
</bml>
"""
PATH = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="path" bmla:interrupt="{not_taken}" bmla:onStart="{taken}"/>
"""
UNDERSTOOD: dict[str, list[tuple[str, str, tuple[str, ...]]]] = {
    "how": [("eh", "Eh,", ()), ("well", "Well,", ())],
    "much": [],
    "is": [
        ("costs", "it costs", ("eh", "well")),
        ("say", "let's say", ("eh", "well")),
        ("have", "you can have it for", ("eh", "well")),
    ],
    "the": [],
    "doll": [("crowns", "forty crowns.", ("costs", "say", "have"))],
}
PIECES = [id_ for pieces in UNDERSTOOD.values() for id_, _, _ in pieces]


async def answer(*path: str) -> ExampleScene:
    async with open_example("*:words:start", "*:words:end", voice="espeak") as scene:
        for word, pieces in UNDERSTOOD.items():
            scene.log(f'understood "{word}"')
            for id_, text, before in pieces:
                after = f'bmla:appendAfter="{",".join(before)}"' if before else ""
                scene.perform(PIECE.format(id=id_, text=text, after=after))
            await scene.advance(0.3)
        scene.log(f"the answer: {', '.join(path)}")
        scene.perform(PATH.format(taken=",".join(path), not_taken=",".join(id_ for id_ in PIECES if id_ not in path)))
        await scene.advance(4)
        return scene


async def main() -> list[ExampleScene]:
    return [await answer("eh", "costs", "crowns"), await answer("say", "crowns")]


if __name__ == "__main__":
    asyncio.run(main())
