"""Notices parameters that jump while a motion plays, if its joints would jump with them."""

from collections.abc import Sequence
from itertools import zip_longest

from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.reactive.graph import Cell

_MUCH_MORE = 2.0
"""Factor between the changes of a parameter in two frames from which on it may have jumped."""

_FOLLOWED = 0.012
"""Difference between the turns of a joint in two frames up to which a change of parameters is followed, rad."""


class ParameterJumps:
    """Compares the parameters of a motion, and its layers, from frame to frame."""

    def __init__(self, cells: Sequence[Cell[float]], shown: Layer) -> None:
        """Prepare to compare.

        Args:
            cells: of the parameters that may change while the motion plays.
            shown: the layer before its first one.
        """
        self._cells = cells
        self._played: tuple[float, ...] = ()
        self._changes: tuple[float, ...] = ()
        self._former = shown

    def start(self) -> None:
        """Note the parameters with which the motion starts."""
        self._played = self._values()

    def occur(self, before: Layer, layer: Layer) -> bool:
        """Return whether parameters have changed by much more than just before, and a joint jumps with them.

        Args:
            before: the layer that was shown in the frame before.
            layer: the one of this frame.
        """
        former, self._former = self._former, before
        return self._changed() and _jumps(former, before, layer)

    def _changed(self) -> bool:
        """Return whether a parameter has changed since the last call, by much more than just before."""
        played, self._played = self._played, self._values()
        before, self._changes = self._changes, _changes(played, self._played)
        if not self._changes:
            return False
        pairs = zip_longest(self._changes, before, fillvalue=0.0)
        return any(abs(change) > _MUCH_MORE * abs(last) for change, last in pairs)

    def _values(self) -> tuple[float, ...]:
        return tuple([cell.value for cell in self._cells])


def _changes(before: Sequence[float], after: Sequence[float]) -> tuple[float, ...]:
    """Return the differences of values; nothing if there is none."""
    return () if before == after else tuple(new - old for old, new in zip(before, after, strict=True))


def _jumps(former: Layer, before: Layer, after: Layer) -> bool:
    """Return whether the turn of a joint in a frame differs from the one before by more than can be followed."""
    for joint, turn in after.rotations.items():
        last = before.rotations.get(joint, turn)
        first = former.rotations.get(joint, last)
        if angle(difference(difference(first, last), difference(last, turn))) > _FOLLOWED:
            return True
    return False
