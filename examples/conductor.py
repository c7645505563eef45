"""A conductor that follows a tempo, leads it, and stands on legs that balance (thesis, examples 31 and 47, and 8.7).

Musicians slow down and speed up again. One of their beats is not detected, and one is detected twice. The anticipator
`orchestra` receives each beat as it sounds and predicts the next ones. Every stroke of the right hand is tied to one of
them, 0.1 s early: musicians who play behind a conductor that is slightly ahead feel that they are late.

Forces move the rest of the body: the legs balance, and the left arm hangs loosely, except when it cues players. Then
somebody pushes the conductor. The same performance without forces shows that the right arm does not notice any of this.
"""

import asyncio
from math import degrees, sin

import numpy as np
from example_scene import HUMAN, ExampleScene, open_example

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

AHEAD = 0.1
FIRST, LAST = 3, 20
MISSED, DOUBLED = 9, 13
CUES = 6, 11
PUSHED, FORCE, DURATION = 16, (0.0, 0.0, -40.0), 1.0
"""The beat after which the conductor is pushed from the front, with which force, N, and for how long, s."""

BODY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" id="body">
  <bmlt:controller id="legs" class="BalanceController"/>
  <bmlt:controller id="left" class="CompoundController" name="leftarmhang"/>
</bml>
"""
STROKE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="bar{number}" {after}>
  <gesture id="beat" lexeme="CONDUCT" mode="RIGHT_HAND" stroke="anticipators:orchestra:beat{number}-{ahead}"/>
</bml>
"""
CUE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="cue{number}">
  <gesture id="hand" lexeme="OFFER" mode="LEFT_HAND" stroke="anticipators:orchestra:beat{number}-{ahead}"/>
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


async def conduct(scene: RealizerPilot, *body: str) -> None:
    """Conduct all beats, with some blocks for the rest of the body, and record the frames."""
    beats = when_the_music_beats()
    onsets, push = heard(beats), beats[PUSHED - 1]
    scene.watch()
    for block in body:
        scene.perform(block)
    for number in range(FIRST, LAST + 1):
        after = "" if number == FIRST else f'bmla:chunkAfter="bar{number - 1}"'
        scene.perform(STROKE.format(number=number, ahead=AHEAD, after=after))
    for number in CUES:
        scene.perform(CUE.format(number=number, ahead=AHEAD))
    while scene.now < beats[-1] + 2:
        while onsets and onsets[0] <= scene.now:
            onsets.pop(0)
            scene.event("orchestra", "beat")
        if push <= scene.now:
            push = float("inf")
            scene.push("vt10", FORCE, DURATION)
        await scene.tick()


def print_beats(scene: RealizerPilot) -> None:
    remarks = {MISSED: "not heard", DOUBLED: "heard twice", PUSHED: "pushed"} | dict.fromkeys(CUES, "cue")
    print("beat  music  conductor  ahead")
    for number, music in enumerate(when_the_music_beats()[FIRST - 1 :], FIRST):
        conductor = scene.feedback.time(f"bar{number}:beat:stroke")
        print(f"{number:4} {music:6.2f} {conductor:10.2f} {music - conductor:6.2f}  {remarks.get(number, '')}".rstrip())


def off(some: list[Body], others: list[Body], *joints: str) -> float:
    """The greatest difference of joints in two recordings, rad."""
    pairs = zip(some, others, strict=True)
    return max(
        angle(difference(one.rotation(joint), other.rotation(joint))) for one, other in pairs for joint in joints
    )


def sway(bodies: list[Body]) -> float:
    """The range of the horizontal movement of the head, mm."""
    heads = np.array([body.transform("skullbase").position for body in bodies])
    return float(1000 * np.ptp(heads[:, ::2], axis=0).max())


async def main() -> ExampleScene:
    async with open_pilot(SceneOptions(HUMAN, "text")) as plain:
        await conduct(plain)
    async with open_example() as scene:
        await conduct(scene, BODY)
    print_beats(scene)
    still, moved = plain.bodies(), scene.bodies()
    began, pushed = (int(50 * when_the_music_beats()[number - 1]) for number in (FIRST - 1, PUSHED))
    print("With forces, in comparison to without:")
    print(f"right arm: {off(moved, still, 'r_shoulder', 'r_elbow', 'r_wrist'):.6f} rad off at most")
    print(f"left arm:  {degrees(off(moved, still, 'l_shoulder', 'l_elbow', 'l_wrist')):.0f} degrees off at most")
    print(f"head: sways by {sway(moved[began:pushed]):.0f} mm, and by {sway(moved[pushed:]):.0f} mm after the push")
    print("fell" if scene.feedback.of("fall") else "did not fall")
    return scene


if __name__ == "__main__":
    asyncio.run(main())
