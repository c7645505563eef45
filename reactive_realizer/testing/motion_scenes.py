"""Random scenes of a moving figure, in which the laws of motion are measured (`motion_laws`)."""

from collections.abc import Callable, Iterator
from functools import partial
from random import Random
from typing import NamedTuple

from reactive_realizer.testing.pilot import RealizerPilot

_DURATION = 6.0
"""Duration of a scene, s."""

_GESTURES = (
    "BEAT",
    "BEAT",
    "OFFER",
    "WAVE",
    "CONDUCT",
    "SELF",
    "CONDUIT",
    "CONTAINER",
    "CHOP",
    "FLICK",
    "REFUSE",
    "ONE",
)
_MODES = ("", ' mode="LEFT_HAND"', ' mode="RIGHT_HAND"', ' mode="BOTH_HANDS"')
_HEADS = ("NOD", "SHAKE", "TILT", "TOSS")
_INFLUENCES = ("EYES", "HEAD", "SHOULDER", "WAIST")
_TARGETS = ("bluebox", "greensphere")
_POSTURES = (
    '<stance type="SITTING"/>',
    '<stance type="STANDING"/>',
    '<stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_CROSSED"/>',
    '<stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_AKIMBO"/>',
)
_STARTS = ("", "", ' start="0.2"', ' start="anticipators:t:hit-0.6"')
_STROKES = (' stroke="0.6"', ' stroke="1.2"', ' stroke="anticipators:t:hit"', ' ready="0.5"')
_COMPOSITIONS = ("MERGE", "MERGE", "REPLACE", "REPLACE", "APPEND")
_PREDICTIONS_PER_SECOND = 10.0
_WALKING = 9.0
"""Duration of a scene in which a figure walks, s."""

_SPEEDS = {"WALK": (0.5, 2.1), "RUN": (2.0, 3.5), "STRAFE": (0.2, 0.7)}
"""Bounds of the speed in each manner, m/s."""

_NOISE = 0.15
"""Standard deviation of the error of a prediction one second ahead, s; it shrinks as the point comes nearer."""


async def play_scene(seed: int, pilot: RealizerPilot) -> None:
    """Plays a random scene on a pilot that has just been opened, and records its frames."""
    pilot.watch()
    for time, give in random_scene(seed):
        await pilot.advance(max(0.0, time - pilot.now))
        give(pilot)
    await pilot.advance(_DURATION - pilot.now)


async def play_walk(seed: int, pilot: RealizerPilot) -> None:
    """Plays a random walk on a pilot that has just been opened, and records its frames."""
    pilot.watch()
    for time, give in random_walk(seed):
        await pilot.advance(max(0.0, time - pilot.now))
        give(pilot)
    await pilot.advance(_WALKING - pilot.now)


class Input(NamedTuple):
    """What a scene gives at a time, s."""

    time: float
    give: Callable[[RealizerPilot], None]


def random_scene(seed: int) -> list[Input]:
    """Return the inputs of a scene, in order of time.

    Blocks with gestures, pointings, head movements, gazes and postures merge, replace and follow each other; some are
    interrupted, some have a parameter that jumps, and some are tied to a point whose noisy prediction comes at 10 Hz.
    """
    random = Random(seed)
    return sorted((*_blocks(random), *_predictions(random)), key=lambda each: each.time)


def random_walk(seed: int) -> list[Input]:
    """Return the inputs of a walk, in order of time.

    A figure walks, runs and steps aside to two or three places, at speeds up to the highest of each manner; what comes
    next follows or replaces what it does. It gestures meanwhile.
    """
    random = Random(seed)
    inputs, time = [], random.uniform(0.1, 0.4)
    for number in range(random.choice((2, 3))):
        inputs.append(Input(time, partial(_send, f"w{number}", _way(random), random.choice(("APPEND", "REPLACE")))))
        time += random.uniform(1.0, 2.5)
        if random.random() < 0.3:
            gesture = f'<gesture id="g" lexeme="{random.choice(_GESTURES)}"/>'
            inputs.append(Input(time - 0.5, partial(_send, f"g{number}", gesture, "MERGE")))
    return inputs


def _way(random: Random) -> str:
    manner = random.choice(("WALK", "WALK", "RUN", "STRAFE"))
    speed = random.uniform(*_SPEEDS[manner])
    furthest = 1.0 if manner == "STRAFE" else 4.0
    x, z = (random.uniform(-furthest, furthest) for _ in range(2))
    parameter = f'<bmlt:parameter name="speed" value="{speed:.2f}"/>'
    return f'<locomotion id="m0" target="{x:.2f} {z:.2f}" manner="{manner}">{parameter}</locomotion>'


def _blocks(random: Random) -> Iterator[Input]:
    time = random.uniform(0.1, 0.4)
    for number in range(random.randint(3, 6)):
        text, composition = _block(random), random.choice(_COMPOSITIONS)
        yield Input(time, partial(_send, f"b{number}", text, composition))
        if random.random() < 0.3:
            interrupt = f'<bmla:interrupt id="i" target="b{number}"/>'
            yield Input(time + random.uniform(0.2, 1.2), partial(_send, f"i{number}", interrupt, "MERGE"))
        if random.random() < 0.5:
            yield Input(time + random.uniform(0.1, 0.7), partial(_send, f"c{number}", _jump(random, number), "MERGE"))
        time += random.uniform(0.2, 1.2)


def _send(name: str, text: str, composition: str, pilot: RealizerPilot) -> None:
    pilot.block(name, text, composition=composition)


def _block(random: Random) -> str:
    return "".join(_behavior(random, f"m{number}") for number in range(random.choice((1, 2, 2, 3))))


def _behavior(random: Random, name: str) -> str:
    start, ties = random.choice(_STARTS), random.choice(_STARTS + _STROKES)
    kind = random.random()
    if kind < 0.5:
        return f'<gesture id="{name}" lexeme="{random.choice(_GESTURES)}"{random.choice(_MODES)}{ties}/>'
    if kind < 0.65:
        return f'<pointing id="{name}" target="{random.choice(_TARGETS)}"{random.choice(_MODES)}{ties}/>'
    if kind < 0.8:
        amount = round(random.uniform(0.2, 1.0), 2)
        return f'<head id="{name}" lexeme="{random.choice(_HEADS)}" amount="{amount}"{start}/>'
    if kind < 0.92:
        element = random.choice(("gaze", "gaze", "gazeShift"))
        influence = random.choice(_INFLUENCES)
        return f'<{element} id="{name}" target="{random.choice(_TARGETS)}" influence="{influence}"{start}/>'
    element = random.choice(("posture", "postureShift"))
    return f'<{element} id="{name}"{start}>{random.choice(_POSTURES)}</{element}>'


def _jump(random: Random, number: int) -> str:
    """Return a change of a parameter to another value at once."""
    value = round(random.uniform(0.0, 1.0), 2)
    return (
        f'<bmla:parametervaluechange id="p" target="b{number}:m0" paramId="amount">'
        f'<bmla:trajectory type="instant" targetValue="{value}"/></bmla:parametervaluechange>'
    )


def _predictions(random: Random) -> Iterator[Input]:
    hit = random.uniform(1.0, 4.0)
    for number in range(int(hit * _PREDICTIONS_PER_SECOND)):
        time = number / _PREDICTIONS_PER_SECOND
        yield Input(time, partial(_predict, random.gauss(hit, _NOISE * min(1.0, hit - time))))


def _predict(time: float, pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", time)
