"""Sequences: several motions as one, each shifted, stretched, faded in and out, and layered over those before it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, power, slerp
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.monotone_curve import MonotoneCurve
from reactive_realizer.engines.animation.motion_unit import FILE, Moment, MotionPose, MotionUnit, layer_of, ordered


@dataclass(frozen=True, slots=True, eq=False)
class SequencePart:
    """A motion shifted to a start, with its own course of time, and of its weight: SmartBody's TimeShiftWarp and Blend.

    (SmartBody, section 4.2.2.)

    Attributes:
        motion: with its own phase, 0 to 1.
        start: s of the sequence.
        end: s of the sequence, after the start.
        ease_in: duration in which its weight rises, from the start, s.
        ease_out: duration in which its weight falls, until the end, s.
        phases: phase of the motion by the time since the start, s; None if it is stretched evenly.
        weights: its weight by the time since the start, s; None for that of `ease_in` and `ease_out`.
    """

    motion: MotionUnit
    start: float
    end: float
    ease_in: float = 0.0
    ease_out: float = 0.0
    phases: MonotoneCurve | None = None
    weights: MonotoneCurve | None = None

    def plays(self, time: float) -> bool:
        """Return whether it plays at a time, s."""
        return self.start <= time <= self.end

    def time(self, sync: str) -> float:
        """Return the first time of one of its own sync points, s.

        Raises:
            KeyError: there is no such point.
            ValueError: the motion is never there.
        """
        phase = self.motion.key_positions[sync]
        return self.start + (phase * (self.end - self.start) if self.phases is None else self.phases.first_time(phase))

    def layer(self, time: float, moment: Moment) -> Layer:
        """Return its layer.

        Args:
            time: s of the sequence.
            moment: of the sequence.

        Raises:
            RealizerError: as `layer_of`.
        """
        phase = share(time, self.start, self.end) if self.phases is None else self.phases(time - self.start)
        return layer_of(self.motion, moment._replace(phase=phase))

    def weight(self, time: float) -> float:
        """Return its weight at a time, 0 to 1: SmartBody's blending curve."""
        if self.weights is not None:
            return self.weights(time - self.start)
        arrived = minimum_jerk(share(time, self.start, self.start + self.ease_in))
        left = minimum_jerk(share(time, self.end - self.ease_out, self.end)) if self.ease_out else 0.0
        return arrived * (1.0 - left)


class LayerStack:
    """Combines layers of one kind before the layers below them are known.

    If a layer of weight v lies over one of weight u, the layers below show by (1 - u)(1 - v). So together they weigh w
    = u + v - uv, and the upper one contributes v / w. Additive layers add up.
    """

    def __init__(self, kind: LayerKind) -> None:
        self._adds = kind is LayerKind.ADDITIVE
        self._rotations: dict[str, Quat] = {}
        self._weights: dict[str, float] = {}
        self._root: Vec3 | None = None

    def lay(self, layer: Layer, weight: float) -> None:
        """Add a layer on top, with a weight."""
        below = self._weights.get(ROOT, 0.0)
        for joint, turn in layer.rotations.items():
            self._turn(joint, turn, weight * layer.weight_of(joint))
        if layer.root is not None:
            self._move(layer.root, weight * layer.weight_of(ROOT), below)

    @property
    def posed(self) -> MotionPose:
        """The combined pose."""
        return MotionPose(self._rotations, root=self._root, weights=None if self._adds else self._weights)

    def _turn(self, joint: str, turn: Quat, weight: float) -> None:
        if self._adds:
            self._rotations[joint] = multiply(self._rotations.get(joint, IDENTITY), power(turn, weight))
            return
        below = self._weights.get(joint, 0.0)
        self._weights[joint] = together = _together(below, weight)
        self._rotations[joint] = slerp(self._rotations[joint], turn, weight / together) if below > 0.0 else turn

    def _move(self, root: Vec3, weight: float, below: float) -> None:
        if self._adds:
            self._root = add(self._root or ZERO, scale(root, weight))
            return
        self._weights[ROOT] = together = _together(below, weight)
        under = self._root if self._root is not None and below > 0.0 else root
        self._root = add(under, scale(subtract(root, under), weight / together if together > 0.0 else 0.0))


def _together(below: float, above: float) -> float:
    return below + above - below * above


class SequenceMotionUnit(MotionUnit):
    """Plays parts at their times, each over those before it, as SmartBody's Schedule does (4.2.2).

    A sequence may be a part of another one. It has the parameters for which all its parts that have them have equal
    values.
    """

    def __init__(self, parts: Sequence[SequencePart], key_positions: Mapping[str, float]) -> None:
        """Combine motions.

        Args:
            parts: of one layer kind; later parts lie over earlier ones.
            key_positions: sync id -> s of the sequence.
        """
        self._parts = tuple(parts)
        self._begun: set[SequencePart] = set()
        self.preferred_duration = max(part.end for part in parts)
        self.key_positions = ordered({sync: time / self.preferred_duration for sync, time in key_positions.items()})
        self.kind = parts[0].motion.kind
        self.joints = frozenset[str]().union(*(part.motion.joints for part in parts))
        self.lacking = frozenset[str]().union(*(part.motion.lacking for part in parts))
        self.resources = frozenset[str]().union(*(part.motion.resources for part in parts))
        self.parameters = _agreed(parts)
        # If values of parts differ, the value given when the sequence is made applies to all of them.
        self.fixed = frozenset({FILE}).union(*(part.motion.parameter_names for part in parts))
        self.ranges = {
            name: bounds for part in parts for name, bounds in part.motion.ranges.items() if name in self.parameters
        }

    def start(self, body: Body) -> None:
        """Start. Each part starts from the body at its own time."""
        self._begun.clear()

    def pose(self, moment: Moment) -> MotionPose:
        """Return the combined pose of the playing parts."""
        time, stack = moment.phase * self.preferred_duration, LayerStack(self.kind)
        for part in self._parts:
            if part.plays(time):
                self._begin(part, moment.body)
                stack.lay(part.layer(time, moment), part.weight(time))
                self.fault = self.fault or part.motion.fault
        return stack.posed

    def _begin(self, part: SequencePart, body: Body) -> None:
        if part not in self._begun:
            self._begun.add(part)
            part.motion.parameters = _SharedParameters(part.motion.parameters, self.parameters)
            part.motion.start(body)


class _SharedParameters(Mapping[str, float]):
    """The parameters of a part, with the values of the sequence for those that it shares."""

    def __init__(self, own: Mapping[str, float], shared: Mapping[str, float]) -> None:
        self._own = own
        self._shared = shared

    def __getitem__(self, name: str) -> float:
        own = self._own[name]
        return self._shared.get(name, own)

    def __iter__(self) -> Iterator[str]:
        return iter(self._own)

    def __len__(self) -> int:
        return len(self._own)


def _agreed(parts: Sequence[SequencePart]) -> dict[str, float]:
    """Return the parameters that have equal values in all parts that have them."""
    values: dict[str, set[float]] = {}
    for part in parts:
        for name, value in part.motion.parameters.items():
            values.setdefault(name, set()).add(value)
    return {name: found.pop() for name, found in values.items() if len(found) == 1}
