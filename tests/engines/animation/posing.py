"""What tests of postures measure on a body, and bodies that lack something."""

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.embodiment.skeleton import Skeleton

SOLES = ("l_ankle", "r_ankle", "l_midtarsal", "r_midtarsal")
_PARTS = {"ARMS": "ARMS", "LEGS": "LEGS", "LEANING": "WHOLEBODY"}


def part_of(lexeme: str) -> str:
    """The part of the body that a word is about."""
    return _PARTS[lexeme.partition("_")[0]]


def apart(a: Body, b: Body, joint: str) -> float:
    """The angle between two bodies' rotations of a joint, rad."""
    return angle(difference(a.rotation(joint), b.rotation(joint)))


def height(body: Body, joint: str) -> float:
    """Above the ground, m."""
    return body.place(joint).position[1]


def without(skeleton: Skeleton, *parts: str) -> Skeleton:
    """A skeleton without joints in whose names a part occurs."""
    kept = [joint for joint in skeleton.joints if not any(part in joint for part in parts)]
    parents = [skeleton.parent(joint) for joint in kept]
    indices = [-1 if parent is None else kept.index(parent) for parent in parents]
    return Skeleton(tuple(kept), tuple(indices), tuple(map(skeleton.offset, kept)))
