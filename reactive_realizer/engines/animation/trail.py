"""Where a body was last, and where it goes from there."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import length
from reactive_realizer.engines.animation.moving import Moving

_LONGEST = 0.05
"""s; what was seen longer ago tells nothing of how the body moves now."""
_FASTEST = 20.0
"""rad/s; a joint that turned faster was put where it is, and does not go on."""


class Trail:
    """The bodies of the last two frames; of one that nobody has watched, nothing is known but its pose."""

    def __init__(self) -> None:
        self._frame: GlobalTime | None = None
        self._seen: list[tuple[GlobalTime, Body]] = []

    def frame(self, now: GlobalTime, body: Body) -> None:
        """A frame is to be composed; the last one came to a body."""
        self._seen = self._with(body)
        self._frame = now

    def at(self, time: GlobalTime, body: Body) -> Moving:
        """How the body that the last frame came to has moved on by a time."""
        seen = self._with(body)
        if len(seen) < 2:
            return Moving(body, {})
        (first, before), (last, after) = seen
        if last <= first or time - first > 2.0 * _LONGEST or time < last:
            return Moving(body, {})
        velocities = Moving.between(before, after, last - first).velocities.items()
        going_on = {joint: velocity for joint, velocity in velocities if length(velocity) < _FASTEST}
        return Moving(after, going_on).after(time - last)

    def _with(self, body: Body) -> list[tuple[GlobalTime, Body]]:
        if self._frame is None or (self._seen and self._seen[-1][1] is body):
            return self._seen
        return [*self._seen, (self._frame, body)][-2:]
