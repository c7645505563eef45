"""The timing that a behavior prefers, from the motion that plays it."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise
from math import inf
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.behaviors import Pointing
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.motion_unit import MotionUnit, with_gesture_points
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

PhaseEnds = tuple[str, str]
"""The sync points at the ends of a phase."""

_NO_HOLDS: frozenset[PhaseEnds] = frozenset()

_MOST_TIMINGS = 1000
"""Number of cached timings: most motions are planned repeatedly."""

_HOLDS = frozenset({("ready", "strokeStart"), ("strokeEnd", "relax")})
"""The hands hold before and after a stroke."""

_STAYS = frozenset({("strokeStart", "stroke"), ("stroke", "strokeEnd")})
"""The stroke of a pointing gesture is a hold."""


def motion_timing(behavior: Behavior, motion: MotionUnit, keys: Mapping[str, float]) -> Timing:
    """Return the preferred timing of a behavior, from the key positions of its motion.

    Args:
        behavior: to play.
        motion: that plays it.
        keys: the phase of each point of the motion, and of each that BML defines for the behavior.
    """
    # Additive motion has no holds: points that coincide stay together.
    waits = motion.kind is not LayerKind.ADDITIVE
    holds = _holds(isinstance(behavior, Pointing), behavior.sync_points) if waits else _NO_HOLDS
    first, last = (motion.key_positions[point] for point in motion.authored)
    limits = _Limits(first, last, *(motion.stretch or (0.0, inf)))
    shortest = tuple(motion.shortest.items())
    return _timing(tuple(keys.items()), motion.preferred_duration, shortest, limits, holds, behavior.persistent)


def keys_of(behavior: Behavior, motion: MotionUnit) -> dict[str, float]:
    """Return the phase of each point of a behavior that a motion plays, in order."""
    wanted = (*behavior.sync_points, *behavior.instead_of)
    keys = motion.key_positions
    if not keys.keys() >= set(wanted):
        keys = with_gesture_points(keys)
    # A motion with several strokes has no single stroke point.
    return {sync: phase for sync, phase in keys.items() if sync != "stroke" or "stroke:1" not in keys}


class _Limits(NamedTuple):
    """The durations that an author allows for each phase in a part of a motion, relative to the preferred ones.

    Attributes:
        first: the phase at which the part begins, 0 to 1.
        last: the phase at which it ends.
        least: stretch of each of its phases.
        most: likewise.
    """

    first: float
    last: float
    least: float
    most: float


@lru_cache(_MOST_TIMINGS)
def _timing(
    keys: tuple[tuple[str, float], ...],
    duration: float,
    shortest: tuple[tuple[str, float], ...],
    limits: _Limits,
    holds: frozenset[PhaseEnds],
    persistent: bool,
) -> Timing:
    needs = dict(shortest)
    phases = []
    for (point, begin), (other, end) in pairwise(keys):
        part = end - begin
        # The parts add up to the duration, except for their rounding.
        need = min(needs.get(other, 0.0), part * duration)
        if (point, other) in holds:
            phases.append(Phase(part * duration, PhaseKind.HOLD, shortest=need))
        elif part > 0.0 and limits.first <= begin and end <= limits.last:
            preferred = part * duration
            least, most = limits.least * preferred, limits.most * preferred
            phases.append(Phase(preferred, PhaseKind.ELASTIC, least, most, need))
        else:
            phases.append(Phase(part * duration, PhaseKind.ELASTIC, shortest=need))
    return Timing(tuple(point for point, _ in keys), tuple(phases), persistent=persistent)


@lru_cache(_MOST_TIMINGS)
def _holds(pointing: bool, points: SyncPoints) -> frozenset[PhaseEnds]:
    """Return the phases that are holds."""
    if pointing:
        return _HOLDS | _STAYS
    # A motion that only comes and goes, such as a gaze, holds in between.
    return _HOLDS | ({("ready", "relax")} & set(pairwise(points)))
