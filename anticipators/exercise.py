"""Key moments of an exercise that somebody does (thesis 6.5.1, 8.5.1, 10.3.6), from an accelerometer."""

import re

from anticipators.parameters import within
from anticipators.peaks import Peaks
from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import error
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard

_NUMBER = re.compile(r"[0-9]{1,9}")
_NAME = re.compile(r"[^\W\d]\w{0,199}")
_SHORTEST, _LONGEST = 0.3, 10.0
_STRONGEST = 1e6


class Exercise(Anticipator):
    """Points ``N``: the Nth peak of acceleration, counted from the first; and, each the next of its kind, its names.

    Peaks were found to coincide with the key moments of exercises (thesis 10.3.6). With names, every peak is one of
    them, in turn from the first one on, and the intervals between them need not be equal: of squats with the names
    ``down`` and ``up``, ``down`` is the next time the knees are bent, and ``3`` the second. It assumes magnitudes of
    acceleration, gravity included or not, of 20 samples a second or more, one peak a key moment, and key moments 0.3 to
    10 s apart whose tempo drifts rather than jumps. Each is expected by a `Rhythm` once its interval was seen.

    Args:
        names: of the peaks of one repetition, in order; none: peaks are only counted.
        rise: how far above the slow average of the samples a peak is, in their unit, more than 0; 3 suits m/s².
        phase: how much of the distance between a peak and its prediction the next one makes good.
        period: how much of it the interval follows.
        ahead: how many peaks are predicted after the last one: so many still come when the user rests.

    Raises:
        RealizerError: a parameter out of its range, or a name that is none or stands there twice.
    """

    kind = "exercise"
    events = ("sample", "start")

    def __init__(
        self,
        id: str,  # noqa: A002
        board: PegBoard,
        names: tuple[str, ...] = (),
        rise: float = 3.0,
        phase: float = 0.5,
        period: float = 0.4,
        ahead: float = 4,
    ) -> None:
        super().__init__(id, board)
        for rank, name in enumerate(names):
            if not _NAME.fullmatch(name) or name in names[:rank]:
                raise error("bad-peak-name", name=name)
        self._names = names
        self.points = ("N", *names)
        self._peaks = Peaks(within("rise", rise, 1e-6, _STRONGEST))
        self._rhythm = Rhythm(phase, period, ahead, _SHORTEST, _LONGEST, max(1, len(names)))

    def forecast(self, sync: str) -> Time:
        """The time of a peak by its number, or of the next one of a name; others are never known."""
        if sync in self._names:
            passed, names = self._rhythm.passed, len(self._names)
            return self._rhythm.time(passed + 1 + (self._names.index(sync) - passed) % names)
        return self._rhythm.time(int(sync)) if _NUMBER.fullmatch(sync) else None

    def check(self, name: str, value: float | None) -> None:
        """A sample is a magnitude.

        Raises:
            RealizerError: it is not, or "unknown-event".
        """
        super().check(name, value)
        if name == "sample":
            within(name, value, 0.0, _STRONGEST)

    def advance(self, now: GlobalTime) -> None:
        """What has come is expected again, under its name."""
        points = self._board.predictions(self.id) if self._rhythm.advance(now) else {}
        for name in self._names:
            if name in points and is_due(points[name].value, now):
                self.renew(name)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``sample``: a magnitude of acceleration; ``start``: the next peak is the first, and of the first name."""
        if name == "sample" and value is not None:
            peak = self._peaks.take(value, now)
            if peak is not None and self._rhythm.hear(peak, now):
                self.revise(now)
        elif name == "start":
            self._rhythm.restart()
            self.withdraw(now)
