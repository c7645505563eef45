"""How a captured figure stands before its rotations are applied."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, cos, pi, radians

import numpy as np

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import UP, Vec3, dot, length, subtract
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.quaternions import Array

_UPRIGHT = cos(radians(30.0))
_UPS = (IDENTITY, from_axis_angle((1.0, 0.0, 0.0), -0.5 * pi))
"""Turns of files with y up and with z up."""

Places = Mapping[str, Vec3]


@dataclass(frozen=True, slots=True, eq=False)
class Stance:
    """A captured figure as it stands upright.

    Attributes:
        places: H-Anim name -> where the joint is, y up, the figure facing +z; in the unit of the file.
        pose: how the joints are turned then, (J, 4), in the axes of the file.
        axes: the turn from those axes to y up and the figure facing +z.
    """

    places: Places
    pose: Array
    axes: Quat


def stance_of(capture: Capture, joints: Mapping[str, int], rotations: Array) -> Stance | None:
    """The pose against which rotations are read; None where the figure stands upright in none.

    That is the figure without rotations. In many files this is no pose at all, as each joint has axes of its own along
    its bone (those of Maya, Rokoko, Bandai Namco); there it is the first frame, in which trunk, hands and feet are
    taken to be held as ours are at rest.

    Args:
        capture: what was captured.
        joints: H-Anim name -> index in the capture; pelvis, hips, knees and head among them.
        rotations: of the capture.
    """
    for places, pose in _poses(capture, joints, rotations):
        for up in _UPS:
            standing = {joint: rotate(up, place) for joint, place in places.items()}
            if _upright(standing):
                turn = _ahead(standing)
                return Stance(_turned(turn, standing), pose, multiply(turn, up))
    return None


def _poses(capture: Capture, joints: Mapping[str, int], rotations: Array) -> Iterator[tuple[Places, Array]]:
    unturned = np.zeros_like(rotations[0])
    unturned[:, 0] = 1.0
    yield {joint: capture.rest_place(index) for joint, index in joints.items()}, unturned
    first = {joint: capture.places(index, rotations[:1])[0].tolist() for joint, index in joints.items()}
    yield {joint: (x, y, z) for joint, (x, y, z) in first.items()}, rotations[0]


def _upright(places: Places) -> bool:
    spine = subtract(places["skullbase"], places[ROOT])
    below = all(places[f"{side}_knee"][1] < places[f"{side}_hip"][1] for side in "lr")
    return below and dot(spine, UP) > _UPRIGHT * length(spine)


def _ahead(places: Places) -> Quat:
    """The turn about y after which the left hip is at +x of the right one."""
    x, _, z = subtract(places["l_hip"], places["r_hip"])
    return from_axis_angle(UP, atan2(z, x))


def _turned(turn: Quat, places: Places) -> Places:
    return {joint: rotate(turn, place) for joint, place in places.items()}
