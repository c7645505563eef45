"""Balance: legs that keep the center of mass above the feet, and the pelvis at a height (thesis 3.2.4)."""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.physics.controllers.controller import Controller
from reactive_realizer.physics.rotations import Array, turns

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

_SOLE = np.array((0.85, 0.0, 0.97))
"""Share of the half width and length of a sole within which the center of pressure stays."""

_HIPS = (0.7, 0.985)
"""Limits of the height of the hips above the soles in multiples of the length of the legs: deeper down, a trunk that is
upright would fall backward; higher up, knees would lock."""

_BEYOND = 0.12
"""How far the center of pressure that the force needs may be beyond the soles, m: the trunk then turns instead."""

_UPRIGHTING = 80.0
"""Limit of the torque that turns the pelvis upright, Nm."""

_LEGS = tuple(tuple(f"{side}_{joint}" for joint in ("hip", "knee", "ankle")) for side in SIDES)


class BalanceController(Controller):
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
        self._held = (*_LEGS[0], *_LEGS[1])
        self._long = body.transform(_LEGS[0][0]).position[1]
        self._above = body.transform(ROOT).position[1] - self._long
        self._aside, self._height = np.zeros(2), 0.0
        self._acted: float | None = None
        self.parameters = {PELVIS_HEIGHT: 1.0, STIFFNESS: 1.0, DAMPING: 1.0, REACTION: 1.0}

    @staticmethod
    def needed() -> frozenset[str]:
        """Return the joints that it needs: the root, hips, knees and ankles."""
        return frozenset((ROOT, *_LEGS[0], *_LEGS[1]))

    def act(self, simulation: "Simulation", goal: Body, torques: Array, damping: Array) -> None:
        """Add the torques of both legs."""
        simulation.reaction = self.parameters[REACTION]
        if simulation.fallen:
            return
        stiffness, ratio = self.parameters[STIFFNESS], self.parameters[DAMPING]
        soles = [_sole(simulation, leg[-1]) for leg in _LEGS]
        self._move_goals(simulation, _middle(soles))
        if any(sole.touches for sole in soles):
            force, pressure = self._support(simulation, soles, self._uprighting(simulation, goal))
            for sole, leg, part in zip(soles, _LEGS, _shared(soles, pressure), strict=True):
                self._press(simulation, sole, leg, part.share * force, part.point, torques)
        # The bend of a leg that stands follows from the height of the pelvis.
        held = _POSE * math.sqrt(stiffness) * np.array([[not sole.touches, 1.0, 1.0] * 3 for sole in soles]).ravel()
        simulation.hold(self._held, goal, held, ratio, torques, damping)

    def _move_goals(self, simulation: "Simulation", middle: Array) -> None:
        """Move the wanted place of the center of mass to the middle between the feet, and the wanted height to its own.

        They start from where the figure is when the controller begins to act, so that it does not jerk.
        """
        data, period = simulation.data, simulation.period
        if self._acted is None or data.time - self._acted > 1.5 * period:
            self._aside = (simulation.center_of_mass()[0] - middle)[:2].clip(-_ASIDE, _ASIDE)
            self._height = float(data.qpos[2] - middle[2])
        self._acted = data.time
        far = math.hypot(*self._aside)
        self._aside *= 1.0 - min(1.0, _SHIFTING * period / max(far, 1e-9))
        wanted = self._above + self._long * min(max(self.parameters[PELVIS_HEIGHT], _HIPS[0]), _HIPS[1])
        most = _LOWERING * period
        self._height += min(max(wanted - self._height, -most), most)

    def _spring(self, frequency: float, way: Array, velocity: Array) -> Array:
        """Return the acceleration by a spring and a damper, m/s^2 or rad/s^2."""
        omega = frequency * math.sqrt(self.parameters[STIFFNESS])
        return omega**2 * way - 2.0 * self.parameters[DAMPING] * omega * velocity

    def _support(self, simulation: "Simulation", soles: "list[_Sole]", torque: Array) -> tuple[Array, Array]:
        """Return the force that the ground should exert, N, and its center of pressure, m, in MuJoCo's world.

        Args:
            simulation: the state.
            soles: of both feet.
            torque: that the ground should exert about the center of mass, Nm.
        """
        data, mass = simulation.data, simulation.mass
        middle = _middle(soles)
        center, velocity = simulation.center_of_mass()
        aside = np.array((*self._aside, 0.0))
        force = mass * self._spring(_BALANCE, middle + aside - center, velocity)
        lift = self._spring(_HEIGHT, middle[2] + self._height - data.qpos[2], data.qvel[2])
        force[2] = mass * min(max(_GRAVITY + float(lift), _LOAD[0] * _GRAVITY), _LOAD[1] * _GRAVITY)
        sideways = math.hypot(force[0], force[1])
        force[:2] *= min(1.0, _FRICTION * force[2] / max(sideways, 1e-9))
        over = (center[2] - middle[2]) / force[2]
        pressure = center - force * over
        reached: Array = sum((part.share * part.point for part in _shared(soles, pressure)), np.zeros(3))
        beyond = pressure - reached
        far = math.hypot(beyond[0], beyond[1])
        if far > _BEYOND:
            pressure = reached + beyond * (_BEYOND / far)
            force[:2] = (center - pressure)[:2] / over
        pressure[:2] += np.array((-torque[1], torque[0])) / force[2]
        return force, pressure

    def _press(
        self,
        simulation: "Simulation",
        sole: "_Sole",
        leg: tuple[str, ...],
        force: Array,
        point: Array,
        torques: Array,
    ) -> None:
        jacobian = simulation.jacobian(sole.body, point)
        for joint in leg:
            degrees = simulation.degrees(joint)
            torques[degrees] -= jacobian[:, degrees].T @ force

    def _uprighting(self, simulation: "Simulation", goal: Body) -> Array:
        """Return the torque that turns the pelvis to its orientation in a body, Nm, in MuJoCo's world."""
        data, degrees = simulation.data, simulation.degrees(ROOT)
        (way,) = turns(data.qpos[np.newaxis, 3:7], np.array([simulation.wanted(ROOT, goal)]))
        torque = simulation.inertia[degrees][3:] * self._spring(_UPRIGHT, way, data.qvel[3:6])
        turned: Array = data.xmat[simulation.body_of(ROOT)].reshape(3, 3) @ torque
        return turned.clip(-_UPRIGHTING, _UPRIGHTING)


