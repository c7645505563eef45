"""Predicts the beats of music (thesis 8.1.2, 8.5.1 and example 31), from taps or from onsets of its sound."""

import re

from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard

_BEAT = re.compile(r"beat([0-9]{1,9})")
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
    points = ("beatN",)

    def __init__(
        self,
        id: str,  # noqa: A002
        board: PegBoard,
        phase: float = 0.5,
        period: float = 0.2,
        ahead: float = 16,
    ) -> None:
        super().__init__(id, board)
        self._rhythm = Rhythm(phase, period, ahead, _SHORTEST, _LONGEST)

    def forecast(self, sync: str) -> Time:
        """The time of a beat; None for other names."""
        found = _BEAT.fullmatch(sync)
        return self._rhythm.time(int(found[1])) if found else None

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """Handle ``beat``, a beat heard now, and ``start``, which makes the next one heard the first."""
        if name == "beat" and self._rhythm.hear(now, now):
            self.revise(now)
        elif name == "start":
            self._rhythm.restart()
            self.withdraw(now)
