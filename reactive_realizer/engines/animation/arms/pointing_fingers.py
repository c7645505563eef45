"""A hand that points: the index stretched, the other fingers in the palm, the thumb over them."""

from collections.abc import Iterator

from reactive_realizer.embodiment.quaternion import Quat, between, from_euler
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import Vec3, unit

# How far each joint of a finger is bent, rad, the nearest to the palm first.
_CURLED = {"middle": (1.25, 1.55, 0.9), "ring": (1.3, 1.6, 0.9), "pinky": (1.35, 1.6, 0.9)}
# Of the thumb, rad: down along the hand, and inward over the fingers.
_THUMB = ((0.35, 0.6), (0.3, 0.5), (0.0, 0.6))


def pointing_fingers(skeleton: Skeleton, side: str, along: Vec3) -> dict[str, Quat]:
    """Rotations of the fingers that a skeleton has, local to their parents.

    Args:
        skeleton: with the three joints of the index finger, apart from each other.
        side: "l" or "r".
        along: where the index finger goes, a unit vector in the axes of the hand.
    """
    rotations = (*_index(skeleton, side, along), *_others(side))
    return {joint: rotation for joint, rotation in rotations if joint in skeleton}


def _index(skeleton: Skeleton, side: str, along: Vec3) -> Iterator[tuple[str, Quat]]:
    proximal, middle = (unit(skeleton.offset(f"{side}_index{i}")) for i in (2, 3))
    straight = between(middle, proximal)
    yield f"{side}_index1", between(proximal, along)
    yield f"{side}_index2", straight
    # The last bone has no joint at its end; at rest fingers are bent alike at both of their outer joints.
    yield f"{side}_index3", straight


def _others(side: str) -> Iterator[tuple[str, Quat]]:
    inward = -1.0 if side == "l" else 1.0
    for finger, bends in _CURLED.items():
        for i, bend in enumerate(bends, 1):
            yield f"{side}_{finger}{i}", from_euler(0.0, 0.0, inward * bend)
    for i, (down, across) in enumerate(_THUMB, 1):
        yield f"{side}_thumb{i}", from_euler(down, inward * across, 0.0)
