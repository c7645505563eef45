"""A metronome (thesis 8.5.1): equal beats in a tempo that may change."""

from typing import NamedTuple

from anticipators.parameters import within
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Counted, Predictions

_SLOWEST, _FASTEST = 10.0, 400.0


class _Change(NamedTuple):
    """A change of tempo: from a beat on, at a time, the distance of beats is ``period`` (s)."""

    beat: int
    time: GlobalTime
    period: float


class Metronome(Anticipator):
    """Its points are ``tickN``, N beats after its start, which is that of the realizer until it is restarted.

    A new tempo holds from the previous beat on: that beat and all earlier ones keep their times, and the next comes one
    new period later.

    Args:
        tempo: beats per minute, 10 to 400.

    Raises:
        RealizerError: the tempo is out of range.
    """

    kind = "metronome"
    events = ("tempo", "start")
    points = (Counted("tick"),)

    def __init__(self, context: AnticipatorContext, tempo: float = 60.0) -> None:
        super().__init__(context)
        self._changes = [_Change(0, GlobalTime(0.0), 60.0 / _checked(tempo))]

    @property
    def tempo(self) -> float:
        """Beats per minute."""
        return 60.0 / self._changes[-1].period

    async def predictions(self) -> Predictions:
        """The beats that behaviors refer to, after each ``tempo``, and after each ``start``, which makes now beat 0."""
        async for event in self.inputs:
            if event.name == "start":
                self._changes = [_Change(0, event.time, self._changes[-1].period)]
            else:
                self._change_tempo(60.0 / _checked(event.value), event.time)
            for beat in self.named:
                yield beat, self.forecast(beat)

    def forecast(self, point: str) -> GlobalTime:
        """The time of a beat."""
        return self._time(int(point.removeprefix("tick")))

    def check(self, name: str, value: float | None) -> None:
        """Check that a tempo is 10 to 400 beats per minute.

        Raises:
            RealizerError: "bad-number" or "unknown-event".
        """
        super().check(name, value)
        if name == "tempo":
            _checked(value)

    def _change_tempo(self, period: float, now: GlobalTime) -> None:
        change = self._changes[-1]
        if change.period == period:
            return
        if change.time > now:
            following = self._changes.pop().beat
        else:
            following = change.beat + int((now - change.time + RESOLUTION) / change.period) + 1
        # A beat that would have been due already in the new tempo comes now.
        time = max(GlobalTime(self._time(following - 1) + period), now)
        self._changes.append(_Change(following, time, period))

    def _time(self, beat: int) -> GlobalTime:
        change = next(change for change in reversed(self._changes) if change.beat <= beat)
        return GlobalTime(change.time + (beat - change.beat) * change.period)


def _checked(tempo: float | None) -> float:
    return within("tempo", tempo, _SLOWEST, _FASTEST)
