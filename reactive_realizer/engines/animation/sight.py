"""Where the targets of the world are, as the figure sees them."""

from typing import Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.actor import Actor
from reactive_realizer.errors import error


class Sight(Protocol):
    """Where a target is."""

    def __call__(self, time: GlobalTime | None = None) -> Vec3:
        """In the figure's own frame, m: at the time of a frame that is being made, or as it is seen now."""
        ...


def sight_of(actor: Actor, target: str, *, follow: bool) -> Sight:
    """Where a target is, whenever it is asked for.

    Args:
        actor: whose frame.
        target: its name.
        follow: whether it is looked for each time; else it stays where it was when it was first looked for. A target
            that is gone stays where it was seen last.

    Raises:
        RealizerError: "no-target": it is not there now.
    """
    world, humanoid = actor.world, actor.humanoid
    known = world.position(target)
    if known is None:
        raise error("no-target", target=target, known=", ".join(world.targets))
    seen: list[Vec3] = []

    def locate(time: GlobalTime | None = None) -> Vec3:
        position = world.position(target, time) if follow or not seen else None
        if position is not None:
            seen[:] = [position]
        return humanoid.to_own_frame(seen[0] if seen else known)

    return locate
