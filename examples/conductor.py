"""A conductor who follows a tempo, and leads it (thesis, examples 31 and 47).

Musicians slow down, and hurry again; one of their beats is not heard, and one is heard twice. The anticipator
`orchestra` is told of each beat as it sounds and predicts the next ones. Every stroke hangs on one of them, 0.1 s
before it: who plays too slowly under a conductor who is a little ahead feels late.

Look at the last column, and at the beat that was not heard: it is conducted as well.
"""

import asyncio
from math import sin

from stage import Stage, open_stage

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
    """The onsets that a microphone tells."""
    return sorted([*beats[: MISSED - 1], *beats[MISSED:], beats[DOUBLED - 1] + 0.06])


async def main() -> Stage:
    beats = when_the_music_beats()
    onsets = heard(beats)
    async with open_stage() as stage:
        for number in range(FIRST, LAST + 1):
            after = "" if number == FIRST else f'bmla:chunkAfter="bar{number - 1}"'
            stage.perform(STROKE.format(number=number, ahead=AHEAD, after=after))
        while stage.now < beats[-1] + 2:
            while onsets and onsets[0] <= stage.now:
                onsets.pop(0)
                stage.event("orchestra", "beat")
            await stage.tick()
        print("beat  music  conductor  ahead")
        for number in range(FIRST, LAST + 1):
            music, conductor = beats[number - 1], stage.feedback.time(f"bar{number}:beat:stroke")
            remark = {MISSED: "  not heard", DOUBLED: "  heard twice"}.get(number, "")
            print(f"{number:4} {music:6.2f} {conductor:10.2f} {music - conductor:6.2f}{remark}")
        return stage


if __name__ == "__main__":
    asyncio.run(main())
