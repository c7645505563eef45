"""The beats of a music that is played (thesis 8.1.2, 8.5.1 and example 31), from taps or from onsets of its sound."""

import re

from anticipators.rhythm import Rhythm
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard

_BEAT = re.compile(r"beat([0-9]{1,9})")
_SHORTEST, _LONGEST = 0.2, 3.0


class Conducting(Anticipator):
    """Points ``beatN``: the Nth beat, counted from the first that is heard; the next ones are expected by a `Rhythm`.

    It assumes one tap, or one onset, a beat, of 20 to 300 beats a minute, told at once, and equal beats whose tempo
    drifts rather than jumps. From the second beat on the tempo is known. A beat that is missed comes nevertheless, one
    that is doubled counts once, and notes between two beats are no beats. When the music stops, so many beats still
    come as are predicted ahead, and the next one heard takes the count up again in the last tempo.

    Args:
        phase: how much of the distance between a beat and its prediction the next one makes good.
        period: how much of it the tempo follows.
        ahead: how many beats are predicted after the last one heard.

    Raises:
        RealizerError: a parameter out of its range.
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
        """The time of a beat; other names are never known."""
        found = _BEAT.fullmatch(sync)
        return self._rhythm.time(int(found[1])) if found else None

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``beat``: one is heard, now; ``start``: the next one heard is the first."""
        if name == "beat" and self._rhythm.hear(now, now):
            self.revise(now)
        elif name == "start":
            self._rhythm.restart()
            self.withdraw(now)
