"""Hands that turn with a target that they hold on to."""

from collections.abc import Callable

from reactive_realizer.embodiment.quaternion import Quat, conjugate, multiply


class Grip:
    """The rotations of hands relative to a target: each keeps the one with which it has arrived.

    A target that gets its orientation later is held from then on.

    Args:
        target: returns the orientation of the target in the figure's frame; None if it has none.
    """

    def __init__(self, target: Callable[[], Quat | None]) -> None:
        self._target = target
        self._hands: dict[str, Quat] = {}

    def hold(self, side: str, hand: Quat) -> None:
        """Note the rotation of a hand that is at the target, unless that is known.

        Args:
            side: "l" or "r".
            hand: from its axes to those of the figure.
        """
        target = self._target()
        if target is not None and side not in self._hands:
            self._hands[side] = multiply(conjugate(target), hand)

    def turn(self, side: str) -> Quat | None:
        """Return the rotation of a hand, from its axes to those of the figure; None if it turns with no target."""
        target = self._target()
        return None if target is None or side not in self._hands else multiply(target, self._hands[side])
