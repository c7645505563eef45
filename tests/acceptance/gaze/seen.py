"""Gaze as frames show it."""

import math
from bisect import bisect_left
from itertools import pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import from_euler, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3, add, dot, scale, subtract, unit
from reactive_realizer.engines.animation.gaze.eye_controller import saccade_progress
from reactive_realizer.testing.pilot import RealizerPilot

EYES = ("l_eyeball_joint", "r_eyeball_joint")
PLATEAU = 8.7
FRAME = 0.02
FAR = 1000.0
GLANCE = 5.1
"""Degrees by which idle eyes may deviate from straight ahead."""


def between(a: Vec3, b: Vec3) -> float:
    """The angle between two unit vectors, degrees."""
    return math.degrees(math.acos(max(-1.0, min(1.0, dot(a, b)))))


def sight(body: Body, joint: str = EYES[0]) -> Vec3:
    """Where an eye looks or the nose points."""
    return rotate(body.transform(joint).rotation, FORWARD)


def miss(body: Body, target: Vec3) -> float:
    """The larger of the angles between the eyes and a target, degrees."""
    return max(between(sight(body, eye), unit(subtract(target, body.transform(eye).position))) for eye in EYES)


def place(pilot: RealizerPilot, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A point to the left and up as Alice sees it before she looks anywhere."""
    body = pilot.bodies()[0]
    middle = scale(add(*(body.transform(eye).position for eye in EYES)), 0.5)
    return add(middle, scale(rotate(from_euler(-math.radians(pitch), math.radians(yaw), 0.0), FORWARD), far))


def put(pilot: RealizerPilot, name: str, yaw: float, pitch: float, far: float = 2.0) -> Vec3:
    """A target in a direction."""
    there = place(pilot, yaw, pitch, far)
    pilot.move(name, there)
    return there


def at(pilot: RealizerPilot, time: float) -> int:
    """The frame shown at a time."""
    return round(time / FRAME)


def speeds(shown: list[Body], joint: str = EYES[0]) -> list[float]:
    """The angular speed of a direction in space from frame to frame, rad/s."""
    return [math.radians(between(sight(a, joint), sight(b, joint))) / FRAME for a, b in pairwise(shown)]


def leaving(pilot: RealizerPilot, arrived: float) -> float:
    """When the eyes set out to where they are at a time, s, by the frames between and the law of saccades."""
    shown = pilot.bodies()[: at(pilot, arrived) + 1]
    left = [math.radians(between(sight(body), sight(shown[-1]))) for body in shown]
    last = max(number for number, angle in enumerate(left) if angle > 0.2 * max(left[-20:]))
    rest = last
    while left[rest - 1] - left[rest] > 1e-3:
        rest -= 1
    gone = 1.0 - left[last] / left[rest]
    age = bisect_left(range(100_000), gone, key=lambda step: saccade_progress(left[rest], 1e-6 * step))
    return last * FRAME - 1e-6 * age
