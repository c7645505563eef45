"""Listening to a user: a nod wherever the voice asks for one (thesis 5.1.4, 10.3.7).

A user tells a story. The anticipator `voice` receives the pitch of the user's voice a hundred times a second, and
predicts the next place for a backchannel: some time after the voice has become low. Each nod is tied to it. The planner
sends the next nod when one has begun; it does not know the rule.

Watch the last column: the nods come at the ends of the clauses, of which the pitch falls, and not in pauses within.
"""

import asyncio
from random import Random

from example_scene import ExampleScene, open_example

NOD = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="nod{number}">
  <head id="nod" lexeme="NOD" amount="0.3" start="anticipators:voice:backchannel"/>
</bml>
"""
FALL, PAUSE = 0.25, 0.6
CLAUSES = [(1.6, True), (0.9, False), (1.3, True), (2.2, True), (0.5, False), (1.8, True)]
"""Duration of each clause (s), and whether its pitch falls at the end."""


def story() -> list[tuple[float, float, str]]:
    """Time (s), pitch (Hz, 0 for none) and, at the end of each clause, what it was like."""
    noise, spoken = Random(1), list[tuple[float, float, str]]()
    for seconds, falls in CLAUSES:
        for sample in range(round(seconds * 100)):
            low = falls and sample >= (seconds - FALL) * 100
            spoken.append((len(spoken) / 100, (140.0 if low else 200.0) + noise.uniform(-20.0, 20.0), ""))
        end = "a clause that ends low" if falls else "a clause that goes on"
        spoken += [
            (len(spoken) / 100 + sample / 100, 0.0, "" if sample else end) for sample in range(round(PAUSE * 100))
        ]
    return spoken


async def main() -> ExampleScene:
    nods = 1
    async with open_example("*:nod:start") as scene:
        scene.perform(NOD.format(number=nods))
        for time, pitch, end in story():
            await scene.until(time)
            scene.event("voice", "pitch", pitch)
            if end:
                scene.log(end, time)
            await scene.tick()
            if scene.feedback.reached(f"nod{nods}:nod:start"):
                nods += 1
                scene.perform(NOD.format(number=nods))
        await scene.until(scene.now + 2)
        return scene


if __name__ == "__main__":
    asyncio.run(main())
