"""Makers of motions: the requests that they get, and the figure they make motions for."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, runtime_checkable

from reactive_realizer.binding.asset_file import first_asset, parse_boolean
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.expressivity import NEUTRAL, Expressivity
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.feet import walks
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.place import Place
from reactive_realizer.embodiment.quaternion import Quat, conjugate, multiply
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.embodiment.world import World
from reactive_realizer.engines.animation.expression.functions import Function
from reactive_realizer.engines.animation.faults import NoFile, NoTarget
from reactive_realizer.engines.animation.motion_unit import JOINTS, MIRROR, NAME, MotionUnit
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.errors import RealizerError


@dataclass(frozen=True, slots=True, eq=False)
class MakerContext:
    """One character, as makers of motions see it.

    Attributes:
        humanoid: its figure.
        world: with the targets to look and point at.
        asset: finds a file by name.
        seed: of the random generators of this character.
        rest: its rest posture.
        functions: of plug-ins, for formulas of animations.
        character: its id.
        place: returns where it will stand when the behavior that is being planned starts.
        expressivity: of its motions, unless they ask for another one.
    """

    humanoid: Humanoid
    world: World
    asset: Callable[[str], Path]
    seed: int
    rest: RestPosture
    functions: Mapping[str, Function]
    character: str
    place: Callable[[], Place]
    expressivity: Expressivity = NEUTRAL

    @property
    def can_step(self) -> bool:
        """True if the figure stands on two feet when the behavior that is being planned starts."""
        return self.rest.expected.stance is StanceType.STANDING and walks(self.humanoid.avatar.skeleton)

    def file_of(self, request: "MotionRequest", *suffixes: str) -> Path:
        """Return the requested file, or the asset that has the requested name and one of the suffixes.

        Raises:
            RealizerError: there is no such file, or there are two.
        """
        if request.file is not None:
            return self.asset(request.file)
        name = request.parameters.get(NAME)
        if name is None:
            raise RealizerError(NoFile(element=request.behavior.name))
        return first_asset(self.asset, *(f"**/{name}.{suffix}" for suffix in suffixes))


@dataclass(frozen=True, slots=True)
class MotionRequest:
    """The motion that a binding selects for a behavior.

    Attributes:
        behavior: to play.
        parameters: of the motion, from the behavior or else from the binding.
        file: its name, None for a motion without a file.
        added: whether the motion is added to other motion of its joints.
    """

    behavior: Behavior
    parameters: Mapping[str, str]
    file: str | None = None
    added: bool = False

    @property
    def mirror(self) -> bool:
        """Whether left and right are exchanged (thesis C.1.2).

        Raises:
            RealizerError: "not-a-flag": the parameter is not a boolean.
        """
        return parse_boolean(MIRROR, self.parameters.get(MIRROR, "false"))

    @property
    def joints(self) -> frozenset[str]:
        """The joints to which the motion is restricted, by their names after mirroring (C.1.2).

        Empty for no restriction.
        """
        return frozenset(re.findall(r"[^\s,]+", self.parameters.get(JOINTS, "")))


@runtime_checkable
class PreloadingMaker(Protocol):
    """A maker that reads long files ahead."""

    def preload(self, request: MotionRequest) -> Callable[[], object] | None:
        """Return the work of loading a motion, for any thread. Making the motion then finds it in a cache.

        Returns:
            The work, which raises no `RealizerError`; None if there is nothing to load.

        Raises:
            RealizerError: the request cannot be played.
        """
        ...


@runtime_checkable
class RefreshingMaker(Protocol):
    """A maker that caches which files it found."""

    def refresh(self) -> None:
        """Look for files again: they may have changed."""
        ...


@runtime_checkable
class ListingMaker(Protocol):
    """A maker of the motions of libraries, files with many of them."""

    def names(self, file: str | None) -> tuple[str, ...]:
        """Return the names of the motions of a file.

        Raises:
            RealizerError: there is no such file, or it is invalid.
        """
        ...


MotionMaker = Callable[[MotionRequest], MotionUnit]
"""Makes motions of one kind for one figure.

Raises:
    RealizerError: the request cannot be played; the fault gives the reason.
"""


class TargetLocator(Protocol):
    """Locates a target."""

    def __call__(self, time: GlobalTime | None = None) -> Vec3:
        """Return its position in the figure's frame, m: at the time of the frame being made, or as shown now."""
        ...


def target_locator(context: MakerContext, target: str, *, follow: bool) -> TargetLocator:
    """Return a locator of a target.

    Args:
        context: of the figure.
        target: its name.
        follow: whether the target is located each time; otherwise it stays where it was first. A target that disappears
            stays where it was last.

    Raises:
        RealizerError: "no-target": there is no such target now.
    """
    world, humanoid = context.world, context.humanoid
    known = world.position(target)
    if known is None:
        raise RealizerError(NoTarget(target=target, known=tuple(world.targets)))
    seen: list[Vec3] = []

    def locate(time: GlobalTime | None = None) -> Vec3:
        position = world.position(target, time) if follow or not seen else None
        if position is not None:
            seen[:] = [position]
        return humanoid.to_own_frame(seen[0] if seen else known)

    return locate


def target_turn(context: MakerContext, target: str) -> Callable[[], Quat | None]:
    """Return what tells the orientation of a target in the figure's frame; None if it has none."""

    def turn() -> Quat | None:
        orientation = context.world.orientation(target)
        return None if orientation is None else multiply(conjugate(context.humanoid.place.turn), orientation)

    return turn
