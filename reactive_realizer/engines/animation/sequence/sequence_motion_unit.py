"""A schedule of motions as one motion."""

from collections.abc import Mapping, Sequence

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.motion_unit import Moment, Posed, completed
from reactive_realizer.engines.animation.sequence.part import Part
from reactive_realizer.engines.animation.sequence.stack import Stack
from reactive_realizer.planunit.parameter import Range


class SequenceMotionUnit:
    """Plays parts at their times, each over those before it, as SmartBody's Schedule does (4.2.2).

    As it is a motion itself, it may be a part of another one. It has those parameters on whose values all its parts
    agree that have them.
    """

    group: str | None = None
    lasts: str | None = None
    limits: tuple[float, float] | None = None

    def __init__(self, parts: Sequence[Part], key_positions: Mapping[str, float]) -> None:
        """Puts motions together.

        Args:
            parts: of one kind; the later lies over the earlier.
            key_positions: sync id -> s of the whole.
        """
        self._parts = tuple(parts)
        self._begun: set[Part] = set()
        self._duration = max(part.end for part in parts)
        self._key_positions = completed({sync: time / self._duration for sync, time in key_positions.items()})
        self.kind: LayerKind = parts[0].motion.kind
        self.resources: frozenset[str] = frozenset[str]().union(*(part.motion.resources for part in parts))
        self.parameters: dict[str, float] = _agreed(parts)
        self.ranges: Mapping[str, Range] = {
            name: bounds for part in parts for name, bounds in part.motion.ranges.items() if name in self.parameters
        }

    @property
    def joints(self) -> frozenset[str]:
        """Those of all parts."""
        return frozenset[str]().union(*(part.motion.joints for part in self._parts))

    @property
    def key_positions(self) -> Mapping[str, float]:
        """As authored, completed to seven points."""
        return self._key_positions

    @property
    def preferred_duration(self) -> float:
        """Until the last part has ended, s."""
        return self._duration

    def start(self, body: Body) -> None:
        """Each part begins from where the body is when its time has come."""
        self._begun.clear()

    def pose(self, moment: Moment) -> Posed:
        """What the parts that play come to."""
        time, stack = moment.phase * self._duration, Stack(self.kind)
        for part in self._parts:
            if part.plays(time):
                self._begin(part, moment.body)
                stack.lay(part.layer(time, moment), part.weight(time))
        return stack.posed

    def _begin(self, part: Part, body: Body) -> None:
        if part not in self._begun:
            self._begun.add(part)
            part.motion.start(body)
        own = part.motion.parameters
        own.update({name: value for name, value in self.parameters.items() if name in own})


def _agreed(parts: Sequence[Part]) -> dict[str, float]:
    """The parameters of which all parts that have them have the same values."""
    values: dict[str, set[float]] = {}
    for part in parts:
        for name, value in part.motion.parameters.items():
            values.setdefault(name, set()).add(value)
    return {name: found.pop() for name, found in values.items() if len(found) == 1}
