"""Stances and crossed arms, in frames."""

import math

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.testing.pilot import RealizerPilot

SIT = '<stance type="SITTING"/>'
STAND = '<stance type="STANDING"/>'
CROSSED = '<pose part="ARMS" lexeme="ARMS_CROSSED"/>'
FEET = ("l_ankle", "r_ankle")


def body(pilot: RealizerPilot, time: float) -> Body:
    """What was shown at a time, s."""
    return pilot.bodies()[round(time * 50)]


def apart(a: Body, b: Body, joint: str) -> float:
    """The angle between two bodies' rotations of a joint, degrees."""
    return math.degrees(angle(difference(a.rotation(joint), b.rotation(joint))))


def sits(shown: Body) -> bool:
    """Whether the thighs are level."""
    hip, knee = (shown.transform(joint).position for joint in ("l_hip", "l_knee"))
    return abs(hip[1] - knee[1]) < 0.06


def crossed(shown: Body) -> bool:
    """Whether the wrists are on the other sides."""
    return shown.transform("l_wrist").position[0] < 0.0 < shown.transform("r_wrist").position[0]
