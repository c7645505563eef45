"""Retargets a capture to a figure: bones get the same directions, whatever the rest pose of the captured figure."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, cos, pi, radians

import numpy as np

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import FINGERS, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.pose import FARTHEST
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, between, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import UP, Vec3, distance, dot, length, subtract, unit
from reactive_realizer.engines.animation.faults import BadCapture
from reactive_realizer.engines.animation.keyframe.capture import Array, Capture, inverse, product, rotated
from reactive_realizer.engines.animation.keyframe.clip import Clip, KeyPoint, continuous
from reactive_realizer.engines.animation.keyframe.joint_mapping import map_joints
from reactive_realizer.errors import RealizerError

_UPRIGHT = cos(radians(30.0))
_UPS = (IDENTITY, from_axis_angle((1.0, 0.0, 0.0), -0.5 * pi))
"""Turns of files with y up and with z up."""

Positions = Mapping[str, Vec3]


@dataclass(frozen=True, slots=True, eq=False)
class ReferencePose:
    """A captured figure that stands upright; rotations are read relative to it.

    Attributes:
        positions: H-Anim name -> position, y up, with the figure facing +z; in the unit of the file.
        pose: rotations of the joints, (J, 4), in the axes of the file.
        axes: turn from those axes to y up with the figure facing +z.
    """

    positions: Positions
    pose: Array
    axes: Quat


def reference_pose(capture: Capture, joints: Mapping[str, int], rotations: Array) -> ReferencePose | None:
    """Return the reference pose of a capture; None if the figure stands upright in neither candidate.

    The first candidate is the figure without motion. In many BVH files (Maya, Rokoko, Bandai Namco) this is not a pose,
    because each joint has its own axes along its bone. The second is the first frame, in which trunk, hands and feet
    are assumed to be at rest.

    Args:
        capture: of the figure.
        joints: H-Anim name -> index in the capture; includes pelvis, hips, knees and head.
        rotations: of the capture.
    """
    for positions, pose in _poses(capture, joints, rotations):
        for up in _UPS:
            standing = _turned(up, positions)
            if _upright(standing):
                turn = _ahead(standing)
                return ReferencePose(_turned(turn, standing), pose, multiply(turn, up))
    return None


def _poses(capture: Capture, joints: Mapping[str, int], rotations: Array) -> Iterator[tuple[Positions, Array]]:
    rests = capture.rests()
    resting = {joint: capture.rest_position(index, rests) for joint, index in joints.items()}
    if _is_a_pose(resting):
        yield resting, rests
    first = {joint: capture.positions(index, rotations[:1])[0].tolist() for joint, index in joints.items()}
    yield {joint: (x, y, z) for joint, (x, y, z) in first.items()}, rotations[0]


def _upright(positions: Positions) -> bool:
    spine = subtract(positions["skullbase"], positions[ROOT])
    below = all(positions[f"{side}_knee"][1] < positions[f"{side}_hip"][1] for side in "lr")
    return below and dot(spine, UP) > _UPRIGHT * length(spine)


def _is_a_pose(positions: Positions) -> bool:
    """Return whether left joints are to the left of right ones, and the spine rises from the hips toward the head."""
    hips = [positions[f"{side}_hip"] for side in SIDES]
    across, up = subtract(*hips), subtract(positions["skullbase"], hips[0])
    pairs = [(positions.get(f"l_{joint}"), positions.get(f"r_{joint}")) for joint in _PAIRED]
    ways = [subtract(left, right) for left, right in pairs if left is not None and right is not None]
    spine = [subtract(positions[joint], hips[0]) for joint in TRUNK[1:] if joint in positions]
    return all(dot(way, across) > 0.0 for way in ways) and all(dot(way, up) > 0.0 for way in spine)


_PAIRED = ("shoulder", "elbow", "wrist", "knee", "ankle")


def _ahead(positions: Positions) -> Quat:
    """Return the turn about y after which the left hip is at +x of the right one."""
    x, _, z = subtract(positions["l_hip"], positions["r_hip"])
    return from_axis_angle(UP, atan2(z, x))


def _turned(turn: Quat, positions: Positions) -> Positions:
    return {joint: rotate(turn, place) for joint, place in positions.items()}


_NEEDED = (ROOT, "l_hip", "r_hip", "l_knee", "r_knee", "skullbase")
_TWISTED = ("shoulder", "elbow", "hip", "knee")
"""Joints of limbs whose bones have joints of their own for their twist in some figures, such as SmartBody's."""
_CHILD = {"sternoclavicular": "shoulder", "shoulder": "elbow", "elbow": "wrist", "hip": "knee", "knee": "ankle"}


def retargeted(capture: Capture, skeleton: Skeleton) -> Clip:
    """Return the motion of a capture for a figure.

    A bone of the figure is turned like the captured one, after the turn from its direction in the default pose to that
    of the captured bone in the reference pose; so a T-pose works as well as hanging arms. Joints that only one of the
    figures has are left out, but the twist of a limb between two joints belongs to the upper one. Displacements of the
    root are scaled by the lengths of the thighs. The figure starts where it stands and faces, wherever the captured
    figure started.

    Raises:
        RealizerError: "bad-capture": its joints are unknown, the figure does not stand upright, it moves too far, or
            the motion is about none of the figure's joints.
    """
    source = _CapturedFigure(capture, skeleton)
    played = source.played()
    rotations = continuous(source.rotations(played))
    points = {sync: KeyPoint(time) for sync, time in capture.points.items()}
    roots = source.roots() if ROOT in played else None
    return Clip(capture.name, capture.times, played, rotations, roots, points)


