"""Directions as angles, and gazes, for tests."""

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import cast

from reactive_realizer.bml.vocabulary import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_euler, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, dot, scale
from reactive_realizer.engines.animation.gaze.eyes import EyeSockets, GazeTarget, direction_between
from reactive_realizer.engines.animation.gaze.head_turn import default_weights
from reactive_realizer.engines.animation.motions.gaze import LOOK, GazeKind, GazeMotionUnit
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture


def way(yaw: float, pitch: float) -> Vec3:
    """The unit vector to the figure's left by yaw and up by pitch, degrees."""
    return rotate(from_euler(-math.radians(pitch), math.radians(yaw), 0.0), FORWARD)


def target_at(body: Body, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A point in a direction from between a body's eyes, degrees and m."""
    return add(EyeSockets.of(body).middle, scale(way(yaw, pitch), far))


def between(a: Vec3, b: Vec3) -> float:
    """The angle between two unit vectors, degrees."""
    return math.degrees(math.acos(max(-1.0, min(1.0, dot(a, b)))))


def miss(body: Body, eye: str, target: Vec3) -> float:
    """Between where an eye looks and where a target is, degrees."""
    toward = direction_between(body.transform(eye).position, target)
    assert toward is not None
    return between(rotate(body.transform(eye).rotation, FORWARD), toward)


def gaze(
    body: Body,
    target: Vec3 | Callable[[], Vec3],
    influence: Influence = Influence.HEAD,
    course: GazeKind = LOOK,
    **weights: float,
) -> GazeMotionUnit:
    """A gaze of a figure whose rest is a body; a target that moves is a function."""
    aim = GazeTarget(target if callable(target) else lambda: target)
    rest = cast("RestPosture", SimpleNamespace(pose=body.pose, body=body))
    return GazeMotionUnit(aim, default_weights(influence) | weights, rest, course)
