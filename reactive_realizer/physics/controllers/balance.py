"""Balance: legs that keep the center of mass above the feet, and the pelvis at a height (thesis 3.2.4)."""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.quaternion import difference, rotate, rotation_vector
from reactive_realizer.embodiment.vector import Vec3, add, dot, scale, subtract
from reactive_realizer.physics.controllers.controller import PhysicalController

if TYPE_CHECKING:
    from reactive_realizer.physics.simulation import Simulation

PELVIS_HEIGHT, STIFFNESS, DAMPING, REACTION = "pelvisheight", "stiffnessmultiplier", "damping", "reaction"

_BALANCE = 5.0
"""Angular frequency of the spring that holds the center of mass above the feet, rad/s."""

_HEIGHT = 12.0
"""The same of the pelvis at its height, rad/s."""

_UPRIGHT = 12.0
"""The same of the orientation of the pelvis, rad/s."""

_POSE = 4.0
"""The same of the joints of the legs about the axes that do not bend the leg, at their pose in the animation, rad/s."""

_LOWERING = 0.3
"""Greatest speed at which the wanted height changes, m/s."""

_SHIFTING = 0.06
"""Greatest speed at which the wanted place of the center of mass changes, m/s."""

_ASIDE = 0.06
"""How far this place may be from the middle between the feet at the beginning, m."""

_GRAVITY = 9.81
_LOAD = (0.3, 2.0)
"""Limits of the vertical force on the ground in multiples of the weight."""

_FRICTION = 0.7
"""Limit of the horizontal force as a share of the vertical one; soles slip at somewhat more."""

_SOLE = (0.85, 0.97)
"""Share of the half width and length of a sole within which the center of pressure stays."""

_HIPS = (0.7, 0.985)
"""Limits of the height of the hips above the soles in multiples of the length of the legs: deeper down, a trunk that is
upright would fall backward; higher up, knees would lock."""

_BEYOND = 0.12
"""How far the center of pressure that the force needs may be beyond the soles, m: the trunk then turns instead."""

_FLAT = 0.5
"""Cosine of the greatest angle between a sole that presses and the ground."""

_UPRIGHTING = 80.0
"""Limit of the torque that turns the pelvis upright, Nm."""

_LEGS = tuple(tuple(f"{side}_{joint}" for joint in ("hip", "knee", "ankle")) for side in SIDES)


