"""Moving to a beat that the user taps (thesis 12.3).

A user taps a foot, first slower, then faster, and misses a tap. The anticipator `foot` receives the taps and predicts
the next beat. A character nods with each beat: every block refers to *the* beat, which means the next one, and the
planner sends one when the beat before has passed.

Watch the last column: the first nods wait until a rhythm can be heard, and then the nods are as close to the taps as
people are.
"""

import asyncio
from math import sin
from random import Random

from example_scene import ExampleScene, open_example

NOD = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="beat{number}">
  <head id="nod" lexeme="NOD" amount="0.4" stroke="anticipators:foot:beat"/>
</bml>
"""
TAPS, MISSED = 20, 12


def taps() -> list[float]:
    """The times of the taps, s, with the missed one."""
    random, times = Random(3), [1.0]
    while len(times) < TAPS:
        times.append(times[-1] + 0.9 + 0.1 * sin(len(times) / 4) + random.gauss(0.0, 0.01))
    return times


async def main() -> ExampleScene:
    beats = taps()
    onsets = [tap for number, tap in enumerate(beats, 1) if number != MISSED]
    nods = 1
    async with open_example() as scene:
        scene.perform(NOD.format(number=nods))
        while scene.now < beats[-1] + 0.4:
            while onsets and onsets[0] <= scene.now:
                onsets.pop(0)
                scene.event("foot", "tap")
            await scene.tick()
            if scene.feedback.reached(f"beat{nods}:nod:stroke"):
                nods += 1
                scene.perform(NOD.format(number=nods))
        scene.event("foot", "start")
        await scene.tick()
        strokes = [scene.feedback.time(f"beat{number}:nod:stroke") for number in range(1, nods)]
        print("   tap    nod  late")
        for number, tap in enumerate(beats, 1):
            stroke = min(strokes, key=lambda stroke: abs(stroke - tap))
            near = abs(stroke - tap) < 0.4
            remark = "  not tapped" if number == MISSED else ""
            print(f"{tap:6.2f} {stroke:6.2f} {stroke - tap:5.2f}{remark}" if near else f"{tap:6.2f}      -")
        return scene


if __name__ == "__main__":
    asyncio.run(main())
