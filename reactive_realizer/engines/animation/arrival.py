"""How a motion sets in that begins where it was made to begin, and not where the body is."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, difference
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.inertia import faded
from reactive_realizer.engines.animation.motion_unit import Posed

_DURATION, _MOST = 0.3, 0.25
"""s, but at most this part of the motion."""

_LATE = 0.05
"""s; what is asked for later than this for the first time was not begun at its beginning."""


class Arrival:
    """What the body lacks of the first pose of a motion; it fades away while the motion plays in full.

    So nothing jumps, and a motion that a transition led to goes on as fast as it was made: what lacks nothing is not
    changed (`faded`).
    """

    def __init__(self, body: Body, first: Posed, duration: float) -> None:
        """Begins.

        Args:
            body: where the motion sets out from.
            first: what it asks for when it sets out.
            duration: how long it would like to take, s.
        """
        self._body, self._first = body, first
        self._over, self._late = min(_MOST, _DURATION / duration), _LATE / duration
        self._entered: float | None = None
        self._turns: Mapping[str, Quat] = {}
        self._way = ZERO

    def __call__(self, posed: Posed, phase: float) -> Posed:
        """What the motion asks for at a phase as it is shown; the first time says whether it joins late."""
        if self._entered is None:
            late = phase > self._late
            self._entered = phase if late else 0.0
            self._begin(posed if late else self._first)
        left = 1.0 - minimum_jerk(share(phase, self._entered, self._entered + self._over))
        if left == 0.0:
            return posed
        return posed._replace(rotations=faded(posed.rotations, self._turns, left), root=self._moved(posed.root, left))

    def _begin(self, first: Posed) -> None:
        goals = first.rotations.items()
        self._turns = {joint: difference(goal, self._body.rotation(joint)) for joint, goal in goals}
        self._way = ZERO if first.root is None else subtract(self._body.root, first.root)

    def _moved(self, root: Vec3 | None, left: float) -> Vec3 | None:
        return None if root is None else add(root, scale(self._way, left))
