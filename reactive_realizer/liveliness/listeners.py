"""Finds to whom a character speaks."""

from collections.abc import Mapping, Sequence
from math import atan2, hypot, inf, radians
from typing import Final

from reactive_realizer.bml.behaviors import Gaze
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.effects import Reached
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

_AHEAD: Final = radians(30.0)
"""Largest angle from straight ahead to a listener, rad, unless the character was asked to look there."""


class Listeners:
    """The listeners of characters: what each looked at when it was last asked to, or else what is ahead of it.

    Args:
        scheduler: of the gazes.
        figures: of the characters, by id.
        world: the targets of their eyes.
    """

    def __init__(self, scheduler: BMLScheduler, figures: Mapping[str, Humanoid], world: World) -> None:
        self._figures = figures
        self._world = world
        self._looked_at: dict[str, str] = {}
        """By character, the target of the last gaze that was asked for."""
        scheduler.listen_to_points(self._follow)

    def of(self, character: str) -> str | None:
        """The target of the last gaze of a character, or else the one that is nearest ahead; None if there is none."""
        looked_at = self._looked_at.get(character)
        if looked_at is not None and self._world.position(looked_at) is not None:
            return looked_at
        aside = ((self._aside(character, target), target) for target in self._world.targets if target != character)
        return min(((angle, target) for angle, target in aside if angle <= _AHEAD), default=(0.0, None))[1]

    def _follow(self, reached: Sequence[Reached]) -> None:
        for unit in (each.unit for each in reached if each.point.id == "start"):
            if isinstance(unit.behavior, Gaze) and not unit.accompanies:
                self._looked_at[unit.block.character] = unit.behavior.target

    def _aside(self, character: str, target: str) -> float:
        """The angle between straight ahead of a character and a target, rad."""
        eyes, position = self._world.position(character), self._world.position(target)
        if eyes is None or position is None:
            return inf
        x, y, z = self._figures[character].to_own_axes(subtract(position, eyes))
        return atan2(hypot(x, y), z)
