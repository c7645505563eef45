"""The progress of a unit in a phase whose end may move."""

from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime, Time


@dataclass(slots=True)
class PhaseProgress:
    """A phase passes evenly until its end; if that moves, the pace changes from then on.

    Attributes:
        since: when the pace changed last.
        until: the end of the phase; None while it is unknown, and the phase stands still.
        shortest: duration that the whole phase needs, s; it does not pass faster.
        done: the share of the phase that was done when the pace changed, 0 to 1.
    """

    since: GlobalTime
    until: Time
    shortest: float
    done: float = 0.0

    def share(self, now: GlobalTime) -> float:
        """The share of the phase that is done at a time, 0 to 1."""
        if self.until is None or now <= self.since:
            return self.done
        left = 1.0 - self.done
        duration = max(self.until - self.since, left * self.shortest)
        return self.done + left * (now - self.since) / duration if now < self.since + duration else 1.0

    def move(self, until: Time, now: GlobalTime) -> None:
        """Have the phase end at another time from now on."""
        if until != self.until:
            self.done, self.since, self.until = self.share(now), max(now, self.since), until
