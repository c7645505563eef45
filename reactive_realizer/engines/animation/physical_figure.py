"""A figure with joints that controllers move by forces, beside those that motions turn (thesis 8.7.2 and 8.7.5)."""

from collections.abc import Collection, Sequence
from functools import partial
from typing import NamedTuple

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Dynamics, Humanoid
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, difference, multiply, rotation_vector
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, length, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.motions.rotation_curves import CurveEnd, HermiteCurve
from reactive_realizer.physics.controllers.controller import PhysicalController
from reactive_realizer.physics.simulation import SUBSTEP, Exploded, Simulation

_RETURN = 0.6
"""Duration of the return of joints to their animation, s."""

_RETURN_PER_METER = 1.5
"""The same for each meter that the root is away from its animation, s."""

_LONGEST_RETURN = 3.0
"""Limit of the duration of a return, s."""

_LONGEST_FRAME = 0.2
"""Longest part of a frame that is simulated, s. A frame is longer if the realizer was held up."""


class PhysicalFigure:
    """Simulates a figure while controllers act on it, and leads its joints back to their animation afterwards.

    A joint is physical if a controller needs or wants it and no motion turns it. The others follow their animation, and
    what they do acts on the physical ones. A joint that becomes physical goes on with its pose and velocity. The offset
    of one that becomes kinematic again decays along a Hermite curve, which begins with the velocity that the joint has
    (thesis 4.2.4).

    Args:
        humanoid: the figure.
    """

    def __init__(self, humanoid: Humanoid) -> None:
        self._humanoid = humanoid
        self._simulation: Simulation | None = None
        self._physical: frozenset[str] = frozenset()
        self._returns: dict[str, _Return] = {}
        self._frames: tuple[_Frame, ...] = ()
        self._lies = self._falls = False

    @property
    def active(self) -> bool:
        """Whether forces, or their consequences, move joints."""
        return self._simulation is not None or bool(self._returns)

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push the figure from the next frame on; it gives way only if it is simulated then.

        Args:
            joint: of the pushed segment, or within it.
            force: N, in the figure's frame.
            duration: s.
        """
        if self._simulation is not None:
            self._simulation.push(joint, force, duration)

    def take_fall(self) -> bool:
        """Return whether the figure has fallen since the last call. It falls once while it is simulated."""
        falls, self._falls = self._falls, False
        return falls

    def dynamics(self, controllers: Sequence[PhysicalController], claimed: Collection[str]) -> Dynamics | None:
        """Return the movement by forces in the next frame; None if there is none.

        Args:
            controllers: that act; their parameters do not change before the frame is made.
            claimed: joints that motions turn.
        """
        if not controllers and not self.active:
            return None
        if not self._frames:
            self._frames = (_Frame(0.0, self._humanoid.shown, self._humanoid.shown),)
        return partial(self._move, controllers, claimed)

    def _move(
        self, controllers: Sequence[PhysicalController], claimed: Collection[str], body: Body, duration: float
    ) -> Body:
        physical, taken = self._chosen(controllers, claimed)
        for joint in self._physical - physical:
            self._returns[joint] = self._leave(joint, body, 0.0 if joint in taken else duration)
        self._returns = {joint: each for joint, each in self._returns.items() if joint not in physical}
        self._physical = physical
        goal = self._returning(body, duration)
        try:
            shown = self._simulated(controllers, goal, duration)
        except Exploded:
            for controller in controllers:
                controller.failed = True
            return self._move((), claimed, body, 0.0)
        self._frames = (self._frames[-1], _Frame(duration, body, shown))
        if not controllers and not self._returns:
            self._frames = ()
        return shown

    def _chosen(
        self, controllers: Sequence[PhysicalController], claimed: Collection[str]
    ) -> tuple[frozenset[str], frozenset[str]]:
        """Return the joints that are physical from now on, and those that motions claim.

        In the first frame none is physical, so that the simulation learns the velocities of the figure. A figure that
        still returns from the ground is not simulated: it could not keep its balance there.
        """
        if not controllers:
            self._simulation, self._lies = None, False
        elif self._simulation is None and ROOT in self._returns:
            pass
        elif self._simulation is None:
            steps = self._humanoid.simulation_steps
            substep = SUBSTEP if steps is None else 1.0 / (steps * RATE)
            self._simulation = Simulation(self._humanoid.avatar.skeleton, self._humanoid.weight, substep)
            self._simulation.place(self._frames[-1].shown)
        else:
            moved = (joint for controller in controllers for joint in controller.joints | controller.desired)
            taken = self._simulation.segments(claimed)
            return self._simulation.segments(moved) - taken, taken
        return frozenset(), frozenset()

    def _simulated(self, controllers: Sequence[PhysicalController], goal: Body, duration: float) -> Body:
        simulation = self._simulation
        if simulation is None:
            return goal
        if set(simulation.kinematic) != set(simulation.joints) - self._physical:
            simulation.kinematic = set(simulation.joints) - self._physical
        steps = round(min(duration, _LONGEST_FRAME) / simulation.substep)
        if steps == 0:  # the first frame of all
            simulation.place(goal)
            return goal
        simulation.advance(goal, controllers, steps)
        self._falls = self._falls or (simulation.fallen and not self._lies)
        self._lies = self._lies or simulation.fallen
        return simulation.body(goal)

    def _returning(self, body: Body, duration: float) -> Body:
        """Return a body with the offsets of the joints that return to it."""
        for each in self._returns.values():
            each.elapsed += duration
        self._returns = {joint: each for joint, each in self._returns.items() if each.elapsed < each.duration}
        turns = {joint: multiply(body.rotation(joint), each.turn()) for joint, each in self._returns.items()}
        if not turns:
            return body
        return body.posed(turns, add(body.root, self._returns[ROOT].way()) if ROOT in turns else body.root)

    def _leave(self, joint: str, body: Body, duration: float) -> "_Return":
        """Return the way of a joint back to its animation.

        Args:
            joint: that becomes kinematic.
            body: of the animation, at the end of the present frame.
            duration: of this frame, s; 0 if the animation of the joint begins in it.
        """
        before, last = self._frames
        goal = last.animated if duration > 0.0 else body
        own = _velocity(joint, last.animated, body, duration) if duration > 0.0 else ZERO
        velocity = subtract(_velocity(joint, before.shown, last.shown, last.duration), own)
        way, drift = ZERO, ZERO
        if joint == ROOT:
            way = subtract(last.shown.root, goal.root)
            drift = scale(subtract(last.shown.root, before.shown.root), 1.0 / last.duration)
        time = min(max(_RETURN, _RETURN_PER_METER * length(way)), _LONGEST_RETURN)
        turn = difference(goal.rotation(joint), last.shown.rotation(joint))
        return _Return(HermiteCurve(CurveEnd(turn, scale(velocity, time)), CurveEnd(IDENTITY)), way, drift, time)


def _velocity(joint: str, before: Body, after: Body, duration: float) -> Vec3:
    """Return the mean angular velocity of a joint from one body to another, in its axes, rad/s."""
    return scale(rotation_vector(difference(before.rotation(joint), after.rotation(joint))), 1.0 / duration)


class _Return:
    """The decay of the offset of a joint from its animation.

    Args:
        curve: of the turn from the animation to the joint, over u from 0 to 1.
        way: from the animation to the joint at the beginning, of the root, m.
        drift: velocity of this offset then, m/s.
        duration: until the joint is back, s.

    Attributes:
        elapsed: time since the beginning, s.
    """

    def __init__(self, curve: HermiteCurve, way: Vec3, drift: Vec3, duration: float) -> None:
        self._curve, self._way, self._drift, self.duration = curve, way, drift, duration
        self.elapsed = 0.0

    def turn(self) -> Quat:
        """Return the turn from the animation to the joint."""
        return self._curve(self.elapsed / self.duration)

    def way(self) -> Vec3:
        """Return the way from the animation to the joint, m."""
        u = self.elapsed / self.duration
        carried = self.duration * u * (1.0 - u) ** 3 * (1.0 + 3.0 * u)
        return add(scale(self._way, 1.0 - minimum_jerk(u)), scale(self._drift, carried))


class _Frame(NamedTuple):
    """A frame: its duration, s, and the body of the animation and as shown at its end."""

    duration: float
    animated: Body
    shown: Body
