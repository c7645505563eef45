"""The things that behaviors look and point at."""

from collections.abc import Callable, Iterable, Mapping

from reactive_realizer.embodiment.vector import Vec3


class World:
    """Named places: right-handed, m, y up, a character of heading 0 faces +z.

    Args:
        positions: of the fixed targets.
    """

    def __init__(self, positions: Mapping[str, Vec3]) -> None:
        self._positions: dict[str, Vec3] = dict(positions)
        self._living: dict[str, Callable[[str | None], Vec3 | None]] = {}

    def add_character(self, character: str, locate: Callable[[str | None], Vec3 | None]) -> None:
        """Make a character a target: ``locate(joint)`` says where it or one of its joints is."""
        self._living[character] = locate

    def move(self, target: str, position: Vec3 | None) -> None:
        """Put a target elsewhere; None removes it."""
        if position is None:
            self._positions.pop(target, None)
        else:
            self._positions[target] = position

    def position(self, target: str) -> Vec3 | None:
        """Where a target is now; ``alice`` looks her in the eye, ``alice:l_wrist`` at a joint. None: no such target."""
        character, _, joint = target.partition(":")
        if character in self._living:
            return self._living[character](joint or None)
        return self._positions.get(target)

    @property
    def targets(self) -> Iterable[str]:
        """Names of all targets, joints aside."""
        return (*self._positions, *self._living)

    def snapshot(self) -> dict[str, Vec3]:
        """All targets with their places."""
        known = ((target, self.position(target)) for target in self.targets)
        return {target: position for target, position in known if position is not None}
