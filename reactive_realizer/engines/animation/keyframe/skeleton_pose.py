"""Reads AsapRealizer's SkeletonPose files: one pose, such as that of a body at rest."""

from pathlib import Path

from reactive_realizer.binding.xml_file import bad, read_xml
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engines.animation.keyframe.pose_table import read_pose_table


def read_skeleton_pose(path: Path) -> dict[str, Quat]:
    """The rotations of joints, local to their parents.

    Where it may say that HumanoidRoot is does not count: that is a place of the figure for which the file was made.

    Raises:
        RealizerError: "bad-asset", with file, line and what is wrong; or the file is too big.
        OSError: the file cannot be read.
    """
    element = read_xml(path, "SkeletonPose")
    table = read_pose_table(element, timed=False)
    if len(table.rotations) != 1:
        raise bad(element, f"{len(table.rotations)} rows; a pose has one")
    return dict(zip(table.joints, map(_quat, table.rotations[0].tolist()), strict=True))


def _quat(values: list[float]) -> Quat:
    w, x, y, z = values
    return (w, x, y, z)
