"""From the figure that was captured to one of ours: the same directions of bones, whatever each rests like."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import FINGERS, ROOT
from reactive_realizer.embodiment.pose import FARTHEST
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, between, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import UP, Vec3, distance, length, subtract, unit
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.captured_names import joints_of
from reactive_realizer.engines.animation.keyframe.clip import Clip, continuous
from reactive_realizer.engines.animation.keyframe.quaternions import Array, inverse, product, rotated
from reactive_realizer.engines.animation.keyframe.stance import stance_of
from reactive_realizer.errors import RealizerError, error

_NEEDED = (ROOT, "l_hip", "r_hip", "l_knee", "r_knee", "skullbase")
_CHILD = {"sternoclavicular": "shoulder", "shoulder": "elbow", "elbow": "wrist", "hip": "knee", "knee": "ankle"}


def retargeted(capture: Capture, skeleton: Skeleton) -> Clip:
    """The motion of a capture for a figure.

    A bone of ours is turned as the captured one is, after the turn from its direction in the default pose to that of
    the captured one as it stands: a T-pose serves as well as hanging arms. Joints that only one of the two has are left
    out. The way of the root is taken to scale, by the lengths of the thighs. The figure begins where it stands and as
    it faces, wherever and however the captured one began.

    Raises:
        RealizerError: "bad-capture": its joints are not known, it does not stand upright, or it goes too far.
    """
    source = _Source(capture, skeleton)
    rotations, joints = source.rotations(), tuple(source.joints)
    times = tuple((np.arange(len(rotations)) * capture.step).tolist())
    return Clip(capture.name, times, joints, continuous(rotations), source.roots())


class _Source:
    """A capture in the axes of the figure: y up, facing +z as it stands, and so in its first frame.

    Attributes:
        joints: H-Anim name -> index in the capture, in the order of the skeleton.
    """

    def __init__(self, capture: Capture, skeleton: Skeleton) -> None:
        self._capture = capture
        self._skeleton = skeleton
        index = joints_of(capture.joints, skeleton.joints)
        self.joints = {joint: index[joint] for joint in skeleton.joints if joint in index}
        missing = [joint for joint in _NEEDED if joint not in self.joints]
        if missing:
            raise self._bad(f"no joint is called in a way that is known for {', '.join(missing)}")
        self._rotations = capture.rotations()
        stance = stance_of(capture, self.joints, self._rotations)
        if stance is None:
            raise self._bad("the figure stands upright neither without rotations nor in its first frame")
        self._places = stance.places
        turn = np.array(stance.axes)
        turned = product(product(turn, product(self._rotations, inverse(stance.pose))), inverse(turn))
        ahead = np.array(_facing(turned[0, self.joints[ROOT]]))
        self._turned = product(ahead, turned)
        self._axes = product(ahead, turn)

    def rotations(self) -> Array:
        """(F, J, 4), local to the joints above in the skeleton."""
        own = {joint: product(self._turned[:, i], np.array(self._alignment(joint))) for joint, i in self.joints.items()}
        return np.stack([self._local(joint, own) for joint in self.joints], axis=1)

    def roots(self) -> Array:
        """How far the root has moved since the first frame, (F, 3), m."""
        places = self._capture.places(self.joints[ROOT], self._rotations)
        scale = length(self._skeleton.offset("l_knee")) / distance(self._places["l_knee"], self._places["l_hip"])
        turned = rotated(self._axes, scale * (places - places[0]))
        if not (np.linalg.norm(turned, axis=-1) <= FARTHEST).all():
            raise self._bad(f"it goes further than {FARTHEST:g} m, by the length of its thighs")
        return turned

    def _alignment(self, joint: str) -> Quat:
        """The turn from our bone in the default pose to the captured one: the smallest after its parent's."""
        above = self._skeleton.parent(joint)
        if above is None or joint.endswith("_ankle"):  # a foot is level in either
            return IDENTITY
        turn = self._alignment(above)
        child = next((child for child in _children(joint) if child in self.joints), None)
        if child is None or joint not in self.joints:
            return turn
        captured, ours = subtract(self._places[child], self._places[joint]), self._way(joint, child)
        if not length(captured) or not length(ours):
            return turn
        return multiply(between(unit(rotate(turn, ours)), unit(captured)), turn)

    def _way(self, joint: str, child: str) -> Vec3:
        """From a joint of ours to one below it, in the default pose."""
        body = Body(self._skeleton)
        return subtract(body.place(child).position, body.place(joint).position)

    def _local(self, joint: str, own: Mapping[str, Array]) -> Array:
        above = next((name for name in self._skeleton.chain(joint)[-2::-1] if name in own), None)
        return own[joint] if above is None else product(inverse(own[above]), own[joint])

    def _bad(self, reason: str) -> RealizerError:
        return error("bad-capture", file=self._capture.name, row=1, reason=reason)


def _children(joint: str) -> Iterator[str]:
    """The joints to which the bone of a joint may lead."""
    side, _, part = joint.partition("_")
    if part in _CHILD:
        yield f"{side}_{_CHILD[part]}"
    if part.rstrip("123") in FINGERS and part[-1] in "12":
        yield f"{side}_{part[:-1]}{int(part[-1]) + 1}"


def _facing(root: Array) -> Quat:
    """The turn about y that takes a figure, whose root is turned so, to face +z."""
    w, x, y, z = root.tolist()
    ahead_x, _, ahead_z = rotate((w, x, y, z), (0.0, 0.0, 1.0))
    return from_axis_angle(UP, -math.atan2(ahead_x, ahead_z))
