"""Taking a posture, and giving it up again."""

import math
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from reactive_realizer.bml.posture import Pose
from reactive_realizer.bml.words import PosePart, StanceType
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import START_TO_END, Foreseen, Moment, MotionUnit, Posed, Resource
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.parts import JOINTS
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.engines.animation.ways import furthest

_BOW = {"vl5": (0.6, 0.0, 0.0), "vt10": (0.3, 0.0, 0.0)}
"""How far the trunk bows while the pelvis sinks or rises by half a meter, Euler angles, rad: else one would fall.

M. Schenkman et al., "Whole-body movements during rising to standing from sitting" (Physical Therapy 70, 1990): the
trunk is bent most when the seat is left.
"""

_SWING = {
    "l_shoulder": (-0.8, 0.0, 0.4),
    "r_shoulder": (-0.8, 0.0, -0.4),
    "l_elbow": (-1.0, 0.0, 0.0),
    "r_elbow": (-1.0, 0.0, 0.0),
}
"""How far arms that go along swing forward and aside meanwhile: else hands would go through the thighs that come up."""

_THERE_AND_BACK = MappingProxyType({"start": 0.0, "ready": 0.25, "relax": 0.75, "end": 1.0})
"""A quarter to come, half to stay, a quarter to go."""


class PostureMotionUnit(MotionUnit):
    """Goes to a posture from start to ready, stays until relax, and leaves it for what lies below at end.

    A posture is the base posture with the stance and the poses that are named in the place of its own. A shift has only
    start and end: it stays, and becomes the base posture.

    Attributes:
        change: the stance and the poses that are named.
    """

    kind = LayerKind.POSTURE
    resources = frozenset({Resource.STANCE})
    group = "posture"
    foreseen = Foreseen.ONCE_BEGUN

    def __init__(self, rest: Rest, stance: StanceType | None, poses: Iterable[Pose], *, shift: bool = False) -> None:
        """Plans a posture.

        Args:
            rest: the base posture, now and when it begins.
            stance: None for that of the base posture.
            poses: of parts of the body.
            shift: whether it becomes the base posture.

        Raises:
            RealizerError: "no-posture": there is no such pose.
        """
        self.parameters = {}
        self.lasts = "posture" if shift else None
        self._rest = rest
        self.change = (stance, tuple(poses))
        self.key_positions = START_TO_END if shift else _THERE_AND_BACK
        self._ready, self._relax = (self.key_positions.get(sync, 1.0) for sync in ("ready", "relax"))
        rest.check(BodyPosture(stance or rest.expected.stance, self.change[1]))
        self._set_out(rest.expected)
        # Who only moves the arms goes no further for being elsewhere.
        begins = (self._from,) if self._root is None else (self._from, *rest.elsewhere)
        self.entrance = max(map(self._way, begins))
        self.preferred_duration = self.entrance / self._ready

    def _set_out(self, base: BodyPosture) -> None:
        """Finds the posture to go to from a base posture."""
        self._base = base
        self._from = self._rest.in_posture(base)
        self.posture: BodyPosture = base.changed(*self.change)
        self.body: Body = self._rest.in_posture(self.posture)
        moved = {joint for joint, turn in self.body.pose.items() if turn != self._from.rotation(joint)}
        turned = (moved | self._named() | _BOW.keys()) & self.body.pose.keys()
        self.joints = frozenset(turned)
        self._goal = {joint: self.body.rotation(joint) for joint in turned}
        self._root = None if turned.isdisjoint(JOINTS[PosePart.LEGS]) else self.body.root
        self._sinking = abs(self.body.root[1] - self._from.root[1])

    def _named(self) -> frozenset[str]:
        """The joints of which the behavior says something: other postures that play on below do not shine through."""
        stance, poses = self.change
        parts = [PosePart.WHOLEBODY] if stance else [pose.part for pose in poses]
        return frozenset().union(*(JOINTS[part] for part in parts))

    def _way(self, begin: Body) -> float:
        """How long going there should take, s: less than a second for the arms alone, near two for sitting down."""
        hands, feet = (furthest(joint, SIDES, (begin, self.body)) for joint in ("wrist", "ankle"))
        pelvis = distance(begin.root, self.body.root)
        # Of feet the way counts less than that they have to be lifted and set down, one after the other.
        return max(0.5, 0.3 + 1.0 * hands, 0.4 + 1.7 * math.sqrt(feet), 0.5 + 2.2 * pelvis)

    def start(self, body: Body) -> None:
        """The base posture may be another one than was expected, and another posture may still play."""
        if self._rest.posture != self._base:
            self._set_out(self._rest.posture)
        if self._root is not None:
            self._sinking = abs(self._root[1] - body.root[1])

    def pose(self, moment: Moment) -> Posed:
        """The posture, as much of it as is shown at the phase."""
        phase = moment.phase
        come = minimum_jerk(share(phase, 0.0, self._ready))
        gone = minimum_jerk(share(phase, self._relax, 1.0)) if phase > self._relax else 0.0
        weight = come * (1.0 - gone)
        return Posed(self._bowed(weight), weight, self._root)

    def becomes_rest(self) -> bool:
        """A shift does."""
        self._rest.take(self.posture, self.body)
        return True

    def _bowed(self, weight: float) -> Mapping[str, Quat]:
        bow = 2.0 * self._sinking * 4.0 * weight * (1.0 - weight)
        if bow == 0.0:
            return self._goal
        turns = {joint: turn for joint, turn in (_BOW | _SWING).items() if joint in self._goal}
        bends = {joint: from_euler(*(bow * angle for angle in turn)) for joint, turn in turns.items()}
        return {**self._goal, **{joint: multiply(bend, self._goal[joint]) for joint, bend in bends.items()}}
