"""Captures for tests: several figures with the same motion, as text of BVH files."""

import math
from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType

import pytest

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import Vec3, subtract, unit
from reactive_realizer.engines.animation.keyframe.clip import Clip

Bones = tuple[tuple[str, str | None, Vec3], ...]

T_POSE: Bones = (
    ("Hips", None, (0.0, 98.0, 0.0)),
    ("Spine", "Hips", (0.0, 12.0, 0.0)),
    ("Spine1", "Spine", (0.0, 14.0, 0.0)),
    ("Neck", "Spine1", (0.0, 24.0, 0.0)),
    ("Head", "Neck", (0.0, 10.0, 1.0)),
    ("LeftShoulder", "Spine1", (4.0, 20.0, 0.0)),
    ("LeftArm", "LeftShoulder", (14.0, 0.0, 0.0)),
    ("LeftForeArm", "LeftArm", (29.0, 0.0, 0.0)),
    ("LeftHand", "LeftForeArm", (26.0, 0.0, 0.0)),
    ("RightShoulder", "Spine1", (-4.0, 20.0, 0.0)),
    ("RightArm", "RightShoulder", (-14.0, 0.0, 0.0)),
    ("RightForeArm", "RightArm", (-29.0, 0.0, 0.0)),
    ("RightHand", "RightForeArm", (-26.0, 0.0, 0.0)),
    ("LeftUpLeg", "Hips", (9.0, -4.0, 0.0)),
    ("LeftLeg", "LeftUpLeg", (0.0, -44.0, 0.0)),
    ("LeftFoot", "LeftLeg", (0.0, -42.0, -2.0)),
    ("RightUpLeg", "Hips", (-9.0, -4.0, 0.0)),
    ("RightLeg", "RightUpLeg", (0.0, -44.0, 0.0)),
    ("RightFoot", "RightLeg", (0.0, -42.0, -2.0)),
)
"""Name, parent, way from the parent in cm."""

BONES = {
    ("LeftArm", "LeftForeArm"): ("l_shoulder", "l_elbow"),
    ("LeftForeArm", "LeftHand"): ("l_elbow", "l_wrist"),
    ("RightArm", "RightForeArm"): ("r_shoulder", "r_elbow"),
    ("RightForeArm", "RightHand"): ("r_elbow", "r_wrist"),
    ("LeftUpLeg", "LeftLeg"): ("l_hip", "l_knee"),
    ("LeftLeg", "LeftFoot"): ("l_knee", "l_ankle"),
    ("RightUpLeg", "RightLeg"): ("r_hip", "r_knee"),
    ("RightLeg", "RightFoot"): ("r_knee", "r_ankle"),
}

Turns = dict[str, tuple[float, float, float]]
"""Degrees, about z, x and y by default."""

_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def bvh(
    *frames: Turns,
    bones: Bones = T_POSE,
    step: float = 0.01,
    names: Mapping[str, str] = MappingProxyType({}),
    places: Sequence[Vec3] = (),
    order: str = "ZXY",
    moved: Collection[str] = ("Hips",),
) -> str:
    """A file with a frame for each pose.

    Args:
        frames: the poses, in the order of the channels.
        bones: of the figure, each after the one above it.
        step: from frame to frame, s.
        names: other names for some of them.
        places: where the first of those that are moved is in each frame; else it stays where it is at rest.
        order: of the rotations.
        moved: the joints that have channels for their place.
    """
    offsets = {name: offset for name, _, offset in bones}
    walked: list[str] = []

    def joint(name: str) -> str:
        walked.append(name)
        axes = [f"{axis}rotation" for axis in order]
        channels = ["Xposition", "Yposition", "Zposition", *axes] if name in moved else axes
        inside = "".join(joint(child) for child, above, _ in bones if above == name)
        inside = inside or "End Site\n{\nOFFSET 0 0 1\n}\n"
        where = " ".join(map(str, offsets[name] if walked[0] != name else (0.0, 0.0, 0.0)))
        said = f"OFFSET {where}\nCHANNELS {len(channels)} {' '.join(channels)}"
        return f"JOINT {names.get(name, name)}\n{{\n{said}\n{inside}}}\n"

    def row(frame: Turns, place: Vec3 | None) -> str:
        finite_numbers: list[float] = []
        for name in walked:
            if name in moved:
                finite_numbers += offsets[name] if place is None else place
                place = None
            finite_numbers += frame.get(name, (0.0, 0.0, 0.0))
        return " ".join(f"{number:.6f}" for number in finite_numbers)

    figure = joint(bones[0][0]).removeprefix("JOINT")
    walk: Sequence[Vec3 | None] = places or [None] * len(frames)
    rows = [row(frame, place) for frame, place in zip(frames, walk, strict=True)]
    motion = f"Frames: {len(frames)}\nFrame Time: {step}\n" + "\n".join(rows)
    return f"HIERARCHY\nROOT{figure}MOTION\n{motion}\n"


