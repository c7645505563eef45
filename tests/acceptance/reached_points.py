"""Random sessions with tight timings, and where the hands are when their sync points are reported.

``python -m tests.acceptance.reached_points COUNT [FIRST]`` examines many sessions, and prints what they miss.
"""

import asyncio
import logging
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from random import Random
from typing import NamedTuple

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.behaviors import Gesture, Pointing
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.inertialization import Inertialization
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.vector import Vec3, distance, dot, subtract, unit
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

NEAR, AIMED = 0.02, 2.0
"""How far a wrist (m) and the direction of a pointing finger (degrees) may be from where the motion wants them."""

_AT_ONCE = 1e-3
"""Time in which a hand moves by millimeters, s."""

_REPLACED = 0.1
"""A wrist whose goal moves further in a frame has another motion, m."""

GESTURES = ("BEAT", "OFFER", "WAVE", "CONDUCT", "SELF", "CONDUIT", "CHOP", "FLICK", "ONE")
TARGETS = ("bluebox", "greensphere")
MODES = ("", ' mode="LEFT_HAND"', ' mode="RIGHT_HAND"', ' mode="BOTH_HANDS"')
POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
SPEECH = '<speech id="s"{}><text>One <sync id="w"/>two three <sync id="x"/>four.</text></speech>'
INTERRUPT = '<bmla:interrupt id="i" target="{}"/>'
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


class Record(NamedTuple):
    """What is recorded of a single figure.

    Attributes:
        frames: in order of time.
        hands: that a gesture or pointing moves, by ``block:behavior``: "l", "r" or both.
    """

    frames: list[Shown]
    hands: dict[str, str]


class Reached(NamedTuple):
    """A ready or stroke that is reported, and how far a hand is from where its motion wants it.

    Attributes:
        point: with the hand and the time.
        distance: of the wrist, m.
        angle: of a pointing finger, degrees; 0 for a gesture.
    """

    point: str
    distance: float
    angle: float = 0.0

    @property
    def missed(self) -> bool:
        """Whether the hand is too far away."""
        return self.distance > NEAR or self.angle > AIMED


class Case(NamedTuple):
    """A session.

    Attributes:
        strategy: that plans its blocks.
        sent: times (s), in order, each with the input that the pilot gives then.
    """

    strategy: str
    sent: Sequence[tuple[float, Callable[[RealizerPilot], None]]]


def random_case(seed: int) -> Case:
    """One or two blocks with gestures, pointings and other behaviors, interruptions, and predictions often late."""
    random = Random(seed)
    strategy = random.choice(("convex", "convex", "embr", "smartbody"))
    sent = [(random.uniform(0.0, 0.3), partial(_send, "b0", _block(random), "MERGE"))]
    if random.random() < 0.5:
        how = random.choice(("MERGE", "APPEND", "REPLACE"))
        sent.append((random.uniform(0.4, 2.0), partial(_send, "b1", _block(random), how)))
    if random.random() < 0.2:
        target = random.choice(("b0", "b1"))
        sent.append((random.uniform(0.4, 2.0), partial(_send, "i", INTERRUPT.format(target), "MERGE")))
    if random.random() < 0.8:
        sent.append((0.0, partial(_predict, random.uniform(0.2, 2.0))))
    for _ in range(random.choice((0, 1, 1, 2, 3))):
        time = random.uniform(0.2, 2.0)
        sent.append((time, partial(_predict, time + random.uniform(-0.2, 1.2))))
    sent.append((2.01, partial(_predict, random.uniform(2.1, 3.1))))  # so that nothing waits for ever
    return Case(strategy, sorted(sent, key=lambda each: each[0]))


def _send(name: str, text: str, composition: str, pilot: RealizerPilot) -> None:
    pilot.block(name, text, composition=composition)


