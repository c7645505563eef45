"""Predicts the beats that a user taps, so that a character can move with the user (thesis 12.3)."""

from itertools import pairwise

from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Predictions

_SHORTEST, _LONGEST = 0.2, 3.0


class Tap(Anticipator):
    """Its points are ``beat``, the next beat, and ``offbeat``, the next moment halfway between two beats.

    What depends on ``beat`` moves in phase with the user, and what depends on ``offbeat`` in antiphase. A `Rhythm`
    predicts the beats and adapts to the taps in phase and period, as people do. It assumes one tap per beat, reported
    at once, at 20 to 300 beats per minute. The beats are known from the second tap on, and for ``ahead`` beats after
    the last one.

    Args:
        phase: share of the error of a beat that the next one corrects.
        period: share of the error by which the period changes.
        ahead: number of beats predicted after the last tap.

    Raises:
        RealizerError: a parameter is out of range.
    """

    kind = "tap"
    events = ("tap", "start")
    points = ("beat", "offbeat")

    def __init__(self, context: AnticipatorContext, phase: float = 0.5, period: float = 0.2, ahead: float = 4) -> None:
        super().__init__(context)
        self._rhythm = Rhythm(phase, period, ahead, _SHORTEST, _LONGEST)

    async def predictions(self) -> Predictions:
        """The next beat and the next offbeat, after each ``tap`` and when one of them has passed."""
        offbeat: Time = None
        while True:
            coming = [time for time in (self._rhythm.coming, offbeat) if time is not None]
            event = await self.next_input(until=min(coming, default=None))
            now = self.clock.now()
            self._rhythm.advance(now)
            if event is not None and event.name == "tap":
                self._rhythm.hear(now, now)
            elif event is not None:
                self._rhythm.restart()
            offbeat = self._offbeat(now)
            yield "beat", self._rhythm.coming
            yield "offbeat", offbeat

    def _offbeat(self, now: GlobalTime) -> Time:
        """The next moment after ``now`` that is halfway between two beats; None while it is unknown."""
        number = self._rhythm.passed
        beats = [self._rhythm.time(beat) for beat in (number, number + 1, number + 2)]
        middles = [(a + b) / 2 for a, b in pairwise(beats) if a is not None and b is not None]
        return next((GlobalTime(middle) for middle in middles if middle > now + RESOLUTION), None)
