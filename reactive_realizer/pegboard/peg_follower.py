"""An observer of pegs that is given other pegs now and then."""

from collections.abc import Iterable

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Observer


class PegFollower(Observer):
    """Observes the pegs that it follows."""

    __slots__ = ("_pegs",)

    def __init__(self) -> None:
        self._pegs: dict[TimeCell, None] = {}

    def follow(self, pegs: Iterable[TimeCell]) -> None:
        """Observe these pegs, and no others any more."""
        old, new = self._pegs, dict.fromkeys(pegs)
        self._pegs = new
        for peg in new:
            if peg not in old:
                peg.attach(self)
        for peg in old:
            if peg not in new:
                peg.detach(self)
