"""The figure that moves, and what it finds around it: what motions are made for."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, runtime_checkable

from reactive_realizer.binding.asset_file import first_asset
from reactive_realizer.binding.flag import flag
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engines.animation.expression.functions import Function
from reactive_realizer.engines.animation.motion_unit import JOINTS, MIRROR, NAME, MotionUnit
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.errors import error


@dataclass(frozen=True, slots=True, eq=False)
class Actor:
    """One character, for its motions.

    Attributes:
        humanoid: its figure.
        world: what can be looked and pointed at.
        asset: finds a file by name.
        seed: of the randomness of this character.
        rest: how it stands when it does nothing.
        functions: what formulas of animations may call besides those of the language.
    """

    humanoid: Humanoid
    world: World
    asset: Callable[[str], Path]
    seed: int
    rest: Rest
    functions: Mapping[str, Function]

    def file_of(self, wanted: "Wanted", *suffixes: str) -> Path:
        """The file of a motion, else that of its name, with one of these suffixes, anywhere among the assets.

        Raises:
            RealizerError: there is none, or there are two.
        """
        if wanted.file is not None:
            return self.asset(wanted.file)
        name = wanted.parameters.get(NAME)
        if name is None:
            raise error("no-file", element=wanted.behavior.name)
        return first_asset(self.asset, *(f"**/{name}.{suffix}" for suffix in suffixes))


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

    @property
    def mirror(self) -> bool:
        """Whether left is to be right (thesis C.1.2).

        Raises:
            RealizerError: "not-a-flag": it says neither yes nor no.
        """
        return flag(MIRROR, self.parameters.get(MIRROR, "false"))

    @property
    def joints(self) -> frozenset[str]:
        """The joints to which it is confined, as they are called in the mirror (C.1.2); none: all that it turns."""
        return frozenset(re.findall(r"[^\s,]+", self.parameters.get(JOINTS, "")))


@runtime_checkable
class SlowMaker(Protocol):
    """A maker that has to read long files first."""

    def reading(self, wanted: Wanted) -> Callable[[], object] | None:
        """The work of reading what a motion is made of, for any thread; making it finds that at hand.

        Returns:
            It raises no `RealizerError`. None where there is nothing to be read.

        Raises:
            RealizerError: what is wanted cannot be played.
        """
        ...


@runtime_checkable
class LookingMaker(Protocol):
    """A maker that looks at files, and remembers what it found."""

    def look_again(self) -> None:
        """Something new is to be planned: files may have been saved since."""
        ...


Maker = Callable[[Wanted], MotionUnit]
"""Makes motions of one kind for one actor.

Raises:
    RealizerError: what is wanted cannot be played; the fault says why.
"""
