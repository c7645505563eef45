"""A procedural animation as it is: head movements, and what a planner asks for by file."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.arrival import Arrival
from reactive_realizer.engines.animation.motion_unit import ANY_VALUE, Moment, Posed, Resource, arms_of, completed
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation, Timing
from reactive_realizer.engines.animation.procedural.tracks import ROOT
from reactive_realizer.planunit.parameter import Range

REPEATS = "r"
"""The parameter that says how often an animation repeats its stroke, by convention of the published files."""

_LEGS = frozenset(f"{side}_{joint}" for side in "lr" for joint in ("hip", "knee", "ankle", "midtarsal"))


class ProcMotionUnit:
    """Plays a ProcAnimation, with values for its parameters.

    It begins from where the body is (`Arrival`) and ends where its file ends: what follows goes on from there, and the
    way back to rest, where nothing does, is the engine's.

    With r repeats the stroke comes r times, a period of 1/r of the whole apart: stroke:1 to stroke:r.
    """

    group: str | None = None
    lasts: str | None = None

    def __init__(self, animation: ProcAnimation, parameters: Mapping[str, float], kind: LayerKind) -> None:
        """Prepares a motion.

        Args:
            animation: what to play.
            parameters: values for some of its parameters; names it does not know are of no effect.
            kind: where it lies among the layers; an additive one owns nothing, one of the full body also the stance.

        Raises:
            RealizerError: "no-motion": durations or key positions make no sense with these values.
        """
        self.parameters = animation.values(parameters)
        self.ranges: Mapping[str, Range] = dict.fromkeys(self.parameters, ANY_VALUE)
        self.kind = kind
        self.resources = _resources(animation, kind)
        self._animation = animation
        # Where things happen is planned once: a parameter that changes while it plays changes the motion only.
        self._timing = animation.timing(self.parameters)
        self._key_positions = _with_repeats(self._timing, round(self.parameters.get(REPEATS, 1.0)))
        self._arrival: Arrival | None = None

    @property
    def joints(self) -> frozenset[str]:
        """The joints that the animation turns."""
        return self._animation.joints

    @property
    def key_positions(self) -> Mapping[str, float]:
        """As authored; with repeats completed to seven points."""
        return self._key_positions

    @property
    def preferred_duration(self) -> float:
        """As authored, s."""
        return self._timing.duration

    @property
    def limits(self) -> tuple[float, float] | None:
        """Shortest and longest duration, s, if authored."""
        return self._timing.limits

    def start(self, body: Body) -> None:
        """What is added does not care; else the first pose is reached from here."""
        if self.kind is not LayerKind.ADDITIVE:
            self._arrival = Arrival(body, self._timing.duration)

    def pose(self, moment: Moment) -> Posed:
        """The animation's rotations, and what is left of the way to them."""
        posed = self._animation.sample(moment.phase, self.parameters, moment.body)
        return posed if self._arrival is None else self._arrival(posed, moment.phase)


def kind_of(animation: ProcAnimation) -> LayerKind:
    """Where an animation lies among the layers: over what moves legs or the root, gaze and gestures go on."""
    full_body = animation.root is not None or animation.joints & (_LEGS | {ROOT})
    return LayerKind.FULL_BODY if full_body else LayerKind.GESTURE


def _resources(animation: ProcAnimation, kind: LayerKind) -> frozenset[str]:
    if kind is LayerKind.ADDITIVE:
        return frozenset()
    arms = arms_of(animation.joints)
    return arms | {Resource.STANCE} if kind is LayerKind.FULL_BODY else arms


def _with_repeats(timing: Timing, repeats: int) -> dict[str, float]:
    if repeats < 2:
        # Points that nobody authored would be holds, which take what time there is.
        inner = ((sync, at) for sync, at in timing.key_positions.items() if sync not in ("start", "end"))
        return {"start": 0.0, **dict(sorted(inner, key=lambda key: key[1])), "end": 1.0}
    keys = completed(timing.key_positions)
    first = keys["stroke"]
    return completed({**keys, **{f"stroke:{i + 1}": min(1.0, first + i / repeats) for i in range(repeats)}})