def turn(angles: tuple[float, float, float], order: str = "ZXY") -> Quat:
    """The rotation of a joint."""
    turned = IDENTITY
    for axis, degrees in zip(order, angles, strict=True):
        turned = multiply(turned, from_axis_angle(_AXES[axis], math.radians(degrees)))
    return turned


def with_axes(bones: Bones, frames: Sequence[Turns], file: Quat, own: Mapping[str, Quat]) -> tuple[Bones, list[Turns]]:
    """The same figure doing the same, in a file with other axes.

    Args:
        bones: of the figure.
        frames: about z, x and y.
        file: the turn from our axes to those of the file.
        own: how joints whose axes are not those of the file are turned at rest, in these axes.
    """
    above = {name: parent for name, parent, _ in bones}

    def axes(name: str | None) -> Quat:
        return IDENTITY if name is None else own.get(name, IDENTITY)

    def cast(name: str, angles: tuple[float, float, float]) -> tuple[float, float, float]:
        turned = multiply(multiply(file, turn(angles)), conjugate(file))
        return _degrees(multiply(multiply(conjugate(axes(above[name])), turned), axes(name)))

    new = tuple((name, up, rotate(conjugate(axes(up)), rotate(file, offset))) for name, up, offset in bones)
    return new, [{name: cast(name, frame.get(name, (0.0, 0.0, 0.0))) for name in above} for frame in frames]


def _degrees(q: Quat) -> tuple[float, float, float]:
    """The angles about z, x and y that make a rotation."""
    (_, _, zx), (xy, yy, zy), (_, _, zz) = (rotate(q, axis) for axis in _AXES.values())
    x = math.asin(max(-1.0, min(1.0, zy)))
    return math.degrees(math.atan2(-xy, yy)), math.degrees(x), math.degrees(math.atan2(-zx, zz))


def captured_directions(frame: Turns, order: str = "ZXY") -> dict[tuple[str, str], Vec3]:
    """The directions of the bones of the captured figure, computed independently."""
    turned: dict[str, Quat] = {}
    for name, parent, _ in T_POSE:
        own = turn(frame.get(name, (0.0, 0.0, 0.0)), order)
        turned[name] = own if parent is None else multiply(turned[parent], own)
    ways = {name: offset for name, _, offset in T_POSE}
    return {(a, b): unit(rotate(turned[a], ways[b])) for a, b in BONES}


def directions(clip: Clip, time: float, skeleton: Skeleton) -> dict[tuple[str, str], Vec3]:
    body = Body(skeleton).posed(clip.rotations_at(time))
    pairs = {pair: (body.transform(a).position, body.transform(b).position) for pair, (a, b) in BONES.items()}
    return {pair: unit(subtract(b, a)) for pair, (a, b) in pairs.items()}


def assert_same_directions(clip: Clip, time: float, skeleton: Skeleton, frame: Turns, order: str = "ZXY") -> None:
    ours = directions(clip, time, skeleton)
    for bone, expected in captured_directions(frame, order).items():
        assert ours[bone] == pytest.approx(expected, abs=1e-5), bone