class BalanceController(PhysicalController):
    """Keeps the center of mass above the middle between the feet, and the pelvis upright at a height.

    A spring and a damper on the center of mass give the force F that the ground should exert on the figure. If it acts
    at the point from which it goes through the center of mass, it does not turn the figure; beside this point, it turns
    the pelvis upright. The feet share F so that this is their center of pressure, as far as their soles reach. Each leg
    presses its share on the ground by the torques -J^T F, with the Jacobian J of the sole in the joints of the leg
    (virtual model control: J. Pratt et al., "Virtual model control: an intuitive approach for bipedal locomotion",
    International Journal of Robotics Research 20, 2001). A foot that does not touch the ground does not press, and a
    figure that has fallen does not try to stand up.

    Its parameters are the height of the hips above the soles in multiples of the length of the legs, of which 0.7 to
    0.985 are in its power, a factor of the stiffness of all springs, their damping, 1 for critical, and a factor of the
    effect that kinematic limbs have (`Simulation.reaction`).

    Args:
        skeleton: of a figure with legs.
    """

    ranges: Mapping[str, tuple[float, float]] = MappingProxyType(
        {PELVIS_HEIGHT: (0.5, 3.0), STIFFNESS: (0.1, 10.0), DAMPING: (0.1, 5.0), REACTION: (0.0, 3.0)}
    )

    def __init__(self, skeleton: Skeleton) -> None:
        body = Body(skeleton)
        self.joints = self.needed()
        self._long = body.transform(_LEGS[0][0]).position[1]
        self._above = body.transform(ROOT).position[1] - self._long
        self._aside, self._height = (0.0, 0.0), 0.0
        self._acted: float | None = None
        self.parameters = {PELVIS_HEIGHT: 1.0, STIFFNESS: 1.0, DAMPING: 1.0, REACTION: 1.0}

    @staticmethod
    def needed() -> frozenset[str]:
        """Return the joints that it needs: the root, hips, knees and ankles."""
        return frozenset((ROOT, *_LEGS[0], *_LEGS[1]))

    def act(self, simulation: "Simulation", goal: Body, torques: list[float], damping: list[float]) -> None:
        """Add the torques of both legs."""
        simulation.reaction = self.parameters[REACTION]
        if simulation.fallen:
            return
        soles = [_sole(simulation, leg[-1]) for leg in _LEGS]
        self._move_goals(simulation, _middle(soles))
        if any(sole.touches for sole in soles):
            force, pressure = self._support(simulation, soles, self._uprighting(simulation, goal))
            for sole, part in zip(soles, _shared(soles, pressure), strict=True):
                simulation.press(sole.body, part.point, scale(force, part.share))
        held, ratio = _POSE * math.sqrt(self.parameters[STIFFNESS]), self.parameters[DAMPING]
        for sole, leg in zip(soles, _LEGS, strict=True):
            # The bend of a leg that stands follows from the height of the pelvis.
            frequencies = (0.0 if sole.touches else held, held, held)
            for joint in leg:
                simulation.hold(joint, goal, frequencies, ratio, torques, damping)

    def _move_goals(self, simulation: "Simulation", middle: Vec3) -> None:
        """Move the wanted place of the center of mass to the middle between the feet, and the wanted height to its own.

        They start from where the figure is when the controller begins to act, so that it does not jerk.
        """
        data, period = simulation.data, simulation.period
        if self._acted is None or data.time - self._acted > 1.5 * period:
            x, y, _ = subtract(simulation.center_of_mass()[0], middle)
            self._aside = (min(max(x, -_ASIDE), _ASIDE), min(max(y, -_ASIDE), _ASIDE))
            self._height = float(data.qpos[2]) - middle[2]
        self._acted = data.time
        x, y = self._aside
        left = 1.0 - min(1.0, _SHIFTING * period / max(math.hypot(x, y), 1e-9))
        self._aside = (left * x, left * y)
        wanted = self._above + self._long * min(max(self.parameters[PELVIS_HEIGHT], _HIPS[0]), _HIPS[1])
        most = _LOWERING * period
        self._height += min(max(wanted - self._height, -most), most)

    def _spring(self, frequency: float, way: float, velocity: float) -> float:
        """Return the acceleration by a spring and a damper, m/s^2 or rad/s^2."""
        omega = frequency * math.sqrt(self.parameters[STIFFNESS])
        return omega * omega * way - 2.0 * self.parameters[DAMPING] * omega * velocity

    def _support(self, simulation: "Simulation", soles: "list[_Sole]", torque: Vec3) -> tuple[Vec3, Vec3]:
        """Return the force that the ground should exert, N, and its center of pressure, m, in MuJoCo's world.

        Args:
            simulation: the state.
            soles: of both feet.
            torque: that the ground should exert about the center of mass, Nm.
        """
        mass, data = simulation.mass, simulation.data
        middle = _middle(soles)
        center, velocity = simulation.center_of_mass()
        lift = self._spring(_HEIGHT, middle[2] + self._height - float(data.qpos[2]), float(data.qvel[2]))
        up = mass * min(max(_GRAVITY + lift, _LOAD[0] * _GRAVITY), _LOAD[1] * _GRAVITY)
        x, y = (
            mass * self._spring(_BALANCE, middle[axis] + self._aside[axis] - center[axis], velocity[axis])
            for axis in (0, 1)
        )
        force = _carried(x, y, up)
        over = (center[2] - middle[2]) / up
        pressure = subtract(center, scale(force, over))
        left, right = _shared(soles, pressure)
        reached = add(scale(left.point, left.share), scale(right.point, right.share))
        beyond = subtract(pressure, reached)
        far = math.hypot(beyond[0], beyond[1])
        if far > _BEYOND:
            pressure = add(reached, scale(beyond, _BEYOND / far))
            force = _carried((center[0] - pressure[0]) / over, (center[1] - pressure[1]) / over, up)
        return force, add(pressure, (-torque[1] / up, torque[0] / up, 0.0))

    def _uprighting(self, simulation: "Simulation", goal: Body) -> Vec3:
        """Return the torque that turns the pelvis to its orientation in a body, Nm, in MuJoCo's world."""
        w, x, y, z = simulation.data.qpos[3:7].tolist()
        way = rotation_vector(difference((w, x, y, z), simulation.wanted(ROOT, goal)))
        moments, velocities = simulation.inertia[3:6], simulation.data.qvel[3:6].tolist()
        across, about, along = (
            moment * self._spring(_UPRIGHT, part, velocity)
            for moment, part, velocity in zip(moments, way, velocities, strict=True)
        )
        turned = rotate((w, x, y, z), (across, about, along))
        x, y, z = (min(max(part, -_UPRIGHTING), _UPRIGHTING) for part in turned)
        return (x, y, z)


