"""A procedural animation as it is: head movements, and what a planner asks for by file."""

from collections.abc import Mapping

from reactive_realizer.bml.behaviors import MOST_REPETITIONS
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.arrival import Arrival
from reactive_realizer.engines.animation.motion_unit import (
    ANY_VALUE,
    OF_FILES,
    Foreseen,
    Moment,
    MotionUnit,
    Posed,
    Resource,
    completed,
    in_order,
    owned,
)
from reactive_realizer.engines.animation.procedural.proc_animation import AuthoredTiming, ProcAnimation
from reactive_realizer.engines.animation.values import check
from reactive_realizer.planunit.parameter import Range

REPEATS = "r"
"""The parameter that says how often an animation repeats its stroke, by convention of the published files."""

_REPEATS_RANGE = Range(0.0, float(MOST_REPETITIONS))


class ProcMotionUnit(MotionUnit):
    """Plays a ProcAnimation, with values for its parameters.

    It begins from where the body is (`Arrival`) and ends where its file ends: what follows goes on from there, and the
    way back to rest, where nothing does, is the engine's.

    With r repeats the stroke comes r times, a period of 1/r of the whole apart: stroke:1 to stroke:r.
    """

    fixed = OF_FILES
    foreseen = Foreseen.ALWAYS

    def __init__(self, animation: ProcAnimation, parameters: Mapping[str, float], kind: LayerKind) -> None:
        """Prepares a motion.

        Args:
            animation: what to play.
            parameters: values for some of its parameters; names it does not know are of no effect.
            kind: where it lies among the layers; an additive one owns nothing, one of the full body also the stance.

        Raises:
            RealizerError: "no-motion", "bad-keys": durations or key positions make no sense with these values;
                "bad-parameter": it would repeat too often.
        """
        self.parameters = animation.values(parameters)
        self.ranges = {name: _REPEATS_RANGE if name == REPEATS else ANY_VALUE for name in self.parameters}
        check(self.parameters, self.ranges)
        self.kind = kind
        self.joints, self.lacking = animation.joints, animation.lacking
        self.resources = frozenset() if kind is LayerKind.ADDITIVE else _owned(animation)
        self._animation = animation
        # Where things happen is planned once: a parameter that changes while it plays changes the motion only.
        timing = animation.timing(self.parameters)
        self.preferred_duration, self.limits = timing.duration, timing.limits
        self.key_positions = _with_repeats(timing, round(self.parameters.get(REPEATS, 1.0)))
        self._arrival: Arrival | None = None

    def start(self, body: Body) -> None:
        """What is added does not care; else the first pose is reached from here."""
        if self.kind is not LayerKind.ADDITIVE:
            first = self._animation.sample(0.0, self.parameters, body)
            self._arrival = Arrival(body, first, self.preferred_duration)

    def pose(self, moment: Moment) -> Posed:
        """The animation's rotations, and what is left of the way to them."""
        posed = self._animation.sample(moment.phase, self.parameters, moment.body, moment.shown)
        if moment.shown is not None:
            self.fault = self.fault or posed.fault
        return posed if self._arrival is None else self._arrival(posed, moment.phase)


def kind_of(animation: ProcAnimation) -> LayerKind:
    """Where an animation lies among the layers: over what moves legs or the root, gaze and gestures go on."""
    return LayerKind.FULL_BODY if Resource.STANCE in _owned(animation) else LayerKind.GESTURE


def _owned(animation: ProcAnimation) -> frozenset[str]:
    return owned(animation.joints if animation.root is None else animation.joints | {ROOT})


def _with_repeats(timing: AuthoredTiming, repeats: int) -> dict[str, float]:
    if repeats < 2:
        return in_order(timing.key_positions)
    keys = completed(timing.key_positions)
    first = keys["stroke"]
    return completed({**keys, **{f"stroke:{i + 1}": min(1.0, first + i / repeats) for i in range(repeats)}})
