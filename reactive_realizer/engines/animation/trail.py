"""Where a body was last, and where it goes from there."""

from collections.abc import Callable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import length
from reactive_realizer.engines.animation.moving import Moving, Seen

_LONGEST = 0.05
"""s; what was seen longer ago tells nothing of how the body moves now."""
_FASTEST = 20.0
"""rad/s; a joint that turned faster was put where it is, and does not go on."""


class Trail:
    """The bodies of the last two frames; of one that nobody has watched, nothing is known but its pose."""

    def __init__(self, body: Callable[[], Body]) -> None:
        """Follows a body as the last frame came to it."""
        self._body = body
        self._frame: GlobalTime | None = None
        self._seen: list[Seen] = []

    def frame(self, now: GlobalTime) -> None:
        """A frame is to be composed."""
        self._seen = self._with_last()
        self._frame = now

    def last(self, time: GlobalTime) -> Seen | None:
        """The body in the last frame before a time; None if there was none of late."""
        seen = self._with_last()
        return seen[-1] if seen and 0.0 <= time - seen[-1].time <= _LONGEST else None

    def at(self, time: GlobalTime) -> Moving:
        """How the body has moved on by a time."""
        seen, last = self._with_last(), self.last(time)
        if last is None or len(seen) < 2 or seen[0].time == last.time or last.time - seen[0].time > _LONGEST:
            return Moving(self._body(), {}, {})
        velocities = Moving.along(seen[0], last).velocities.items()
        going_on = {joint: velocity for joint, velocity in velocities if length(velocity) < _FASTEST}
        return Moving(Moving(last.body, going_on, {}).after(time - last.time), going_on, {})

    def _with_last(self) -> list[Seen]:
        body = self._body()
        if self._frame is None or (self._seen and self._seen[-1].body is body):
            return self._seen
        return [*self._seen, Seen(self._frame, body)][-2:]
