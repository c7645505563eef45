"""Where the targets of the world are, as the figure sees them."""

from collections.abc import Callable

from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.actor import Actor
from reactive_realizer.errors import error


def sight_of(actor: Actor, target: str, *, follow: bool) -> Callable[[], Vec3]:
    """Where a target is now, in the figure's own frame, m.

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

    def locate() -> Vec3:
        position = world.position(target) if follow or not seen else None
        if position is not None:
            seen[:] = [position]
        return humanoid.to_own_frame(seen[0] if seen else known)

    return locate
