"""How the body will move: the Animation Predictor (thesis 4.2.4)."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import pairwise

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import ZERO
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.motion_unit import Foreseen, Moment, layer_of
from reactive_realizer.engines.animation.moving import Moving, Seen
from reactive_realizer.engines.animation.trail import Trail
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit

_STEP = 0.002
"""s between the three times at which motions are asked, to see how they move."""

_SAME = 1e-4
"""rad; a joint that was no further from where motions have it was where they have it."""


class AnimationPredictor:
    """Asks the motions of a plan what they show; their clocks and their units do not notice."""

    def __init__(
        self,
        skeleton: Skeleton,
        base: Callable[[], Layer],
        units: Callable[[], Iterable[PlanUnit]],
        trail: Trail,
    ) -> None:
        """Predicts for a figure.

        Args:
            skeleton: the figure's.
            base: what lies below all motions.
            units: the plan, in order of planning; those that end at a time are still asked for that.
            trail: where the body was last.
        """
        self._skeleton = skeleton
        self._base = base
        self._units = units
        self._trail = trail

    def moving(self, time: GlobalTime, without: AnimationUnit) -> Moving:
        """How the body will move just after a time, as the plan stands, if one unit does nothing."""
        return self._through(
            [unit for unit in self._known() if unit is not without and _plays_after(unit, time)], time, _STEP
        )

    def moved(self, time: GlobalTime) -> Moving:
        """How the body moves just before a time that has come.

        As it was seen; joints that were where motions of the plan have them move as exactly as these do.
        """
        moving, last = self._trail.at(time), self._trail.last(time)
        units = [unit for unit in self._known() if _played_before(unit, time)]
        if not units or last is None:
            return moving
        known, then = self._through(units, time, -_STEP), self._body(units, last.time)
        exact = [j for j in known.velocities if angle(difference(then.rotation(j), last.body.rotation(j))) < _SAME]
        velocities, accelerations = ({j: of[j] for j in exact} for of in (known.velocities, known.accelerations))
        body = moving.body.posed({joint: known.body.rotation(joint) for joint in exact})
        return Moving(body, {**moving.velocities, **velocities}, accelerations)

    def _known(self) -> Iterator[AnimationUnit]:
        """The units of which one knows what they will show; what is only added to a body does not count."""
        for unit in self._units():
            if isinstance(unit, AnimationUnit) and unit.motion.kind is not LayerKind.ADDITIVE and _foreseen(unit):
                yield unit

    def _through(self, units: list[AnimationUnit], time: GlobalTime, step: float) -> Moving:
        """How a body moves at a time that does what units show there and two steps away."""
        units.sort(key=lambda unit: unit.times_around[0] or time)
        times = (GlobalTime(time + steps * step) for steps in (2, 1, 0))
        return Moving.through(*(Seen(at, self._body(units, at)) for at in times))

    def _body(self, units: Iterable[AnimationUnit], time: GlobalTime) -> Body:
        """Under what units show at a time, what started first below."""
        below = self._base()
        body = Body(self._skeleton, dict(below.rotations), below.root or ZERO)
        layers = [below]
        for unit in units:
            with suppress(RealizerError):  # one that cannot be shown will leave, with a word of its own
                layers.append(layer_of(unit.motion, Moment(phase_at(unit, time), time, body)))
        return compose(self._skeleton, layers).steady


def phase_at(unit: AnimationUnit, time: GlobalTime) -> float:
    """The phase of a unit at a time, from the times of its points alone."""
    known = [(at, unit.keys[sync]) for sync, at in unit.times().items() if at is not None]
    for (before, left), (after, right) in pairwise(known):
        if time < after:
            return left + (right - left) * share(time, before, after)
    return known[-1][1]


def _foreseen(unit: AnimationUnit) -> bool:
    if not unit.begun:
        return unit.motion.foreseen is Foreseen.ALWAYS
    # What has not shown itself yet does not know with which pose it begins, and must not learn it here.
    return bool(unit.shown.rotations) and unit.motion.foreseen is not Foreseen.NEVER


def _plays_after(unit: PlanUnit, time: GlobalTime) -> bool:
    start, end = unit.times_around
    return is_due(start, time) and (end is None or time < end)


def _played_before(unit: PlanUnit, time: GlobalTime) -> bool:
    start, end = unit.times_around
    return unit.begun and start is not None and start < time and (end is None or is_due(time, end))
