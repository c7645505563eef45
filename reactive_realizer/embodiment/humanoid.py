"""A character as it can be seen: its avatar, where it stands, and the pose it is in."""

from collections.abc import Callable, Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.frame import Frame, rotation_array
from reactive_realizer.embodiment.joints import EYES, ROOT
from reactive_realizer.embodiment.pose import Layer, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.speed_limit import SpeedLimit, slowed
from reactive_realizer.embodiment.vector import UP, ZERO, Vec3, add, scale, subtract

Eyes = Callable[[Body], Mapping[str, Quat]]
"""What the eyes and lids do, from the composed head: they come last."""


class Humanoid:
    """A figure in the world.

    Args:
        avatar: its body.
        position: of the place on the ground that it stands on, m.
        heading: how far it is turned to its left, rad; 0 faces +z.
    """

    def __init__(self, avatar: Avatar, position: Vec3 = ZERO, heading: float = 0.0) -> None:
        self.avatar = avatar
        self._position = position
        self._turn = from_axis_angle(UP, heading)
        self._morphs = {morph: i for i, morph in enumerate(avatar.morphs)}
        self._limit: SpeedLimit | None = None
        self._shown = Body(avatar.skeleton)
        self._shown_at = GlobalTime(0.0)
        self.body = Body(avatar.skeleton)
        """The figure without additive motion, in its own frame: where a motion that begins finds it."""

    def compose(self, time: GlobalTime, layers: Iterable[Layer], face: Mapping[str, float], eyes: Eyes | None) -> Frame:
        """The frame of a time; later ones follow from it without a jump."""
        composed = compose(self.avatar.skeleton, layers)
        self._shown = self._within_limits(composed.shown, eyes, time - self._shown_at)
        self._shown_at = time
        self.body = composed.steady
        return Frame(time, self._root(self._shown.root), self._rotations(self._shown.pose), self._weights(face))

    @property
    def shown(self) -> Body:
        """The figure as it was shown last, additive motion included, in its own frame; at first in its default pose."""
        return self._shown

    def to_own_frame(self, point: Vec3) -> Vec3:
        """A point of the world as seen from the figure, m."""
        return rotate(conjugate(self._turn), subtract(point, self._position))

    def locate(self, joint: str | None) -> Vec3 | None:
        """Where a joint is in the world, m; None: between its eyes. An unknown joint is nowhere."""
        name = joint or "skullbase"
        if name not in self.avatar.skeleton.joints:
            return None
        point = self._shown.place(name).position if joint else between_eyes(self._shown)
        return add(self._position, rotate(self._turn, point))

    def _within_limits(self, wanted: Body, eyes: Eyes | None, duration: float) -> Body:
        """What is shown: the eyes look from where the head really comes to be."""
        if self._limit is None:
            self._limit = SpeedLimit(wanted)
            return wanted if eyes is None else wanted.posed(eyes(wanted))
        body = self._limit(wanted, duration)
        looking = {eye: body.rotation(eye) for eye in EYES if eye in body.skeleton}
        return body.posed(slowed(self._shown.pose, looking if eyes is None else {**looking, **eyes(body)}, duration))

    def _root(self, moved: Vec3) -> NDArray[np.float64]:
        place = add(self.avatar.skeleton.offset(ROOT), moved)
        return np.array(add(self._position, rotate(self._turn, place)))

    def _rotations(self, pose: Mapping[str, Quat]) -> NDArray[np.float64]:
        root = multiply(self._turn, pose.get(ROOT, IDENTITY))
        return rotation_array(self.avatar.skeleton, {**pose, ROOT: root})

    def _weights(self, face: Mapping[str, float]) -> NDArray[np.float64]:
        weights = np.zeros(len(self._morphs))
        for morph in face.keys() & self._morphs.keys():
            weights[self._morphs[morph]] = min(1.0, max(0.0, face[morph]))
        return weights


def between_eyes(body: Body) -> Vec3:
    """The point between the eyes of a body, in its frame, m; the top of the neck of one that has not both."""
    if not all(eye in body.skeleton for eye in EYES):
        return body.place("skullbase").position
    left, right = (body.place(eye).position for eye in EYES)
    return scale(add(left, right), 0.5)
