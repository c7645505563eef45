"""What walking figures do, read from their frames."""

import math

import numpy as np
import numpy.typing as npt

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import twist
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.testing.motion_laws import TOUCHING, point_of

FRAME = 0.02
Values = npt.NDArray[np.float64]


def place(body: Body) -> tuple[float, float]:
    """The point on the ground between the ankles, x and z."""
    (left, _, z), (right, _, other) = (body.transform(f"{side}_ankle").position for side in "lr")
    return 0.5 * (left + right), 0.5 * (z + other)


def heading(body: Body) -> float:
    """Where the pelvis faces, degrees to the left of +z."""
    w, _, y, _ = twist(body.rotation(ROOT), UP)
    return math.degrees(math.remainder(2.0 * math.atan2(y, w), 2.0 * math.pi))


def pelvis(bodies: list[Body]) -> Values:
    """The displacement of the pelvis in each frame, (frames, 3), m."""
    return np.array([body.root for body in bodies])


def speeds(bodies: list[Body]) -> Values:
    """The speed of the pelvis over the ground, (frames - 1), m/s."""
    ways: Values = np.linalg.norm(np.diff(pelvis(bodies)[:, [0, 2]], axis=0), axis=1) / FRAME
    return ways


def deepest(bodies: list[Body]) -> float:
    """How deep a heel or the ball of a foot has been in the ground, m."""
    standing = Body(bodies[0].skeleton)
    lows = {f"{side}_{part}": standing.transform(f"{side}_{part}").position[1] for side in "lr" for part in _PARTS}
    return max(low - body.transform(joint).position[1] for joint, low in lows.items() for body in bodies)


_PARTS = ("ankle", "midtarsal")


def flights(bodies: list[Body]) -> int:
    """The number of frames in which no part of a sole touches the ground."""
    standing = Body(bodies[0].skeleton)
    return sum(all(_lifted(body, standing, side) for side in "lr") for body in bodies)


def _lifted(body: Body, standing: Body, side: str) -> bool:
    heel = (0.0, -standing.transform(f"{side}_ankle").position[1], -0.045)
    parts = ((f"{side}_ankle", heel), (f"{side}_midtarsal", (0.0, 0.0, 0.0)))
    return all(point_of(body, *part)[1] > point_of(standing, *part)[1] + TOUCHING for part in parts)


def knees(bodies: list[Body]) -> Values:
    """The bend of both knees, (frames, 2), degrees."""
    bends = [[2.0 * math.acos(min(1.0, abs(body.rotation(f"{side}_knee")[0]))) for side in "lr"] for body in bodies]
    degrees: Values = np.degrees(np.array(bends))
    return degrees
