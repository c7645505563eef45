"""Random blocks with tight timings, and where the hands are when their sync points are reported.

``python -m tests.acceptance.reached_points COUNT [FIRST]`` examines many blocks, and prints the points that are missed.
"""

import asyncio
import logging
import math
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from random import Random
from typing import NamedTuple

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.speed_limit import SpeedLimit
from reactive_realizer.embodiment.vector import Vec3, distance, dot, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

NEAR, AIMED = 0.02, 2.0
"""How far a wrist (m) and the direction of a pointing finger (degrees) may be from where the motion wants them."""

GESTURES = ("BEAT", "OFFER", "WAVE", "CONDUCT", "SELF", "CONDUIT", "CHOP", "FLICK", "ONE")
TARGETS = ("bluebox", "greensphere")
SIDES = {"LEFT_HAND": "l", "RIGHT_HAND": "r", "BOTH_HANDS": "lr"}
POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
SPEECH = '<speech id="s"{}><text>One <sync id="w"/>two three <sync id="x"/>four.</text></speech>'
STARTS = ("", "", ' start="0"', ' start="0.3"', ' start="anticipators:t:hit"')
OTHERS = (
    '<head id="o" lexeme="NOD"/>',
    '<head id="o" lexeme="SHAKE" end="anticipators:t:hit+0.2"/>',
    '<gaze id="o" target="bluebox" influence="WAIST" ready="0.2"/>',
    '<gaze id="o" target="greensphere"/>',
    '<posture id="o"><stance type="STANDING"/><pose part="ARMS" lexeme="ARMS_CROSSED"/></posture>',
)
REFERENCES = (
    *("s:start", "s:w", "s:x", "s:w+0.2", "s:w+0.5"),
    *(f"anticipators:t:hit{offset}" for offset in ("", "", "+0.1", "+0.4", "-0.1", "-0.4")),
)


class Shown(NamedTuple):
    """A frame: its time (s), the body that the motions want, and the one that is shown."""

    time: float
    wanted: Body
    shown: Body


class Miss(NamedTuple):
    """A point at which a hand is not where its motion wants it, by m and degrees."""

    point: str
    distance: float
    angle: float


class Case(NamedTuple):
    """A session.

    Attributes:
        sent: times (s), in order, each with the input that the pilot gives then.
        sides: of the gestures and pointings, by ``block:behavior``.
    """

    sent: Sequence[tuple[float, Callable[[RealizerPilot], None]]]
    sides: Mapping[str, str]


def random_case(seed: int) -> Case:
    """One or two blocks with gestures, pointings and other behaviors, and predictions that are often late."""
    random, sides = Random(seed), dict[str, str]()
    sent = [(random.uniform(0.0, 0.3), partial(_send, "b0", _block(random, "b0", sides), "MERGE"))]
    if random.random() < 0.4:
        how = random.choice(("MERGE", "APPEND"))
        sent.append((random.uniform(0.4, 2.0), partial(_send, "b1", _block(random, "b1", sides), how)))
    if random.random() < 0.8:
        sent.append((0.0, partial(_predict, random.uniform(0.2, 2.0))))
    for _ in range(random.choice((0, 1, 1, 2, 3))):
        time = random.uniform(0.2, 2.0)
        sent.append((time, partial(_predict, time + random.uniform(-0.2, 1.2))))
    sent.append((2.01, partial(_predict, random.uniform(2.1, 3.1))))  # so that nothing waits for ever
    return Case(sorted(sent, key=lambda each: each[0]), sides)


def _send(name: str, text: str, composition: str, pilot: RealizerPilot) -> None:
    pilot.block(name, text, composition=composition)


