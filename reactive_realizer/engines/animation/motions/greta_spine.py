"""Movements of the head and the torso from libraries of Greta, added to what these do otherwise."""

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache, reduce
from itertools import pairwise
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.binding.spine_library import SpineLibrary, SpineMovement, SpinePoint, sequence
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Head
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, multiply
from reactive_realizer.embodiment.spine import folded_spine
from reactive_realizer.embodiment.vector import ZERO, Vec3, length, scale, subtract
from reactive_realizer.engines.animation.expression.syntax import Constant, Variable
from reactive_realizer.engines.animation.faults import NoGoals
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import AMOUNT
from reactive_realizer.engines.animation.motions.library_names import from_library
from reactive_realizer.engines.animation.motions.procedural import ProceduralMotionUnit
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.spine_track import SpineKey, SpineTrack
from reactive_realizer.errors import RealizerError

_KEPT = 0.4
"""Duration for which a pose is kept, s."""
_SPEED, _MORE = math.radians(58.5), math.radians(10.0)
"""A way of an angle takes as long as one that is so much longer, at this speed: that of Greta at half of its tempo."""


class _Part(NamedTuple):
    """How a part of the body moves.

    Attributes:
        file: the name of the library in Greta.
        ranges: the greatest rotations about the axes left, up and ahead, rad (Greta's ``HeadIntervals.xml`` and
            ``TorsoIntervals.xml``; it lets the torso tilt by 0.45 of these).
        shares: of the joints in them.
    """

    file: str
    ranges: Vec3
    shares: Mapping[str, float]


_PARTS: Final[Mapping[str, _Part]] = MappingProxyType(
    {
        "head": _Part(
            "HeadGestures.xml",
            (math.radians(50.0), math.radians(90.0), math.radians(60.0)),
            {"vc4": 0.5, "skullbase": 0.5},
        ),
        "torso": _Part(
            "TorsoGestures.xml",
            (math.radians(0.45 * 45.0), math.radians(45.0), math.radians(0.45 * 45.0)),
            {"vl5": 0.6, "vt10": 0.2, "vt6": 0.2},
        ),
    }
)


class GretaSpineMaker:
    """Makes movements of one part."""

    def __init__(self, context: MakerContext, part: str) -> None:
        self._context = context
        self._part = part

    def __call__(self, request: MotionRequest) -> ProceduralMotionUnit:
        """Make a movement.

        Raises:
            RealizerError: there is no such file or movement, or nothing of it can be played.
        """
        behavior, rest = request.behavior, self._context.rest.body
        movement = from_library(request, self._library(request.file).movement)
        repetition = behavior.repetition if isinstance(behavior, Head) else 1
        amount = finite_numbers(request.parameters).get(AMOUNT, _amount(behavior))
        motion = _planned(movement, self._part, repetition, amount, rest).copy()
        motion.notes = movement.faults
        return motion

    def names(self, file: str | None) -> tuple[str, ...]:
        """Return the ids of the movements of a file.

        Raises:
            RealizerError: there is no such file, or it is invalid.
        """
        return tuple(movement.id for movement in self._library(file).movements)

    def _library(self, file: str | None) -> SpineLibrary:
        return SpineLibrary.read(self._context.asset(file or f"**/{_PARTS[self._part].file}"), self._part)


def _amount(behavior: Behavior) -> float:
    return behavior.amount if isinstance(behavior, Head) else 1.0


@lru_cache(256)
def _planned(movement: SpineMovement, part: str, repetition: int, amount: float, rest: Body) -> ProceduralMotionUnit:
    animation = _animation(movement, _PARTS[part], repetition, amount, rest.skeleton)
    return ProceduralMotionUnit(animation, {AMOUNT: amount}, LayerKind.ADDITIVE, rest)


