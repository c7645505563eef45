"""Skeletons and motions in SmartBody's formats, made for the tests."""

import math
import struct
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from reactive_realizer.embodiment.quaternion import (
    IDENTITY,
    Quat,
    angle,
    conjugate,
    multiply,
    rotate,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import Vec3

from .capturing import T_POSE, Turns, turn

NAMES: Mapping[str, str] = MappingProxyType(
    {
        "Hips": "JtRoot",
        "Spine": "JtSpineA",
        "Spine1": "JtSpineC",
        "Neck": "JtNeckA",
        "Head": "JtSkullA",
        **{
            f"{side}{bone}": f"Jt{joint}{end}"
            for side, end in (("Left", "Lf"), ("Right", "Rt"))
            for bone, joint in (
                ("Shoulder", "Clavicle"),
                ("Arm", "Shoulder"),
                ("ForeArm", "Elbow"),
                ("Hand", "Wrist"),
                ("UpLeg", "Hip"),
                ("Leg", "Knee"),
                ("Foot", "Ankle"),
            )
        },
    }
)
"""The joints of the figure of `capturing` in SmartBody's skeletons."""
STANDARD: Mapping[str, str] = MappingProxyType(
    {
        "Hips": "base",
        "Spine": "spine1",
        "Spine1": "spine3",
        "Neck": "spine4",
        "Head": "skullbase",
        **{
            f"{side}{bone}": f"{letter}_{joint}"
            for side, letter in (("Left", "l"), ("Right", "r"))
            for bone, joint in (
                ("Shoulder", "sternoclavicular"),
                ("Arm", "shoulder"),
                ("ForeArm", "elbow"),
                ("Hand", "wrist"),
                ("UpLeg", "hip"),
                ("Leg", "knee"),
                ("Foot", "ankle"),
            )
        },
    }
)
"""The same joints in SmartBody's standard skeleton."""

Axes = Mapping[str, Quat]
"""How the axes of joints are turned at rest, in those of the figure."""
_NONE: Axes = MappingProxyType({})
_ABOVE = {name: parent for name, parent, _ in T_POSE}


def sk(axes: Axes = _NONE, size: float = 1.0) -> str:
    """A skeleton.

    Args:
        axes: of its joints.
        size: lengths in the file for each centimeter.
    """

    def joint(name: str, offset: Vec3) -> str:
        above = _ABOVE[name]
        up = IDENTITY if above is None else axes.get(above, IDENTITY)
        x, y, z = (size * value for value in rotate(conjugate(up), offset))
        word = "root" if above is None else "joint"
        inside = "".join(joint(child, way) for child, parent, way in T_POSE if parent == name)
        before = multiply(conjugate(up), axes.get(name, IDENTITY))
        return (
            f"{word} {NAMES[name]}\n{{ offset {x:.6f} {y:.6f} {z:.6f}\n"
            f'prerot {_axis_angle(before)}\nvisgeo "geometry/{name}.obj"\nchannel XPos 0 lim -1 1\nchannel Quat\n'
            f"{inside}}}\n"
        )

    return f"# a figure\nset_name Figure\nskeleton\n{joint(T_POSE[0][0], T_POSE[0][2])}\nend\n"


def _axis_angle(q: Quat) -> str:
    x, y, z = rotation_vector(q)
    return f"axis {x:.9f} {y:.9f} {z:.9f} ang {57.29577951308232 * angle(q):.6f}"


def skm(
    *frames: Turns,
    axes: Axes = _NONE,
    names: Mapping[str, str] = NAMES,
    turned: Sequence[str] = tuple(NAMES),
    places: Sequence[Vec3] = (),
    step: float = 0.1,
    end: str = "",
) -> str:
    """A motion with a frame for each pose.

    Args:
        frames: the poses.
        axes: of the joints, as in the skeleton.
        names: of the joints.
        turned: those with channels for their rotation.
        places: what is added to the place of the hips in each frame.
        step: from frame to frame, s.
        end: what stands behind the frames.
    """
    moved = [(names["Hips"], kind) for kind in ("XPos", "YPos", "ZPos")] if places else []
    channels = [*moved, *((names[name], "Quat") for name in turned)]

    def row(number: int, frame: Turns) -> str:
        values = list(places[number]) if places else []
        for name in turned:
            own = axes.get(name, IDENTITY)
            values += rotation_vector(multiply(multiply(conjugate(own), turn(frame.get(name, (0.0, 0.0, 0.0)))), own))
        return f"kt {step * number:.6f} fr {' '.join(f'{value:.9f}' for value in values)}"

    listed = "\n".join(f"{name} {kind}" for name, kind in channels)
    rows = "\n".join(row(number, frame) for number, frame in enumerate(frames))
    head = f'# a motion\nSkMotion\n\nname "Some"\n\nchannels {len(channels)}\n{listed}'
    return f"{head}\n\nframes {len(frames)}\n{rows}\n{end}"


_KINDS = ("XPos", "YPos", "ZPos", "XRot", "YRot", "ZRot", "Quat", "Swing", "Twist")


def skmb(text: str, points: Sequence[float] = (), *, packed: bool = False) -> bytes:
    """The motion of a text (`skm`) in the binary format.

    Args:
        text: of the motion, with rotations as axis times angle.
        points: its seven sync points, s, below 0 if they are not set.
        packed: whether numbers of one kind are in one field.
    """
    _, _, body = text.partition("channels ")
    lines = body.split("frames")[0].split("\n")[1:]
    channels = [line.split() for line in lines if line.strip()]
    rows = [row.split() for row in body.split("frames")[1].splitlines() if row.startswith("kt")]
    values: list[float] = []
    for row in rows:
        written = iter(map(float, row[3:]))
        for _, kind in channels:
            if kind == "Quat":
                values += _quat(next(written), next(written), next(written))
            else:
                values.append(next(written) * (math.pi / 180.0 if kind.endswith("Rot") else 1.0))
    message = _bytes(1, b"Some") + _number(2, len(channels))
    message += b"".join(_bytes(3, name.encode()) + _number(4, _KINDS.index(kind)) for name, kind in channels)
    message += _number(5, len(rows))
    for field, floats in ((6, [float(row[1]) for row in rows]), (7, values), (8, points)):
        each = [struct.pack("<f", value) for value in floats]
        message += _bytes(field, b"".join(each)) if packed else b"".join(_key(field, 5) + one for one in each)
    return message + _bytes(9, _bytes(1, b"emotion") + _bytes(2, b"none"))


def _quat(x: float, y: float, z: float) -> list[float]:
    half = 0.5 * math.hypot(x, y, z)
    share = 0.5 * (math.sin(half) / half if half else 1.0)
    return [math.cos(half), share * x, share * y, share * z]


def _number(field: int, value: int) -> bytes:
    return _key(field, 0) + _varint(value)


def _bytes(field: int, content: bytes) -> bytes:
    return _key(field, 2) + _varint(len(content)) + content


def _key(field: int, kind: int) -> bytes:
    return _varint(field << 3 | kind)


def _varint(value: int) -> bytes:
    rest, low = value >> 7, value & 0x7F
    return bytes([low | 0x80]) + _varint(rest) if rest else bytes([low])