class _Sole(NamedTuple):
    """A sole in MuJoCo's world.

    Attributes:
        body: index of the foot.
        center: m.
        frame: from the axes of the foot to those of the world, (3, 3).
        reach: from the center to the farthest centers of pressure, in the axes of the foot, m, (3,).
        touches: whether the foot touches the ground.
    """

    body: int
    center: Array
    frame: Array
    reach: Array
    touches: bool

    def within(self, point: Array) -> Array:
        """Return the point of the sole that is nearest to a point."""
        own: Array = self.frame.T @ (point - self.center)
        nearest: Array = self.center + self.frame @ own.clip(-self.reach, self.reach)
        return nearest


def _sole(simulation: "Simulation", joint: str) -> _Sole:
    model, data, body = simulation.model, simulation.data, simulation.body_of(joint)
    geom = model.body_geomadr[body]
    size, frame = model.geom_size[geom], data.geom_xmat[geom].reshape(3, 3)
    touches = geom in data.contact.geom
    return _Sole(body, data.geom_xpos[geom] - size[1] * frame[:, 1], frame, _SOLE * size, touches)


def _middle(soles: list[_Sole]) -> Array:
    """Return the middle between the soles, m."""
    middle: Array = (soles[0].center + soles[1].center) / 2.0
    return middle


class _Pressure(NamedTuple):
    """What a foot presses on the ground with: its share of the force, and its center of pressure, m."""

    share: float
    point: Array


def _shared(soles: list[_Sole], pressure: Array) -> list[_Pressure]:
    """Return how feet press so that together they have a center of pressure, as far as they reach.

    The centers of pressure of both are equally far from the centers of their soles.
    """
    shares = _shares(soles, pressure)
    off: Array = pressure - shares[0] * soles[0].center - shares[1] * soles[1].center
    return [_Pressure(share, sole.within(sole.center + off)) for share, sole in zip(shares, soles, strict=True)]


def _shares(soles: list[_Sole], pressure: Array) -> tuple[float, float]:
    """Return the share of the force that each foot presses on the ground with."""
    left, right = soles
    if not (left.touches and right.touches):
        return float(left.touches), float(right.touches)
    across = right.center - left.center
    share = float((pressure - left.center) @ across) / max(float(across @ across), 1e-9)
    share = min(max(share, 0.0), 1.0)
    return 1.0 - share, share
