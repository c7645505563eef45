"""Skeletons and motions in SmartBody's formats, made for the tests."""

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