def _predict(time: float, pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", time)


def _block(random: Random) -> str:
    parts, first = [SPEECH.format(random.choice(STARTS))], ""
    for number in range(random.choice((1, 1, 2))):
        points = sorted(random.sample(range(7), random.choice((0, 1, 1, 1, 2, 2, 3))))
        times = sorted(round(random.uniform(0.0, 1.6), 2) for _ in points)
        places = (time if random.random() < 0.3 else random.choice(REFERENCES) for time in times)
        named = {POINTS[k]: place for k, place in zip(points, places, strict=True)}
        if number and random.random() < 0.4:
            named["start"] = f"{first}:{random.choice(('strokeEnd', 'relax', 'relax', 'end'))}"
        ties = "".join(f' {point}="{place}"' for point, place in named.items())
        mode = random.choice(MODES)
        if random.random() < 0.7:
            id_ = f"g{number}"
            parts.append(f'<gesture id="{id_}" lexeme="{random.choice(GESTURES)}"{mode}{ties}/>')
        else:
            id_ = f"p{number}"
            parts.append(f'<pointing id="{id_}" target="{random.choice(TARGETS)}"{mode}{ties}/>')
        first = first or id_
    if random.random() < 0.4:
        parts.append(random.choice(OTHERS))
    return "".join(parts)


async def perform(case: Case, pilot: RealizerPilot) -> None:
    """Plays a case until its blocks have ended, for at most 8 s."""
    for time, give in case.sent:
        await pilot.advance(max(0.0, time - pilot.now))
        give(pilot)
    await pilot.advance(0.1)
    while pilot.now < 8.0 and pilot.realizer.scheduler.blocks.alive:
        await pilot.advance(0.1)
    await pilot.advance(0.02)  # a frame after the last point


def reached(pilot: RealizerPilot, record: Record) -> Iterator[Reached]:
    """The reported ready and stroke points that no warning names, once for each hand."""
    warned = " ".join(message.text for message in pilot.feedback.of("warningFeedback"))
    for message in pilot.feedback.of("syncPointProgress"):
        behavior, _, sync = message.id.rpartition(":")
        if sync in ("ready", "stroke") and f"{behavior.partition(':')[2]}:{sync}" not in warned:
            for side in record.hands.get(behavior, ""):
                shown = _shown_at(message.global_time, side, record.frames)
                offs = [_off(each, side, ":p" in behavior) for each in shown]
                yield Reached(f"{message.id} ({side}) at {message.global_time:.3f}", *min(offs))


def _shown_at(time: float, side: str, frames: Sequence[Shown]) -> Iterator[Shown]:
    """The frame after a point, and the one before, if the motion has come near the point by then, or was replaced.

    A hand that is there in the frame before may have left in the one after.
    """
    after = next(index for index, frame in enumerate(frames) if frame.time >= time - _AT_ONCE)
    yield frames[after]
    if after >= 2:
        goals = [frame.wanted.transform(f"{side}_wrist").position for frame in frames[after - 2 : after + 1]]
        if distance(*goals[:2]) < NEAR or distance(*goals[1:]) > _REPLACED:
            yield frames[after - 1]


def _off(frame: Shown, side: str, points: bool) -> tuple[float, float]:
    """How far a wrist is from where it should be, m, and a pointing finger, degrees."""
    off = distance(*(body.transform(f"{side}_wrist").position for body in (frame.wanted, frame.shown)))
    cosine = dot(*(_finger(body, side) for body in (frame.wanted, frame.shown))) if points else 1.0
    return off, math.degrees(math.acos(min(1.0, cosine)))


def _finger(body: Body, side: str) -> Vec3:
    """The direction of an index finger."""
    base, tip = (body.transform(f"{side}_index{i}").position for i in (1, 3))
    return unit(subtract(tip, base))


@contextmanager
def recorded() -> Iterator[Record]:
    """Records a single figure."""
    record = Record([], {})
    inertialized, note, start = Inertialization.__call__, Inertialization.note_shown, AnimationUnit.on_start
    goals: list[Body] = []

    def call(self: Inertialization, goal: Body, now: GlobalTime) -> Body:
        goals.append(goal)
        return inertialized(self, goal, now)

    def note_shown(self: Inertialization, body: Body, now: GlobalTime) -> None:
        record.frames.append(Shown(now, goals[-1], body))
        note(self, body, now)

    def on_start(self: AnimationUnit, time: GlobalTime) -> None:
        if isinstance(self.behavior, Gesture | Pointing):
            hands = (side for side in SIDES if f"{side}_shoulder" in self.motion.joints)
            record.hands[f"{self.block.block}:{self.behavior.id}"] = "".join(hands)
        start(self, time)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Inertialization, "__call__", call)
        patch.setattr(Inertialization, "note_shown", note_shown)
        patch.setattr(AnimationUnit, "on_start", on_start)
        yield record


async def examine(seed: int) -> list[Reached]:
    """The points that are reached in a random case."""
    case = random_case(seed)
    with recorded() as record:
        async with open_pilot(SceneOptions(voice="text", strategy=case.strategy, verify=True)) as pilot:
            pilot.watch()
            await perform(case, pilot)
            return [*reached(pilot, record)]


def main(count: int, first: int = 0) -> None:
    """Prints the misses of some cases."""
    logging.disable()
    points = missed = 0
    for seed in range(first, first + count):
        found = asyncio.run(examine(seed))
        points += len(found)
        misses = [each for each in found if each.missed]
        missed += bool(misses)
        for miss in misses:
            sys.stdout.write(f"{seed} {miss.point}: {100 * miss.distance:.1f} cm, {miss.angle:.1f} degrees\n")
            sys.stdout.flush()
    sys.stdout.write(f"{missed} of {count} sessions miss; {points} points\n")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
