"""Bodies in postures for tests, and measurements on them."""

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.bml.behaviors import Pose
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import Quat, angle, difference, slerp
from reactive_realizer.engines.animation.motion_unit import Moment, MotionUnit
from reactive_realizer.engines.animation.posture.posture_library import BodyPosture, PostureLibrary

SOLES = ("l_ankle", "r_ankle", "l_midtarsal", "r_midtarsal")
_PARTS = {"ARMS": "ARMS", "LEGS": "LEGS", "LEANING": "WHOLEBODY"}


def part_of(lexeme: str) -> str:
    """The part of the body that a lexeme is for."""
    return _PARTS[lexeme.partition("_")[0]]


def apart(a: Body, b: Body, joint: str) -> float:
    """The angle between two bodies' rotations of a joint, rad."""
    return angle(difference(a.rotation(joint), b.rotation(joint)))


def height(body: Body, joint: str) -> float:
    """Above the ground, m."""
    return body.transform(joint).position[1]


def without(skeleton: Skeleton, *parts: str) -> Skeleton:
    """A skeleton without joints in whose names a part occurs."""
    kept = [joint for joint in skeleton.joints if not any(part in joint for part in parts)]
    parents = [skeleton.parent(joint) for joint in kept]
    indices = [-1 if parent is None else kept.index(parent) for parent in parents]
    return Skeleton(tuple(kept), tuple(indices), tuple(map(skeleton.offset, kept)))


ASSET = Assets()


def pose(part: str, lexeme: str) -> Pose:
    """The pose of a part of the body."""
    return Pose(part=PosePart(part), lexeme=lexeme)


def posture(stance: str = "STANDING", **poses: str) -> BodyPosture:
    """A posture of a stance and of lexemes by part."""
    return BodyPosture(StanceType(stance), tuple(pose(part, word) for part, word in poses.items()))


def body_in(skeleton: Skeleton, stance: str = "STANDING", **poses: str) -> Body:
    """A body in it."""
    return PostureLibrary(skeleton, ASSET).body(posture(stance, **poses))


REST_POSE = body_in(Avatar.read(ASSET("avatars/female.glb")).skeleton).pose
"""Joint -> rotation of a figure that stands at ease."""


def shown(unit: MotionUnit, phase: float, body: Body, below: Body | None = None) -> dict[str, Quat]:
    """The rotations of a motion at a phase over the layers below, by default those of the body itself."""
    below = below or body
    posed = unit.pose(Moment(phase, GlobalTime(phase * unit.preferred_duration), body))
    return {joint: slerp(below.rotation(joint), goal, posed.weight) for joint, goal in posed.rotations.items()}
