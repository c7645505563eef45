"""Predicts the key moments of a physical exercise (thesis 6.5.1, 8.5.1, 10.3.6), from an accelerometer."""

import re

from anticipators.parameters import within
from anticipators.peaks import Peaks
from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.anticipator import (
    Anticipator,
    AnticipatorContext,
    AnticipatorEvent,
    Counted,
    Predictions,
)

_NAME = re.compile(r"[^\W\d]\w{0,199}")
_SHORTEST, _LONGEST = 0.3, 10.0
_STRONGEST = 1e6


class BadPeakName(Fault):
    """A name that cannot be the name of a peak."""

    code = "bad-peak-name"
    template = "'{name}' is not a valid peak name: use a letter followed by letters, digits or '_', each name once"
    name: str


class Exercise(Anticipator):
    """Its points are ``N``, the Nth peak of acceleration, and the names of peaks, each of which is the next such peak.

    Peaks coincide with the key moments of exercises (thesis 10.3.6). Peaks get the names in turn, and the intervals
    between them need not be equal: for squats with the names ``down`` and ``up``, ``down`` is the next time that the
    knees are bent, and ``3`` is the second time. It assumes magnitudes of acceleration, with or without gravity, at 20
    samples per second or more, one peak per key moment, and key moments 0.3 to 10 s apart, with a tempo that drifts but
    does not jump. A `Rhythm` predicts each peak once its interval has been observed.

    Args:
        names: of the peaks of one repetition, in order; if empty, peaks are only counted.
        rise: height of a peak above the slow average of the samples, in their unit, more than 0; 3 suits m/s².
        phase: share of the error of a peak that the next one corrects.
        period: share of the error by which the interval changes.
        ahead: number of peaks predicted after the last one, also when the user rests.

    Raises:
        RealizerError: a parameter is out of range, or a name is invalid or used twice.
    """

    kind = "exercise"
    events = ("sample", "start")

    def __init__(
        self,
        context: AnticipatorContext,
        names: tuple[str, ...] = (),
        rise: float = 3.0,
        phase: float = 0.5,
        period: float = 0.4,
        ahead: float = 4,
    ) -> None:
        super().__init__(context)
        for rank, name in enumerate(names):
            if not _NAME.fullmatch(name) or name in names[:rank]:
                raise RealizerError(BadPeakName(name=name))
        self._names = names
        self.points = (Counted(""), *names)
        self._peaks = Peaks(within("rise", rise, 1e-6, _STRONGEST))
        self._rhythm = Rhythm(phase, period, ahead, _SHORTEST, _LONGEST, max(1, len(names)))

    async def predictions(self) -> Predictions:
        """The next peak of each name, and the numbered peaks, after each peak: those that come and those that pass."""
        while True:
            event = await self.next_input(until=self._rhythm.coming)
            if self._take(event, self.clock.now()):
                for name in self._names:
                    yield name, self._next(name)
                for number in self.named:
                    yield number, self.forecast(number)

    def forecast(self, point: str) -> Time:
        """The time of a peak by its number."""
        return self._rhythm.time(int(point))

    def check(self, name: str, value: float | None) -> None:
        """Check that a sample is a magnitude.

        Raises:
            RealizerError: "bad-number" or "unknown-event".
        """
        super().check(name, value)
        if name == "sample":
            within(name, value, 0.0, _STRONGEST)

    def _take(self, event: AnticipatorEvent | None, now: GlobalTime) -> bool:
        """Take an event, if there was one, or else note the peaks that have passed; whether times have changed."""
        if event is None:
            return self._rhythm.advance(now)
        if event.name == "start":
            self._rhythm.restart()
            return True
        peak = self._peaks.take(event.value or 0.0, now)
        passed = self._rhythm.advance(now)
        return (peak is not None and self._rhythm.hear(peak, now)) or passed

    def _next(self, name: str) -> Time:
        """The time of the next peak with a name."""
        passed, names = self._rhythm.passed, len(self._names)
        return self._rhythm.time(passed + 1 + (self._names.index(name) - passed) % names)
