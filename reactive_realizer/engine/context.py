"""What an engine is made from."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.lip_sync import LipSyncProvider
from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.reactive.graph import Graph

Trajectory = Callable[[float], float]
"""What share of its way a value has come after a share of its time; 0 to 1, and 1 at 1."""


@dataclass(frozen=True, slots=True)
class EngineContext:
    """Of one character; factories of engines take it, built-in ones and those of plug-ins alike.

    Attributes:
        character: its id.
        humanoid: its figure.
        world: what can be looked at.
        asset: finds a file by name.
        seed: of the randomness of this character.
        tts: the text-to-speech binding that all characters share.
        voice: name of this character's voice, None for the binding's default.
        bindings: the character's binding files, by kind; entries of earlier files count before those of later ones.
        lip_sync: what the mouth does while this character speaks.
        graph: where the parameters of its behaviors are cells.
        trajectories: ways from one value of a parameter to another, by name.
        functions: what formulas of animations may call besides those of the language, by name; pure.
        idle: whether the figure breathes, blinks, glances and shifts its weight while it does nothing.
    """

    character: str
    humanoid: Humanoid
    world: World
    asset: Callable[[str], Path]
    seed: int
    tts: TTSBinding
    voice: str | None
    bindings: Mapping[str, tuple[Path, ...]]
    lip_sync: LipSyncProvider | None = None
    graph: Graph = field(default_factory=Graph)
    trajectories: Mapping[str, Trajectory] = field(default_factory=dict)
    functions: Mapping[str, Callable[..., float]] = field(default_factory=dict)
    idle: bool = True
