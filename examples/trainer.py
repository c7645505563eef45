"""A trainer that is slightly ahead of the user (thesis, example 7).

A user jumps, with an accelerometer on the belt. The anticipator `jumps` receives its samples, detects the peaks and
predicts the next ones. Every stroke of the trainer is tied to one of them, 0.3 s early.

Watch the last column: the user speeds up and slows down, and the trainer stays ahead, although no message contains the
tempo.
"""

import asyncio
from math import cos, exp
from random import Random

from example_scene import ExampleScene, open_example

AHEAD = 0.3
FIRST, LAST = 4, 18
STROKE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="jump{number}" {after}>
  <gesture id="arms" lexeme="BEAT" mode="BOTH_HANDS" stroke="anticipators:jumps:{number}-{ahead}"/>
</bml>
"""


def when_the_user_jumps() -> list[float]:
    times = [1.0]
    while len(times) < LAST:
        times.append(times[-1] + 1.8 + 0.15 * cos(len(times) / 3))
    return times


def acceleration(time: float, jumps: list[float], noise: Random) -> float:
    """A sample of the accelerometer, m/s²: gravity, a peak at every jump, and noise."""
    return 9.81 + sum(9.0 * exp(-(((time - jump) / 0.08) ** 2)) for jump in jumps) + noise.uniform(0.0, 0.5)


async def main() -> ExampleScene:
    jumps, noise = when_the_user_jumps(), Random(1)
    async with open_example() as scene:
        for number in range(FIRST, LAST + 1):
            after = "" if number == FIRST else f'bmla:chunkAfter="jump{number - 1}"'
            scene.perform(STROKE.format(number=number, ahead=AHEAD, after=after))
        while scene.now < jumps[-1] + 2:
            scene.event("jumps", "sample", acceleration(scene.now, jumps, noise))
            await scene.tick()
        print("jump   user  trainer  ahead")
        for number in range(FIRST, LAST + 1):
            user, trainer = jumps[number - 1], scene.feedback.time(f"jump{number}:arms:stroke")
            print(f"{number:4} {user:6.2f} {trainer:8.2f} {user - trainer:6.2f}")
        return scene


if __name__ == "__main__":
    asyncio.run(main())
