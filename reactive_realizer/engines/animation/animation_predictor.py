"""Predicts how the body will move: the Animation Predictor (thesis 4.2.4)."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import pairwise

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, is_due
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.embodiment.vector import ZERO
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.easing import share
from reactive_realizer.engines.animation.kinematics import BodySample, KinematicState, MotionHistory
from reactive_realizer.engines.animation.motion_unit import Moment, Predictability, layer_of
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit

_STEP = 0.002
"""Step of the finite differences with which motions are sampled, s."""

_SAME = 1e-4
"""A joint within this angle of the requested rotation counts as following its motion, rad."""


class AnimationPredictor:
    """Samples the motions of a plan at any time, without affecting their clocks or units."""

    def __init__(
        self,
        skeleton: Skeleton,
        base: Callable[[], Layer],
        units: Callable[[], Iterable[PlanUnit]],
        history: MotionHistory,
    ) -> None:
        """Create the predictor of a figure.

        Args:
            skeleton: of the figure.
            base: returns the layer below all motions.
            units: returns the plan, in order of planning; a unit that ends at a time still counts at that time.
            history: of the body.
        """
        self._skeleton = skeleton
        self._base = base
        self._units = units
        self._history = history

    def state_after(self, time: GlobalTime, without: AnimationUnit) -> KinematicState:
        """Return the planned kinematic state just after a time, with one unit left out."""
        return self._through(
            [unit for unit in self._known() if unit is not without and _plays_after(unit, time)], time, _STEP
        )

    def state_before(self, time: GlobalTime) -> KinematicState:
        """Return the kinematic state just before the current time.

        It is estimated from recent frames. For joints that follow planned motions, it is computed exactly from these.
        """
        state, latest = self._history.state_at(time), self._history.latest(time)
        units = [unit for unit in self._known() if _played_before(unit, time)]
        if not units or latest is None:
            return state
        # A motion without time for its return has left at the time itself.
        just_before = GlobalTime(time - RESOLUTION)
        known, then = self._through(units, just_before, -_STEP), self._body(units, latest.time)
        exact = [j for j in known.velocities if angle(difference(then.rotation(j), latest.body.rotation(j))) < _SAME]
        velocities, accelerations = ({j: of[j] for j in exact} for of in (known.velocities, known.accelerations))
        body = state.body.posed({joint: known.body.rotation(joint) for joint in exact})
        return KinematicState(body, {**state.velocities, **velocities}, accelerations)

    def _known(self) -> Iterator[AnimationUnit]:
        """Yield the units with a predictable layer; additive motion does not count."""
        for unit in self._units():
            if isinstance(unit, AnimationUnit) and unit.motion.kind is not LayerKind.ADDITIVE and _foreseen(unit):
                yield unit

    def _through(self, units: list[AnimationUnit], time: GlobalTime, step: float) -> KinematicState:
        """Return the kinematic state that units give a body at a time, by finite differences over two steps."""
        units.sort(key=lambda unit: unit.start_and_end[0] or time)
        times = (GlobalTime(time + steps * step) for steps in (2, 1, 0))
        return KinematicState.second_order(*(BodySample(at, self._body(units, at)) for at in times))

    def _body(self, units: Iterable[AnimationUnit], time: GlobalTime) -> Body:
        """Return the body at a time under the given units, those that started first at the bottom."""
        below = self._base()
        body = Body(self._skeleton, dict(below.rotations), below.root or ZERO)
        layers = [below]
        for unit in units:
            with suppress(RealizerError):  # a unit that cannot be shown will be stopped, with a warning of its own
                layers.append(layer_of(unit.motion, Moment(phase_at(unit, time), time, body)))
        return compose(self._skeleton, layers).steady


def phase_at(unit: AnimationUnit, time: GlobalTime) -> float:
    """Return the phase of a unit at a time, from the times of its points alone."""
    known = [(at, unit.keys[point.id]) for point in unit.points if (at := point.peg.value) is not None]
    for (before, left), (after, right) in pairwise(known):
        if time < after:
            return left + (right - left) * share(time, before, after)
    return known[-1][1]


def _foreseen(unit: AnimationUnit) -> bool:
    if not unit.begun:
        return unit.motion.predictability is Predictability.ALWAYS
    # A unit that was not shown yet has not fixed its start pose, and sampling it must not fix it.
    return bool(unit.shown.rotations) and unit.motion.predictability is not Predictability.NEVER


def _plays_after(unit: PlanUnit, time: GlobalTime) -> bool:
    start, end = unit.start_and_end
    return is_due(start, time) and (end is None or time < end)


def _played_before(unit: PlanUnit, time: GlobalTime) -> bool:
    start, end = unit.start_and_end
    return unit.begun and start is not None and start < time and (end is None or is_due(time, end))
