"""Predicts the next beats of a rhythm from those that were heard."""

from anticipators.parameters import within
from reactive_realizer.clock.units import GlobalTime, Time, is_due

_WINDOW = 0.3
"""Largest distance of an onset from its predicted beat, as a share of the interval."""


class Rhythm:
    """The beats heard, counted from 1, and the predicted times of the next ones.

    The two-process model of sensorimotor synchronization (J. Mates, A model of synchronization of motor acts to a
    stimulus sequence, Biol. Cybern. 70, 1994; B. Repp, Sensorimotor synchronization: a review of the tapping
    literature, Psychon. Bull. Rev. 12, 2005): a beat that is heard ``e`` seconds after its predicted time moves the
    predicted beats by ``phase * e``, and makes the intervals between them longer by ``period * e``; it is stable
    within the ranges of these two.

    Beats may be missed. Further onsets of a beat are ignored, and so is an onset that is more than 0.3 intervals from
    any beat; but two such onsets in a row begin a new rhythm.

    Args:
        phase: share of an error that the next beat corrects, more than 0 and at most 1.
        period: share of an error by which the interval changes, 0 to 1.
        ahead: number of beats predicted after the last one heard, 1 to 100.
        shortest: shortest interval between two beats, s; an onset that follows sooner is ignored as an echo.
        longest: longest interval, s.
        cycle: number of beats after which the intervals repeat; 1 if they are all equal.

    Raises:
        RealizerError: phase, period or ahead is out of range.
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
        """The number of beats so far, heard or not."""
        return len(self._passed)

    @property
    def coming(self) -> Time:
        """The predicted time of the next beat; None while it is unknown."""
        return self.time(self.passed + 1)

    def time(self, beat: int) -> Time:
        """The time of a past or predicted beat; None while it is unknown."""
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
        """Count the beats that have passed by ``now``; whether there were any."""
        before = self.passed
        while (due := self.coming) is not None and is_due(due, now):
            self._add(due)
        return self.passed > before

    def hear(self, onset: GlobalTime, now: GlobalTime) -> bool:
        """Process an onset, not after ``now``; whether this changes the prediction."""
        self.advance(now)
        if self._onset is not None and onset - self._onset < self._shortest:
            return False
        self._onset = onset
        unpredicted = self._next is None and self._heard == self.passed
        return self._begin(onset) if unpredicted else self._compare(onset)

    def _compare(self, onset: GlobalTime) -> bool:
        """Process an onset of a beat that was predicted, or of none."""
        last, coming = self._passed[-1], self._next
        interval = last - self._passed[-2] if coming is None else coming - last
        for beat, time in ((self.passed, last), (self.passed + 1, coming)):
            if time is not None and abs(onset - time) <= _WINDOW * interval:
                self._stray = None
                return self._follow(beat, time, onset - time)
        # After a long silence, an onset later than all predictions continues the rhythm.
        return self._begin(onset) if coming is None or onset > coming else self._ignore(onset)

    def _follow(self, beat: int, time: GlobalTime, error: float) -> bool:
        """Correct phase and interval by a beat that was predicted at ``time``."""
        if beat <= self._heard:
            return False
        self._heard = beat
        self._learn(beat - 1, (self._interval(beat - 1) or 0.0) + self._period * error)
        corrected = GlobalTime(time + self._phase * error)
        self._next = corrected if beat > self.passed else self._after(corrected)
        return True

    def _ignore(self, onset: GlobalTime) -> bool:
        """Ignore an onset that is no beat; the second one in a row begins a new rhythm."""
        stray, self._stray = self._stray, onset
        if stray is None or onset - stray > self._longest:
            return False
        self._intervals = [None] * self._cycle
        self._learn(self.passed, onset - stray)
        self._heard = 0
        return self._begin(onset)

    def _begin(self, onset: GlobalTime) -> bool:
        """Count an onset as a beat that was not predicted."""
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
        """The interval from a beat to the next one, s."""
        return self._intervals[beat % self._cycle]

    def _learn(self, beat: int, interval: float) -> None:
        if self._shortest <= interval <= self._longest:
            self._intervals[beat % self._cycle] = interval