class _CapturedFigure:
    """A capture in the figure's axes: y up, facing +z in the reference pose and in the first frame.

    Attributes:
        joints: H-Anim name -> index in the capture, in the order of the skeleton.
    """

    def __init__(self, capture: Capture, skeleton: Skeleton) -> None:
        self._capture = capture
        self._skeleton = skeleton
        index = map_joints(capture.joints, skeleton.joints)
        self.joints = {joint: index[joint] for joint in skeleton.joints if joint in index}
        missing = [joint for joint in _NEEDED if joint not in self.joints]
        if missing:
            raise self._bad(f"no joint has a known name for {', '.join(missing)}")
        self._rotations = capture.rotations()
        stance = reference_pose(capture, self.joints, self._rotations)
        if stance is None:
            raise self._bad("the figure stands upright neither without rotations nor in its first frame")
        self._bearing = {joint: self._bearer(joint) for joint in self.joints}
        self._positions = stance.positions
        turn = np.array(stance.axes)
        turned = product(product(turn, product(self._rotations, inverse(stance.pose))), inverse(turn))
        ahead = np.array(_facing(turned[0, self.joints[ROOT]]))
        self._turned = product(ahead, turned)
        self._axes = product(ahead, turn)

    def rotations(self, played: tuple[str, ...]) -> Array:
        """Return the rotations of some joints, (F, J, 4), each local to the one above it among them."""
        turned = {joint: self._turned[:, self._bearing[joint]] for joint in played}
        own = {joint: product(turned[joint], np.array(self._alignment(joint))) for joint in played}
        return np.stack([self._local(joint, own) for joint in played], axis=1)

    def roots(self) -> Array:
        """Return the displacement of the root from the first frame, (F, 3), m."""
        positions = self._capture.positions(self.joints[ROOT], self._rotations)
        scale = length(self._skeleton.offset("l_knee")) / distance(self._positions["l_knee"], self._positions["l_hip"])
        turned = rotated(self._axes, scale * (positions - positions[0]))
        if not (np.linalg.norm(turned, axis=-1) <= FARTHEST).all():
            raise self._bad(f"the root moves further than {FARTHEST:g} m, scaled by the length of the thighs")
        return turned

    def played(self) -> tuple[str, ...]:
        """Return the joints that the motion is about.

        Raises:
            RealizerError: "bad-capture": there are none.
        """
        about = self._capture.played
        played = tuple(joint for joint in self.joints if about is None or about.intersection(self._turning(joint)))
        if not played:
            raise self._bad("it moves no joint that the figure has, such as one of a face")
        return played

    def _turning(self, joint: str) -> tuple[int, ...]:
        """Return the captured joints whose rotations are that of a joint, from the last one up."""
        index, turning = self._bearing[joint], []
        while index != self.joints[joint]:
            turning.append(index)
            index = self._capture.joints[index].parent
        return (*turning, index)

    def _bearer(self, joint: str) -> int:
        """Return the captured joint that turns with a bone: the last of those that twist it, if it has any."""
        index = self.joints[joint]
        child = next(iter(_children(joint)), None) if joint.partition("_")[2] in _TWISTED else None
        if child is None or child not in self.joints:
            return index
        above = last = self._capture.joints[self.joints[child]].parent
        while above >= 0 and above != index:
            above = self._capture.joints[above].parent
        return last if above == index else index

    def _alignment(self, joint: str) -> Quat:
        """Return the turn from a bone in the default pose to the captured one: the smallest after its parent's."""
        above = self._skeleton.parent(joint)
        if above is None or joint.endswith("_ankle"):  # a foot is level in either
            return IDENTITY
        turn = self._alignment(above)
        child = next((child for child in _children(joint) if child in self.joints), None)
        if child is None or joint not in self.joints:
            return turn
        captured, ours = subtract(self._positions[child], self._positions[joint]), self._way(joint, child)
        if not length(captured) or not length(ours):
            return turn
        return multiply(between(unit(rotate(turn, ours)), unit(captured)), turn)

    def _way(self, joint: str, child: str) -> Vec3:
        """Return the vector from a joint to a descendant in the default pose."""
        body = Body(self._skeleton)
        return subtract(body.transform(child).position, body.transform(joint).position)

    def _local(self, joint: str, own: Mapping[str, Array]) -> Array:
        above = next((name for name in self._skeleton.chain(joint)[-2::-1] if name in own), None)
        return own[joint] if above is None else product(inverse(own[above]), own[joint])

    def _bad(self, reason: str) -> RealizerError:
        return RealizerError(BadCapture(file=self._capture.name, row=1, reason=reason))


def _children(joint: str) -> Iterator[str]:
    """Yield the joints to which the bone of a joint may lead."""
    side, _, part = joint.partition("_")
    if part in _CHILD:
        yield f"{side}_{_CHILD[part]}"
    if part.rstrip("123") in FINGERS and part[-1] in "12":
        yield f"{side}_{part[:-1]}{int(part[-1]) + 1}"


def _facing(root: Array) -> Quat:
    """Return the turn about y after which a figure with this root rotation faces +z."""
    w, x, y, z = root.tolist()
    ahead_x, _, ahead_z = rotate((w, x, y, z), (0.0, 0.0, 1.0))
    return from_axis_angle(UP, -math.atan2(ahead_x, ahead_z))