def _predict(time: float, pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", time)


def _block(random: Random, name: str, sides: dict[str, str]) -> str:
    parts = [SPEECH.format(random.choice(STARTS))]
    for number in range(random.choice((1, 1, 2))):
        points = sorted(random.sample(range(7), random.choice((0, 1, 1, 1, 2, 2, 3))))
        times = sorted(round(random.uniform(0.0, 1.6), 2) for _ in points)
        places = (time if random.random() < 0.3 else random.choice(REFERENCES) for time in times)
        ties = "".join(f' {POINTS[k]}="{place}"' for k, place in zip(points, places, strict=True))
        mode = random.choice(sorted(SIDES))
        if random.random() < 0.7:
            id_ = f"g{number}"
            parts.append(f'<gesture id="{id_}" lexeme="{random.choice(GESTURES)}" mode="{mode}"{ties}/>')
        else:
            id_ = f"p{number}"
            parts.append(f'<pointing id="{id_}" target="{random.choice(TARGETS)}" mode="{mode}"{ties}/>')
        sides[f"{name}:{id_}"] = SIDES[mode]
    if random.random() < 0.4:
        parts.append(random.choice(OTHERS))
    return "".join(parts)


async def perform(case: Case, pilot: RealizerPilot) -> None:
    """Plays a case for 6 s."""
    for time, give in case.sent:
        await pilot.advance(max(0.0, time - pilot.now))
        give(pilot)
    await pilot.advance(6.0 - pilot.now)


def misses(case: Case, pilot: RealizerPilot, frames: Sequence[Shown]) -> Iterator[Miss]:
    """The reported ready and stroke points at which a hand is elsewhere, although no warning names the point."""
    warned = " ".join(message.text for message in pilot.feedback.of("warningFeedback"))
    for message in pilot.feedback.of("syncPointProgress"):
        behavior, _, sync = message.id.rpartition(":")
        if sync not in ("ready", "stroke") or f"{behavior.partition(':')[2]}:{sync}" in warned:
            continue
        frame = next((frame for frame in frames if frame.time >= message.global_time - 1e-6), None)
        for side in case.sides.get(behavior, "") if frame else "":
            assert frame is not None
            off = distance(*(body.transform(f"{side}_wrist").position for body in frame[1:]))
            cosine = dot(*(_finger(body, side) for body in frame[1:]))
            turned = math.degrees(math.acos(min(1.0, cosine))) if ":p" in behavior else 0.0
            if off > NEAR or turned > AIMED:
                yield Miss(f"{message.id} ({side}) at {message.global_time:.3f}", off, turned)


def _finger(body: Body, side: str) -> Vec3:
    """The direction of an index finger."""
    base, tip = (body.transform(f"{side}_index{i}").position for i in (1, 3))
    return unit(subtract(tip, base))


@contextmanager
def recorded() -> Iterator[list[Shown]]:
    """Records the wanted and the shown bodies of a single figure."""
    frames: list[Shown] = []
    limited = SpeedLimit.__call__

    def call(self: SpeedLimit, wanted: Body, duration: float) -> Body:
        shown = limited(self, wanted, duration)
        frames.append(Shown((frames[-1].time if frames else 0.0) + duration, wanted, shown))
        return shown

    SpeedLimit.__call__ = call  # type: ignore[method-assign]
    try:
        yield frames
    finally:
        SpeedLimit.__call__ = limited  # type: ignore[method-assign]


async def examine(seed: int) -> list[Miss]:
    """The misses of a random case."""
    case = random_case(seed)
    with recorded() as frames:
        async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
            pilot.watch()
            await perform(case, pilot)
            return [*misses(case, pilot, frames)]


def main(count: int, first: int = 0) -> None:
    """Prints the misses of some cases."""
    logging.disable()
    missed = 0
    for seed in range(first, first + count):
        found = asyncio.run(examine(seed))
        missed += bool(found)
        for miss in found:
            sys.stdout.write(f"{seed} {miss.point}: {100 * miss.distance:.1f} cm, {miss.angle:.1f} degrees\n")
            sys.stdout.flush()
    sys.stdout.write(f"{missed} of {count} blocks miss\n")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
