"""Motion captures: a captured figure and its frames, and which of its joints are H-Anim joints.

Arrays of unit quaternions are (..., 4), w x y z.
"""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.joints import FINGERS, ROOT
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.embodiment.vector import Vec3

Array = NDArray[np.float64]


def product(a: Array, b: Array) -> Array:
    """Return the rotations b followed by a."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        (
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ),
        axis=-1,
    )


def rotated(turns: Array, vectors: Array) -> Array:
    """Return vectors, (..., 3), turned by rotations."""
    pure = np.concatenate([np.zeros((*vectors.shape[:-1], 1)), vectors], axis=-1)
    out: Array = product(product(turns, pure), inverse(turns))[..., 1:]
    return out


def inverse(q: Array) -> Array:
    """Return the inverse rotations."""
    back: Array = q * (1.0, -1.0, -1.0, -1.0)
    return back


def about(axis: int, angles: Array) -> Array:
    """Return turns about x (0), y (1) or z (2), rad."""
    out = np.zeros((*angles.shape, 4))
    out[..., 0] = np.cos(0.5 * angles)
    out[..., axis + 1] = np.sin(0.5 * angles)
    return out


@dataclass(frozen=True, slots=True)
class CapturedJoint:
    """A joint of the captured figure.

    Attributes:
        name: as in the file.
        parent: index of the parent joint, -1 for the root.
        offset: from the parent joint, in the unit of the file.
        channels: values of each frame, in order: X, Y or Z, then "position" or "rotation".
    """

    name: str
    parent: int
    offset: Vec3
    channels: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Capture:
    """A captured figure and its motion, in the axes and the unit of length of the file.

    Attributes:
        name: of the file.
        joints: each after its parent, (J,).
        step: time between frames, s.
        frames: (F, C), values of all channels of all joints, in order; angles in degrees.
    """

    name: str
    joints: tuple[CapturedJoint, ...]
    step: float
    frames: NDArray[np.float64]

    def rotations(self) -> NDArray[np.float64]:
        """Return the rotation of each joint in each frame, in the axes of the file, (F, J, 4).

        Channels are applied from left to right: "Zrotation Xrotation Yrotation" is Rz Rx Ry.
        """
        out = np.zeros((len(self.frames), len(self.joints), 4))
        out[..., 0] = 1.0
        first = 0
        for index, joint in enumerate(self.joints):
            if joint.parent >= 0:
                out[:, index] = out[:, joint.parent]
            for column, channel in enumerate(joint.channels, first):
                if channel.endswith("rotation"):
                    turn = about("XYZ".index(channel[0]), np.radians(self.frames[:, column]))
                    out[:, index] = product(out[:, index], turn)
            first += len(joint.channels)
        return out

    def positions(self, index: int, turned: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the positions of a joint in frames, (F, 3), in the axes and the unit of the file.

        Args:
            index: of the joint.
            turned: the `rotations` of all frames, or of the first ones.
        """
        out = np.zeros((len(turned), 3))
        while (above := self.joints[index].parent) >= 0:
            out += rotated(turned[:, above], self._offsets(index)[: len(turned)])
            index = above
        return out + self._offsets(index)[: len(turned)]

    def _offsets(self, index: int) -> NDArray[np.float64]:
        """Return the offset of a joint from its parent in each frame, (F, 3); channels override the constant one."""
        out = np.tile(self.joints[index].offset, (len(self.frames), 1))
        first = sum(len(joint.channels) for joint in self.joints[:index])
        for column, channel in enumerate(self.joints[index].channels, first):
            if channel.endswith("position"):
                out[:, "XYZ".index(channel[0])] = self.frames[:, column]
        return out

    def rest_position(self, index: int) -> Vec3:
        """Return the position of a joint at rest, relative to the root."""
        x = y = z = 0.0
        while self.joints[index].parent >= 0:
            dx, dy, dz = self.joints[index].offset
            x, y, z = x + dx, y + dy, z + dz
            index = self.joints[index].parent
        return (x, y, z)


_SIDES = {"l": "l", "left": "l", "r": "r", "right": "r"}
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")