class _Bend(NamedTuple):
    """A part of the body at a point.

    Attributes:
        least: its tilts at the amount 0, rad.
        most: the same at the amount 1.
        turns: rotations of joints of the figure.
    """

    least: Vec3 = ZERO
    most: Vec3 = ZERO
    turns: Mapping[str, Quat] = MappingProxyType({})

    def way(self, other: "_Bend", amount: float) -> float:
        """Return how far it is to another one, rad."""
        mine, others = ([a + amount * (b - a) for a, b in zip(*ends, strict=True)] for ends in (self[:2], other[:2]))
        tilted = length(subtract((mine[0], mine[1], mine[2]), (others[0], others[1], others[2])))
        joints = self.turns.keys() | other.turns.keys()
        return tilted + sum(
            angle(multiply(_inverse(self.turns.get(joint, IDENTITY)), other.turns.get(joint, IDENTITY)))
            for joint in joints
        )


def _inverse(turn: Quat) -> Quat:
    w, x, y, z = turn
    return (w, -x, -y, -z)


def _bend(point: SpinePoint, part: _Part, skeleton: Skeleton) -> _Bend:
    """Return a point for a figure; rotations of joints that it lacks pass to their neighbors."""
    ends = []
    for values in ([(tilt.axis, tilt.least) for tilt in point.tilts], [(tilt.axis, tilt.most) for tilt in point.tilts]):
        x, y, z = (part.ranges[axis] * sum(value for each, value in values if each == axis) for axis in range(3))
        ends.append((x, y, z))
    turns = dict(point.rotations)
    folded = folded_spine(turns, skeleton.joints)
    return _Bend(ends[0], ends[1], {j: reduce(multiply, (turns[each] for each in own)) for j, own in folded.items()})


def _animation(
    movement: SpineMovement, part: _Part, repetition: int, amount: float, skeleton: Skeleton
) -> ProceduralAnimation:
    """Return the animation of a movement: from rest through its points, and back.

    Raises:
        RealizerError: "no-goals": it has no points.
    """
    points = [(number, _bend(point, part, skeleton)) for number, point in sequence(movement, repetition)]
    if not points:
        raise RealizerError(NoGoals(reasons=(f"{movement.id} has no points",)))
    bends = [_Bend(), *(bend for _, bend in points), _Bend()]
    kept = _KEPT if len(points) == 1 and not movement.points[0].kind else 0.0
    times = [0.0]
    for before, after in pairwise(bends):
        way = before.way(after, amount)
        times.append(times[-1] + (way + _MORE) / _SPEED)
    reached = times[1:-1]
    left = reached[-1] + kept
    duration = times[-1] + kept
    keys = [*zip(times[:-1], bends[:-1], strict=True), (left, bends[-2]), (duration, bends[-1])]
    strokes = {number: time for (number, _), time in reversed(list(zip(points, reached, strict=True)))}
    return ProceduralAnimation(
        name=movement.id,
        parameters={AMOUNT: amount},
        durations=(Constant(duration),) * 3,
        key_times={
            name: Constant(time / duration) for name, time in _points(strokes, reached[0], left, duration).items()
        },
        tracks=tuple(_tracks([(time / duration, bend) for time, bend in keys], part, skeleton)),
    )


def _points(strokes: Mapping[int, float], ready: float, left: float, duration: float) -> dict[str, float]:
    """Return the sync points of a movement, s."""
    numbered = {f"stroke:{number + 1}": time for number, time in sorted(strokes.items())}
    stroke = {"stroke": ready} if len(numbered) == 1 else numbered
    return {
        "start": 0.0,
        "ready": ready,
        "strokeStart": ready,
        **stroke,
        "strokeEnd": left,
        "relax": left,
        "end": duration,
    }


def _tracks(keys: Sequence[tuple[float, _Bend]], part: _Part, skeleton: Skeleton) -> Iterator[SpineTrack]:
    turned = {joint for _, bend in keys for joint in bend.turns}
    for joint in skeleton.joints:
        share = part.shares.get(joint, 0.0)
        if share or joint in turned:
            yield SpineTrack(
                joint,
                Variable(AMOUNT),
                tuple(
                    SpineKey(phase, scale(bend.least, share), scale(bend.most, share), bend.turns.get(joint, IDENTITY))
                    for phase, bend in keys
                ),
            )
