"""From a behavior to a gaze."""

from collections.abc import Callable

from reactive_realizer.bml.behaviors import Gaze
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.vector import ZERO, Vec3
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.gaze.gaze_motion_unit import GazeMotionUnit
from reactive_realizer.errors import error

DYNAMIC = (BMLT, "dynamic")
"""The attribute by which a gaze follows a target that moves."""


class GazeMaker:
    """Makes gazes at targets of the world."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor

    def __call__(self, wanted: Wanted) -> GazeMotionUnit:
        """As every maker."""
        behavior = wanted.behavior
        if not isinstance(behavior, Gaze):
            raise error("no-unit", unit=f"gaze for {behavior.name}")
        world = self._actor.world
        if world.position(behavior.target) is None:
            raise error("no-target", target=behavior.target, known=", ".join(world.targets))
        return GazeMotionUnit(
            self._target(behavior.target, behavior.extensions.get(DYNAMIC) == "true"),
            behavior.influence or Influence.HEAD,
            behavior.offset_angle,
            behavior.offset_direction.value,
        )

    def _target(self, name: str, dynamic: bool) -> Callable[[], Vec3]:
        """Where to look, in the figure's own frame; a target that is gone stays where it was seen last."""
        world, humanoid = self._actor.world, self._actor.humanoid
        seen: list[Vec3] = []

        def locate() -> Vec3:
            position = world.position(name) if dynamic or not seen else None
            if position is not None:
                seen[:] = [position]
            return humanoid.to_own_frame(seen[0]) if seen else ZERO

        return locate
