"""A conductor that follows a tempo and leads it (thesis, examples 31 and 47).

Musicians slow down and speed up again. One of their beats is not detected, and one is detected twice. The anticipator
`orchestra` receives each beat as it sounds and predicts the next ones. Every stroke is tied to one of them, 0.1 s
early: musicians who play behind a conductor that is slightly ahead feel that they are late.

Watch the last column, and the beat that was not detected: it is conducted as well.
"""

import asyncio
from math import sin

from example_scene import ExampleScene, open_example

AHEAD = 0.1
FIRST, LAST = 3, 20
MISSED, DOUBLED = 9, 13
STROKE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="bar{number}" {after}>
  <gesture id="beat" lexeme="CONDUCT" stroke="anticipators:orchestra:beat{number}-{ahead}"/>
</bml>
"""


def when_the_music_beats() -> list[float]:
    times = [1.0]
    while len(times) < LAST:
        times.append(times[-1] + 0.9 + 0.1 * sin(len(times) / 5))
    return times


def heard(beats: list[float]) -> list[float]:
    """The onsets that a detector reports."""
    return sorted([*beats[: MISSED - 1], *beats[MISSED:], beats[DOUBLED - 1] + 0.06])


async def main() -> ExampleScene:
    beats = when_the_music_beats()
    onsets = heard(beats)
    async with open_example() as scene:
        for number in range(FIRST, LAST + 1):
            after = "" if number == FIRST else f'bmla:chunkAfter="bar{number - 1}"'
            scene.perform(STROKE.format(number=number, ahead=AHEAD, after=after))
        while scene.now < beats[-1] + 2:
            while onsets and onsets[0] <= scene.now:
                onsets.pop(0)
                scene.event("orchestra", "beat")
            await scene.tick()
        print("beat  music  conductor  ahead")
        for number in range(FIRST, LAST + 1):
            music, conductor = beats[number - 1], scene.feedback.time(f"bar{number}:beat:stroke")
            remark = {MISSED: "  not heard", DOUBLED: "  heard twice"}.get(number, "")
            print(f"{number:4} {music:6.2f} {conductor:10.2f} {music - conductor:6.2f}{remark}")
        return scene


if __name__ == "__main__":
    asyncio.run(main())
