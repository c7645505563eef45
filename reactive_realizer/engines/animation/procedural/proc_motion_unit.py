"""A procedural animation as it is: head movements, and what a planner asks for by file."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.motion_unit import ANY_VALUE, Moment, Posed, arms_of, completed
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation, Timing
from reactive_realizer.planunit.parameter import Range

REPEATS = "r"
"""The parameter that says how often an animation repeats its stroke, by convention of the published files."""


class ProcMotionUnit:
    """Plays a ProcAnimation, with values for its parameters.

    With r repeats the stroke comes r times, a period of 1/r of the whole apart: stroke:1 to stroke:r.
    """

    group: str | None = None
    lasts: str | None = None

    def __init__(self, animation: ProcAnimation, parameters: Mapping[str, float], kind: LayerKind) -> None:
        """Prepares a motion.

        Args:
            animation: what to play.
            parameters: values for some of its parameters; names it does not know are of no effect.
            kind: where it lies among the layers; an additive one owns nothing.

        Raises:
            RealizerError: "no-motion": durations or key positions make no sense with these values.
        """
        self.parameters = animation.values(parameters)
        self.ranges: Mapping[str, Range] = dict.fromkeys(self.parameters, ANY_VALUE)
        self.kind = kind
        self.resources: frozenset[str] = frozenset() if kind is LayerKind.ADDITIVE else arms_of(animation.joints)
        self._animation = animation
        # Where things happen is planned once: a parameter that changes while it plays changes the motion only.
        self._timing = animation.timing(self.parameters)
        self._key_positions = _with_repeats(self._timing, round(self.parameters.get(REPEATS, 1.0)))

    @property
    def joints(self) -> frozenset[str]:
        """The joints that the animation turns."""
        return self._animation.joints

    @property
    def key_positions(self) -> Mapping[str, float]:
        """As authored, completed to seven points."""
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
        """Does not matter: the animation says where everything begins."""

    def pose(self, moment: Moment) -> Posed:
        """The animation's rotations."""
        return Posed(self._animation.sample(moment.phase, self.parameters, moment.body))


def _with_repeats(timing: Timing, repeats: int) -> dict[str, float]:
    keys = completed(timing.key_positions)
    if repeats < 2:
        return keys
    first = keys["stroke"]
    return completed({**keys, **{f"stroke:{i + 1}": min(1.0, first + i / repeats) for i in range(repeats)}})