def _carried(x: float, y: float, up: float) -> Vec3:
    """Return a force on the ground, N, with as much of its horizontal part as friction carries."""
    grip = min(1.0, _FRICTION * up / max(math.hypot(x, y), 1e-9))
    return (grip * x, grip * y, up)


class _Sole(NamedTuple):
    """A sole in MuJoCo's world.

    Attributes:
        body: index of the foot.
        center: m.
        across: unit vector to its side.
        along: unit vector to its front.
        reach: from the center to the farthest centers of pressure, across and along, m.
        touches: whether the foot touches the ground, more with its sole than with its side.
    """

    body: int
    center: Vec3
    across: Vec3
    along: Vec3
    reach: tuple[float, float]
    touches: bool

    def within(self, point: Vec3) -> Vec3:
        """Return the point of the sole that is nearest to a point."""
        off, (wide, long) = subtract(point, self.center), self.reach
        across = scale(self.across, min(max(dot(self.across, off), -wide), wide))
        return add(add(self.center, across), scale(self.along, min(max(dot(self.along, off), -long), long)))


def _sole(simulation: "Simulation", joint: str) -> _Sole:
    data, body = simulation.data, simulation.body_of(joint)
    geom = int(simulation.model.body_geomadr[body])
    wide, high, long = simulation.model.geom_size[geom].tolist()
    xx, yx, zx, xy, yy, zy, xz, yz, zz = data.geom_xmat[geom].tolist()
    x, y, z = data.geom_xpos[geom].tolist()
    center = (x - high * yx, y - high * yy, z - high * yz)
    touches = geom in simulation.touching and yz > _FLAT
    return _Sole(body, center, (xx, xy, xz), (zx, zy, zz), (_SOLE[0] * wide, _SOLE[1] * long), touches)


def _middle(soles: list[_Sole]) -> Vec3:
    """Return the middle between the soles, m."""
    left, right = soles
    return scale(add(left.center, right.center), 0.5)


class _Pressure(NamedTuple):
    """What a foot presses on the ground with: its share of the force, and its center of pressure, m."""

    share: float
    point: Vec3


def _shared(soles: list[_Sole], pressure: Vec3) -> list[_Pressure]:
    """Return how feet press so that together they have a center of pressure, as far as they reach.

    The centers of pressure of both are equally far from the centers of their soles.
    """
    shares = _shares(soles, pressure)
    off = pressure
    for share, sole in zip(shares, soles, strict=True):
        off = subtract(off, scale(sole.center, share))
    return [_Pressure(share, sole.within(add(sole.center, off))) for share, sole in zip(shares, soles, strict=True)]


def _shares(soles: list[_Sole], pressure: Vec3) -> tuple[float, float]:
    """Return the share of the force that each foot presses on the ground with."""
    left, right = soles
    if not (left.touches and right.touches):
        return float(left.touches), float(right.touches)
    across = subtract(right.center, left.center)
    share = dot(subtract(pressure, left.center), across) / max(dot(across, across), 1e-9)
    share = min(max(share, 0.0), 1.0)
    return 1.0 - share, share
