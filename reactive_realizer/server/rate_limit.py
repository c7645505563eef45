"""How often somebody may do something."""

from reactive_realizer.clock.clock import Clock


class RateLimit:
    """A bucket of tokens that fills at a rate and holds one second's worth.

    Args:
        per_second: how often on the average.
        clock: fills the bucket.
    """

    def __init__(self, per_second: int, clock: Clock) -> None:
        self._rate = per_second
        self._clock = clock
        self._tokens = float(per_second)
        self._filled = clock.now()

    def allows(self) -> bool:
        """Whether it may be done once more now."""
        now = self._clock.now()
        self._tokens = min(float(self._rate), self._tokens + (now - self._filled) * self._rate)
        self._filled = now
        if self._tokens < 1:
            return False
        self._tokens -= 1
        return True