_NAMED_AFTER_BONES = {
    # MotionBuilder uses Mixamo's names, and so do the CMU captures as converted by B. Hahne.
    **{bone[4:].lower(): joint[2:] for bone, joint in JOINTS.items() if bone.startswith("Left")},
    **dict.fromkeys(("collar", "clavicle"), "sternoclavicular"),
    **dict.fromkeys(("upperarm", "shldr", "humerus"), "shoulder"),
    **dict.fromkeys(("lowerarm", "radius"), "elbow"),
    **dict.fromkeys(("upperleg", "thigh", "femur"), "hip"),
    **dict.fromkeys(("lowerleg", "shin", "calf", "tibia"), "knee"),
    **dict.fromkeys(("toe", "toes", "toe0"), "midtarsal"),
    **{
        f"{number}{bone}": f"{finger}{joint}"
        for number, finger in enumerate(FINGERS, 1)
        for joint, bone in enumerate(("mcp", "prox", "dist"), 1)
    },
}
"""Names in Mixamo, Rokoko, Poser, 3ds Max, Unreal, Acclaim, and many other files; of fingers also in EMBR's poses."""

_NAMED_AFTER_JOINTS = {
    "collar": "sternoclavicular",
    **{name: name for name in ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")},
    **dict.fromkeys(("toe", "foot"), "midtarsal"),
}
"""Names in Biovision, Xsens, SMPL."""

_SPINE = {1: ("vl5",), 2: ("vl5", "vt6"), 3: ("vl5", "vt10", "vt6")}


def map_joints(joints: Sequence[CapturedJoint], known: Collection[str]) -> Mapping[str, int]:
    """Map H-Anim joints to joints of a captured figure: limbs by name, the trunk by its position in the tree.

    Names of limbs contain a side and a part, in one of several forms: "LeftUpLeg", "mixamorig:LeftUpLeg", "lThigh",
    "Bip01 L Thigh", "thigh_l", "LeftHip". The pelvis is the common ancestor of head and legs, the spine leads from
    there to the arms, and the neck from the arms to the head. A figure with H-Anim names is used as it is.

    Args:
        joints: of the capture.
        known: joints of the figure that will move.

    Returns:
        H-Anim name -> index in the capture.
    """
    own = {joint.name: index for index, joint in enumerate(joints) if joint.name in known}
    limbs = max((_limbs(joints, parts) for parts in (_NAMED_AFTER_BONES, _NAMED_AFTER_JOINTS)), key=len)
    found = {name: index for name, index in (limbs | _trunk(joints, limbs)).items() if name in known}
    return max(own, found, key=len)


def _limbs(joints: Sequence[CapturedJoint], parts: Mapping[str, str]) -> dict[str, int]:
    found: dict[str, int] = {}
    for index, joint in enumerate(joints):
        words = _words(joint.name)
        at = next((at for at, word in enumerate(words) if word in _SIDES), len(words))
        part = parts.get("".join(words[at + 1 :] or words[:at]))
        if part is not None and at < len(words):
            found.setdefault(f"{_SIDES[words[at]]}_{part}", index)
    return found


def _trunk(joints: Sequence[CapturedJoint], limbs: Mapping[str, int]) -> dict[str, int]:
    head = next((index for index, joint in enumerate(joints) if _words(joint.name)[-1:] == ["head"]), None)
    if head is None or "l_hip" not in limbs or "r_hip" not in limbs:
        return {}
    legs = {*_upwards(joints, limbs["l_hip"])}.intersection(_upwards(joints, limbs["r_hip"]))
    up = [index for index in _upwards(joints, head) if index not in legs][:0:-1]
    arm = {*_upwards(joints, limbs.get("l_shoulder", head))}
    spine, neck = [index for index in up if index in arm], [index for index in up if index not in arm]
    pelvis = next(index for index in _upwards(joints, head) if index in legs)
    return {ROOT: pelvis, "skullbase": head, **({"vc4": neck[0]} if neck else {}), **_vertebrae(spine)}


def _vertebrae(spine: Sequence[int]) -> dict[str, int]:
    """Return up to three joints of the spine: the lowest, one in the middle, and the highest."""
    chosen = [spine[0], spine[len(spine) // 2], spine[-1]] if len(spine) > 3 else spine
    return dict(zip(_SPINE.get(len(chosen), ()), chosen, strict=True))


def _words(name: str) -> list[str]:
    """Split a name into words, without the prefix before a colon; the side of lhumerus is a word of its own."""
    words = [word.lower() for word in _WORD.findall(name.rpartition(":")[2])]
    if len(words) == 1 and words[0][0] in "lr" and words[0][1:] in _NAMED_AFTER_BONES:
        return [words[0][0], words[0][1:]]
    return words


def _upwards(joints: Sequence[CapturedJoint], index: int) -> Iterator[int]:
    """Yield a joint and its ancestors."""
    while index >= 0:
        yield index
        index = joints[index].parent
