"""A plan of speech that grows with what is understood (thesis, example 11).

While somebody still asks "how much is the doll", word by word, ways to begin the answer are prepared, then ways to go
on, then the end of it. None of it plays. When the answer is due a path is taken by an empty block: it activates the
pieces of the path, which wait for each other, and breaks off the others.

    eh ─┐ ┌─ it costs ────────┐
        ├─┼─ let's say ───────┼─ 40 crowns
  well ─┘ └─ you can have it ─┘

Look at the pieces: each starts exactly when the one before it ends, and the first one in the tick in which the path was
taken, because its speech had been made before.
"""

import asyncio

from stage import Stage, open_stage

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
UNDERSTOOD = {
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


async def answer(*path: str) -> Stage:
    async with open_stage("*:words:start", "*:words:end", voice="espeak") as stage:
        for word, pieces in UNDERSTOOD.items():
            stage.tell(f'understood "{word}"')
            for id_, text, before in pieces:
                after = f'bmla:appendAfter="{",".join(before)}"' if before else ""
                stage.perform(PIECE.format(id=id_, text=text, after=after))
            await stage.advance(0.3)
        stage.tell(f"the answer: {', '.join(path)}")
        stage.perform(PATH.format(taken=",".join(path), not_taken=",".join(id_ for id_ in PIECES if id_ not in path)))
        await stage.advance(4)
        return stage


async def main() -> list[Stage]:
    return [await answer("eh", "costs", "crowns"), await answer("say", "crowns")]


if __name__ == "__main__":
    asyncio.run(main())
