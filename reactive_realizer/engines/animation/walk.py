"""The walking of a figure: where its frame is, and what moves with its feet."""

from collections.abc import Iterator

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Transform
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.pose import Layer, turned_further
from reactive_realizer.engine.effects import MovePoints
from reactive_realizer.engines.animation.easing import smoothstep
from reactive_realizer.engines.animation.motions.locomotion import LocomotionUnit
from reactive_realizer.engines.animation.walking.carriage import Carriage
from reactive_realizer.engines.animation.walking.progression import Goal
from reactive_realizer.engines.animation.walking.walker import Walker

_UNREST = 0.1
"""Idle animation shifts no weight in walking, as if the pelvis were lower by this, m."""

_EASING = 0.5
"""Time in which this sets in and leaves off, s."""


class Walk:
    """Has a figure walk as its locomotion asks for.

    Attributes:
        feet: goals of its ankles in its own frame, left first; empty while it does not walk.
    """

    def __init__(self, humanoid: Humanoid) -> None:
        self._humanoid = humanoid
        self._walker = Walker(humanoid.place)
        self._carriage = Carriage()
        self.feet: tuple[Transform, ...] = ()
        self._walking, self._time = 0.0, GlobalTime(0.0)
        humanoid.planned_steps = self._walker.planned_steps

    @property
    def active(self) -> bool:
        """Return whether the figure walks, or its feet are not at rest yet."""
        return self._walker.active

    @property
    def stiffness(self) -> float:
        """How much lower the pelvis would be of a figure that shifts its weight as little, m."""
        return _UNREST * smoothstep(self._walking)

    def moves(self, unit: LocomotionUnit, now: GlobalTime) -> Iterator[MovePoints]:
        """Yield the moves of the end of a locomotion."""
        yield from unit.look(now, self._humanoid.place, self._walker.progression.velocity)

    def layers(self, now: GlobalTime, goal: Goal | None, rest: Body) -> tuple[Layer, ...]:
        """Move the figure to where it is at a time, and return the layers of its walking.

        Args:
            now: of the frame, s.
            goal: where the figure goes; without one it comes to rest.
            rest: the body at rest.
        """
        self._walker.advance(now, goal, rest)
        self._humanoid.place = self._walker.progression.place
        passed, self._time = now - self._time, now
        change = passed / _EASING
        moving = self.active and not self._walker.arrived
        self._walking = min(1.0, max(0.0, self._walking + (change if moving else -change)))
        if self._walker.arrived and not self._walking:
            self._walker.rest()
            self._carriage = Carriage()
        if not self.active:
            self.feet = ()
            return ()
        walking = smoothstep(self._walking)
        pelvis = self._carriage.pelvis(now, self._walker, rest, walking)
        body = turned_further(rest, pelvis)
        poses = self._walker.poses(body)
        self.feet = tuple(pose.ankle for pose in poses)
        lowered = self._carriage.lowered(body, poses, walking)
        return pelvis, lowered, self._carriage.limbs(self._walker.progression, poses, rest)
