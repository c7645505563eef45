"""A metronome (thesis 8.5.1): equal beats whose tempo may change while somebody moves to them."""

import re
from typing import NamedTuple

from anticipators.parameters import within
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard

_TICK = re.compile(r"tick([0-9]{1,9})")
_SLOWEST, _FASTEST = 10.0, 400.0


class _Change(NamedTuple):
    """From a beat on, at a time, beats come one period (s) after another."""

    beat: int
    time: GlobalTime
    period: float


class Metronome(Anticipator):
    """Points ``tickN``, N beats after its start, at first that of the realizer.

    A new tempo holds from the beat that went before: that beat and all earlier ones keep their times, the next comes
    one new period after it.

    Args:
        tempo: beats a minute, 10 to 400.

    Raises:
        RealizerError: a tempo outside of that.
    """

    kind = "metronome"
    events = ("tempo", "start")
    points = ("tickN",)

    def __init__(self, id: str, board: PegBoard, tempo: float = 60.0) -> None:  # noqa: A002
        super().__init__(id, board)
        self._changes = [_Change(0, GlobalTime(0.0), 60.0 / _checked(tempo))]

    @property
    def tempo(self) -> float:
        """Beats a minute."""
        return 60.0 / self._changes[-1].period

    def forecast(self, sync: str) -> Time:
        """The time of a beat; other names are never known."""
        found = _TICK.fullmatch(sync)
        return self._time(int(found[1])) if found else None

    def check(self, name: str, value: float | None) -> None:
        """A tempo is 10 to 400 beats a minute.

        Raises:
            RealizerError: it is not, or "unknown-event".
        """
        super().check(name, value)
        if name == "tempo":
            _checked(value)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``tempo`` changes the time of every beat ahead; ``start`` begins to count anew, now."""
        if name == "start":
            self._changes = [_Change(0, now, self._changes[-1].period)]
            for sync, peg in self._board.predictions(self.id).items():
                peg.set(self.forecast(sync))
        elif name == "tempo":
            self._change_tempo(60.0 / _checked(value), now)

    def _change_tempo(self, period: float, now: GlobalTime) -> None:
        change = self._changes[-1]
        if change.period == period:
            return
        if change.time > now:
            following = self._changes.pop().beat
        else:
            following = change.beat + int((now - change.time + RESOLUTION) / change.period) + 1
        # Quicker than time goes: a beat that would have been due under the new tempo comes now.
        time = max(GlobalTime(self._time(following - 1) + period), now)
        self._changes.append(_Change(following, time, period))
        self.revise(now)

    def _time(self, beat: int) -> GlobalTime:
        change = next(change for change in reversed(self._changes) if change.beat <= beat)
        return GlobalTime(change.time + (beat - change.beat) * change.period)


def _checked(tempo: float | None) -> float:
    return within("tempo", tempo, _SLOWEST, _FASTEST)
