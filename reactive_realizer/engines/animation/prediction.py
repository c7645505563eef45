"""How the body will move: the Animation Predictor (thesis 4.2.4)."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import pairwise

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, compose
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import ZERO
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import Foreseen, Moment, layer_of
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit

_STEP = 0.01
"""s over which velocities are measured."""


class AnimationPredictor:
    """Asks the motions of a plan what they will show; their clocks and their units do not notice."""

    def __init__(self, skeleton: Skeleton, base: Callable[[], Layer], units: Callable[[], Iterable[PlanUnit]]) -> None:
        """Predicts for a figure.

        Args:
            skeleton: the figure's.
            base: what lies below all motions.
            units: the plan, in order of planning.
        """
        self._skeleton = skeleton
        self._base = base
        self._units = units

    def moving(self, time: GlobalTime, without: AnimationUnit) -> Moving:
        """How the body will move at a time and just after it, as the plan stands, if one unit does nothing."""
        now, soon = self._body(time, time, without), self._body(time, GlobalTime(time + _STEP), without)
        return Moving(now, Moving.between(now, soon, _STEP).velocities)

    def _body(self, start: GlobalTime, time: GlobalTime, without: AnimationUnit) -> Body:
        """At a time, of the units that will play from a start on."""
        below = self._base()
        body = Body(self._skeleton, dict(below.rotations), below.root or ZERO)
        layers = [below]
        for unit in sorted(self._predictable(start), key=lambda unit: unit.times_around[0] or start):
            if unit is not without:
                with suppress(RealizerError):  # one that cannot be shown will leave, with a word of its own
                    layers.append(layer_of(unit.motion, Moment(phase_at(unit, time), time, body)))
        return compose(self._skeleton, layers).steady

    def _predictable(self, start: GlobalTime) -> Iterator[AnimationUnit]:
        """The units that will play from a start on and of which one knows what they will show."""
        for unit in self._units():
            if isinstance(unit, AnimationUnit) and _plays(unit, start) and _known(unit):
                yield unit


def phase_at(unit: AnimationUnit, time: GlobalTime) -> float:
    """The phase of a unit at a time, from the times of its points alone."""
    known = [(at, unit.keys[sync]) for sync, at in unit.times().items() if at is not None]
    for (before, left), (after, right) in pairwise(known):
        if time < after:
            return left + (right - left) * share(time, before, after)
    return known[-1][1]


def _known(unit: AnimationUnit) -> bool:
    if not unit.begun:
        return unit.motion.foreseen is Foreseen.ALWAYS
    # What has not shown itself yet does not know with which pose it begins, and must not learn it here.
    return bool(unit.shown.rotations) and unit.motion.foreseen is not Foreseen.NEVER


def _plays(unit: AnimationUnit, time: GlobalTime) -> bool:
    start, end = unit.times_around
    return is_due(start, time) and (end is None or time < end)
