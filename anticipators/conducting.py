"""Predicts the beats of music (thesis 8.1.2, 8.5.1 and example 31), from taps or from onsets of its sound."""

from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Counted, Predictions

_SHORTEST, _LONGEST = 0.2, 3.0


class Conducting(Anticipator):
    """Its points are ``beatN``: the Nth beat after the first one heard. A `Rhythm` predicts the next ones.

    It assumes one tap or onset per beat, reported at once, at 20 to 300 beats per minute, and a tempo that drifts but
    does not jump. The tempo is known from the second beat on. A missed beat is counted, a doubled one counts once, and
    notes between beats are ignored. When the music stops, ``ahead`` more beats are predicted, and the next one heard
    continues the count in the last tempo.

    Args:
        phase: share of the error of a beat that the next one corrects.
        period: share of the error by which the tempo changes.
        ahead: number of beats predicted after the last one heard.

    Raises:
        RealizerError: a parameter is out of range.
    """

    kind = "conducting"
    events = ("beat", "start")
    points = (Counted("beat"),)

    def __init__(self, context: AnticipatorContext, phase: float = 0.5, period: float = 0.2, ahead: float = 16) -> None:
        super().__init__(context)
        self._rhythm = Rhythm(phase, period, ahead, _SHORTEST, _LONGEST)

    async def predictions(self) -> Predictions:
        """The beats that behaviors refer to, after each ``beat``; after ``start``, the next one heard is the first."""
        async for event in self.inputs:
            if event.name == "start":
                self._rhythm.restart()
            elif not self._rhythm.hear(event.time, event.time):
                continue
            for beat in self.named:
                yield beat, self.forecast(beat)

    def forecast(self, point: str) -> Time:
        """The time of a beat."""
        return self._rhythm.time(int(point.removeprefix("beat")))
