"""Looking at a target for a while, and back."""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, slerp
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.gaze.turning import (
    aim_eyes,
    gaze_joints,
    offset_target,
    turn_toward,
)
from reactive_realizer.engines.animation.motion_unit import Moment, Posed, Resource
from reactive_realizer.planunit.parameter import Range

_KEY_POSITIONS = MappingProxyType({"start": 0.0, "ready": 0.25, "relax": 0.75, "end": 1.0})
_DURATION = 2.0
# The eyes are there in this part of the time that the head takes, and wait for it there.
_EYES_LEAD = 0.4


class GazeMotionUnit:
    """Turns head and trunk toward a target from start to ready, follows it until relax, and is back at end.

    The eyes are not among its joints: they look from the head as it is in the end, nods and breath included, so their
    layer is asked for last (`eye_layer`).
    """

    kind: LayerKind = LayerKind.GAZE
    resources = frozenset({Resource.HEAD})
    group: str | None = "gaze"
    lasts: str | None = None
    limits: tuple[float, float] | None = None
    ranges: Mapping[str, Range] = MappingProxyType({})

    def __init__(
        self,
        target: Callable[[], Vec3],
        influence: Influence,
        offset_angle: float = 0.0,
        offset_direction: str = "RIGHT",
    ) -> None:
        """Plans a gaze.

        Args:
            target: where the target is now, in the figure's frame, m; a static gaze always gives the same.
            influence: what takes part.
            offset_angle: between the target and what is looked at, degrees.
            offset_direction: toward which, as the figure sees it (BML 1.0).
        """
        self.parameters: dict[str, float] = {}
        self._target = target
        self._influence = influence
        self._offset = (math.radians(offset_angle), offset_direction)
        self._begin: dict[str, Quat] = dict.fromkeys(gaze_joints(influence), IDENTITY)

    @property
    def joints(self) -> frozenset[str]:
        """Of trunk, neck and head."""
        return frozenset(self._begin)

    @property
    def key_positions(self) -> Mapping[str, float]:
        """A quarter to turn, half to look, a quarter to turn back."""
        return _KEY_POSITIONS

    @property
    def preferred_duration(self) -> float:
        """From start to end, s."""
        return _DURATION

    def start(self, body: Body) -> None:
        """The head turns from where it is now, which may be another gaze."""
        self._begin = {joint: body.rotation(joint) for joint in self._begin}

    def pose(self, moment: Moment) -> Posed:
        """Rotations of trunk, neck and head; they leave for whatever lies below."""
        keys, phase, body = _KEY_POSITIONS, moment.phase, moment.body
        there = turn_toward(body, self._point(body), self._influence)
        if phase < keys["ready"]:
            done = minimum_jerk(share(phase, keys["start"], keys["ready"]))
            return Posed({joint: slerp(self._begin[joint], goal, done) for joint, goal in there.items()})
        return Posed(there, 1.0 - minimum_jerk(share(phase, keys["relax"], keys["end"])))

    def eye_layer(self, phase: float, composed: Body) -> Layer:
        """What the eyes do at a phase.

        Args:
            phase: 0 to 1.
            composed: the body with every other layer of this frame.
        """
        keys = _KEY_POSITIONS
        come = minimum_jerk(share(phase, keys["start"], _EYES_LEAD * keys["ready"]))
        leave = minimum_jerk(share(phase, keys["relax"], keys["end"]))
        return Layer(LayerKind.EYES, aim_eyes(composed, self._point(composed)), come * (1.0 - leave))

    def _point(self, body: Body) -> Vec3:
        angle, direction = self._offset
        target = self._target()
        return offset_target(body, target, angle, direction) if angle else target
