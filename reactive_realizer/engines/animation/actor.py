"""The figure that moves, and what it finds around it: what motions are made for."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.posture.rest import Rest


@dataclass(frozen=True, slots=True, eq=False)
class Actor:
    """One character, for its motions.

    Attributes:
        humanoid: its figure.
        world: what can be looked and pointed at.
        asset: finds a file by name.
        seed: of the randomness of this character.
        rest: how it stands when it does nothing.
    """

    humanoid: Humanoid
    world: World
    asset: Callable[[str], Path]
    seed: int
    rest: Rest


@dataclass(frozen=True, slots=True)
class Wanted:
    """A motion that a binding asks for.

    Attributes:
        behavior: that it is to play.
        parameters: of the motion, as the behavior says them, else as the binding does.
        file: name of its file, None for a motion without one.
        added: whether it is to be added to what else moves its joints.
    """

    behavior: Behavior
    parameters: Mapping[str, str]
    file: str | None = None
    added: bool = False


Maker = Callable[[Wanted], MotionUnit]
"""Makes motions of one kind for one actor.

Raises:
    RealizerError: what is wanted cannot be played; the fault says why.
"""
