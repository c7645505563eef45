"""When the next beats come, from those that were heard: what everybody has in mind who follows a rhythm."""

from anticipators.parameters import within
from reactive_realizer.clock.units import GlobalTime, Time, is_due

_WINDOW = 0.3
"""So much of an interval a beat may be away from where it was expected."""


class Rhythm:
    """Beats, counted from 1 for the first one heard, and the times at which the next ones are expected.

    The two-process model of sensorimotor synchronization (J. Mates, A model of synchronization of motor acts to a
    stimulus sequence, Biol. Cybern. 70, 1994; B. Repp, Sensorimotor synchronization: a review of the tapping
    literature, Psychon. Bull. Rev. 12, 2005): a beat that is heard ``e`` seconds after it was expected moves the
    expected ones by ``phase * e``, and makes the intervals between them longer by ``period * e``; it is steady
    within the bounds of these two.

    Between two beats that are heard others may be missed. Further onsets of one beat mean nothing, and one that is more
    than 0.3 intervals from any beat is left out; but two such in a row are a new rhythm.

    Args:
        phase: how much of an error the next beat makes good, more than 0 and at most 1.
        period: how much of it the interval follows, 0 to 1.
        ahead: how many beats are expected after the last one heard, 1 to 100.
        shortest: interval between two beats, s; what follows an onset sooner is its echo.
        longest: interval, s.
        cycle: after how many beats the intervals repeat, where they are not all equal.

    Raises:
        RealizerError: phase, period or ahead out of range.
    """

    def __init__(
        self, phase: float, period: float, ahead: float, shortest: float, longest: float, cycle: int = 1
    ) -> None:
        self._phase = within("phase", phase, 0.01, 1.0)
        self._period = within("period", period, 0.0, 1.0)
        self._ahead = round(within("ahead", ahead, 1, 100))
        self._shortest = shortest
        self._longest = longest
        self._cycle = cycle
        self.restart()

    def restart(self) -> None:
        """Forget everything: the next onset is beat 1."""
        self._passed: list[GlobalTime] = []
        self._next: Time = None
        self._intervals: list[float | None] = [None] * self._cycle
        self._heard = 0
        self._onset: Time = None
        self._stray: Time = None

    @property
    def passed(self) -> int:
        """How many beats there were, heard or not."""
        return len(self._passed)

    def time(self, beat: int) -> Time:
        """When a beat was, or is expected; None while that is unknown."""
        if beat <= self.passed:
            return self._passed[beat - 1] if beat > 0 else None
        time = self._next if beat <= self._heard + self._ahead else None
        for number in range(self.passed + 1, beat):
            interval = self._interval(number)
            if time is None or interval is None:
                return None
            time = GlobalTime(time + interval)
        return time

    def advance(self, now: GlobalTime) -> bool:
        """It is ``now``; whether a beat has come."""
        before = self.passed
        while (due := self.time(self.passed + 1)) is not None and is_due(due, now):
            self._add(due)
        return self.passed > before

    def hear(self, onset: GlobalTime, now: GlobalTime) -> bool:
        """A beat began at ``onset``, not after ``now``; whether that changes what is expected."""
        self.advance(now)
        if self._onset is not None and onset - self._onset < self._shortest:
            return False
        self._onset = onset
        return self._begin(onset) if self._next is None else self._compare(onset, self._next)

    def _compare(self, onset: GlobalTime, coming: GlobalTime) -> bool:
        last = self._passed[-1]
        for beat, time in ((self.passed, last), (self.passed + 1, coming)):
            if abs(onset - time) <= _WINDOW * (coming - last):
                self._stray = None
                return self._follow(beat, time, onset - time)
        # Nothing was heard for so long that nothing was expected any more.
        return self._begin(onset) if onset > coming else self._leave_out(onset)

    def _follow(self, beat: int, time: GlobalTime, error: float) -> bool:
        """Correct phase and interval by a beat that was expected at ``time``."""
        if beat <= self._heard:
            return False
        self._heard = beat
        self._learn(beat - 1, (self._interval(beat - 1) or 0.0) + self._period * error)
        corrected = GlobalTime(time + self._phase * error)
        self._next = corrected if beat > self.passed else self._after(corrected)
        return True

    def _leave_out(self, onset: GlobalTime) -> bool:
        """An onset where no beat is; the second one in a row begins a new rhythm."""
        stray, self._stray = self._stray, onset
        if stray is None or onset - stray > self._longest:
            return False
        self._intervals = [None] * self._cycle
        self._learn(self.passed, onset - stray)
        self._heard = 0
        return self._begin(onset)

    def _begin(self, onset: GlobalTime) -> bool:
        """A beat that nothing had let expect."""
        if self._passed and self._heard == self.passed:
            self._learn(self.passed, onset - self._passed[-1])
        self._stray = None
        self._add(onset)
        self._heard = self.passed
        return True

    def _add(self, time: GlobalTime) -> None:
        self._passed.append(time)
        self._next = self._after(time)

    def _after(self, time: GlobalTime) -> Time:
        interval = self._interval(self.passed)
        return None if interval is None else GlobalTime(time + interval)

    def _interval(self, beat: int) -> float | None:
        """From a beat to the one after it, s."""
        return self._intervals[beat % self._cycle]

    def _learn(self, beat: int, interval: float) -> None:
        if self._shortest <= interval <= self._longest:
            self._intervals[beat % self._cycle] = interval
