"""Taking a posture, and giving it up again."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from reactive_realizer.bml.posture import Pose
from reactive_realizer.bml.words import PosePart, StanceType
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import Moment, Posed, Resource
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.parts import JOINTS
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.planunit.parameter import Range

_BOW = {"vl5": 0.6, "vt10": 0.3}
"""How far the trunk bows, rad, while the pelvis sinks or rises by half a meter: else who sits down would fall.

M. Schenkman et al., "Whole-body movements during rising to standing from sitting" (Physical Therapy 70, 1990): the
trunk is bent most when the seat is left.
"""


class PostureMotionUnit:
    """Goes to a posture from start to ready, stays until relax, and leaves it for what lies below at end.

    A posture is the base posture with the stance and the poses that are named in the place of its own. A shift has only
    start and end: it stays, and becomes the base posture.
    """

    kind: LayerKind = LayerKind.POSTURE
    resources = frozenset({Resource.STANCE})
    group: str | None = "posture"
    limits: tuple[float, float] | None = None
    ranges: Mapping[str, Range] = MappingProxyType({})

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
        self.parameters: dict[str, float] = {}
        self.lasts: str | None = "posture" if shift else None
        self._rest = rest
        self._change = (stance, tuple(poses))
        self._ready, self._relax = (1.0, 1.0) if shift else (0.25, 0.75)
        self._set_out(rest.expected)
        self._coming = self._way()
        if shift:
            rest.expected = self.posture

    def _set_out(self, base: BodyPosture) -> None:
        """Finds the posture to go to from a base posture."""
        self._base = base
        self._from = self._rest.in_posture(base)
        self.posture: BodyPosture = base.changed(*self._change)
        self.body: Body = self._rest.in_posture(self.posture)
        moved = {joint for joint, turn in self.body.pose.items() if turn != self._from.rotation(joint)}
        turned = (moved | self._named() | _BOW.keys()) & self.body.pose.keys()
        self._goal = {joint: self.body.rotation(joint) for joint in turned}
        self._root = None if turned.isdisjoint(JOINTS[PosePart.LEGS]) else self.body.root
        self._sinking = abs(self.body.root[1] - self._from.root[1])

    def _named(self) -> frozenset[str]:
        """The joints of which the behavior says something: other postures that play on below do not shine through."""
        stance, poses = self._change
        parts = [PosePart.WHOLEBODY] if stance else [pose.part for pose in poses]
        return frozenset().union(*(JOINTS[part] for part in parts))

    def _way(self) -> float:
        """How long going there should take, s: less than a second for the arms alone, near two for sitting down."""
        hands, feet = (_furthest(joint, self._from, self.body) for joint in ("wrist", "ankle"))
        pelvis = distance(self._from.root, self.body.root)
        return max(0.5, 0.3 + 1.0 * hands, 0.6 + 1.5 * feet, 0.5 + 2.2 * pelvis)

    @property
    def joints(self) -> frozenset[str]:
        """Those that are otherwise than in the base posture, those that the behavior names, and the trunk."""
        return frozenset(self._goal)

    @property
    def key_positions(self) -> Mapping[str, float]:
        """A quarter to come, half to stay, a quarter to go; of a shift all is coming."""
        if self.lasts:
            return {"start": 0.0, "end": 1.0}
        return {"start": 0.0, "ready": self._ready, "relax": self._relax, "end": 1.0}

    @property
    def preferred_duration(self) -> float:
        """From start to end, s."""
        return self._coming / self._ready

    def start(self, body: Body) -> None:
        """The base posture may be another one than was expected."""
        if self._rest.posture != self._base:
            self._set_out(self._rest.posture)

    def pose(self, moment: Moment) -> Posed:
        """The posture, as much of it as is shown at the phase."""
        phase = moment.phase
        come = minimum_jerk(share(phase, 0.0, self._ready))
        gone = minimum_jerk(share(phase, self._relax, 1.0)) if phase > self._relax else 0.0
        weight = come * (1.0 - gone)
        return Posed(self._bowed(weight), weight, self._root)

    def _bowed(self, weight: float) -> Mapping[str, Quat]:
        bow = 2.0 * self._sinking * 4.0 * weight * (1.0 - weight)
        if bow == 0.0:
            return self._goal
        bends = {joint: from_euler(angle * bow, 0.0, 0.0) for joint, angle in _BOW.items() if joint in self._goal}
        return {**self._goal, **{joint: multiply(self._goal[joint], bend) for joint, bend in bends.items()}}


def _furthest(joint: str, before: Body, after: Body) -> float:
    """The longer of the ways of the left and the right joint, m."""
    names = (name for name in (f"l_{joint}", f"r_{joint}") if name in before.skeleton)
    return max((distance(before.place(name).position, after.place(name).position) for name in names), default=0.0)
