"""A schedule of motions as one motion."""

from collections.abc import Mapping, Sequence

from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.motion_unit import FILE, Moment, MotionUnit, Posed, in_order
from reactive_realizer.engines.animation.sequence.part import Part
from reactive_realizer.engines.animation.sequence.stack import Stack


class SequenceMotionUnit(MotionUnit):
    """Plays parts at their times, each over those before it, as SmartBody's Schedule does (4.2.2).

    As it is a motion itself, it may be a part of another one. It has those parameters on whose values all its parts
    agree that have them.
    """

    def __init__(self, parts: Sequence[Part], key_positions: Mapping[str, float]) -> None:
        """Puts motions together.

        Args:
            parts: of one kind; the later lies over the earlier.
            key_positions: sync id -> s of the whole.
        """
        self._parts = tuple(parts)
        self._begun: set[Part] = set()
        self.preferred_duration = max(part.end for part in parts)
        self.key_positions = in_order({sync: time / self.preferred_duration for sync, time in key_positions.items()})
        self.kind = parts[0].motion.kind
        self.joints = frozenset[str]().union(*(part.motion.joints for part in parts))
        self.lacking = frozenset[str]().union(*(part.motion.lacking for part in parts))
        self.resources = frozenset[str]().union(*(part.motion.resources for part in parts))
        self.parameters = _agreed(parts)
        # Where parts have other values than others, what is said when it is made is the same for all of them.
        self.fixed = frozenset({FILE}).union(*(part.motion.known for part in parts))
        self.ranges = {
            name: bounds for part in parts for name, bounds in part.motion.ranges.items() if name in self.parameters
        }

    def start(self, body: Body) -> None:
        """Each part begins from where the body is when its time has come."""
        self._begun.clear()

    def pose(self, moment: Moment) -> Posed:
        """What the parts that play come to."""
        time, stack = moment.phase * self.preferred_duration, Stack(self.kind)
        for part in self._parts:
            if part.plays(time):
                self._begin(part, moment.body)
                stack.lay(part.layer(time, moment), part.weight(time))
                self.fault = self.fault or part.motion.fault
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
