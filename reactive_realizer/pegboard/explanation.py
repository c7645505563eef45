"""Why a point is when it is: the pegs, constraints and commits that set its time."""

from dataclasses import asdict, dataclass

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.time_peg import Link, TimeCell, TimePeg, kind_of, state_of, time_of
from reactive_realizer.reactive.commit import Stamp

_DEEPEST = 64
"""A chain of blocks appended to each other may be of any length, a document may not be nested so deeply."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """Of one peg, and in turn of those that set its time.

    A peg on several others (the latest of them, a clamped one) is set by the one that is reached: only that one is
    followed, or those that are unknown where the peg is. A peg that was met before is not followed again, and neither
    is what lies very far back: then its rule ends with three dots.

    Attributes:
        name: of the peg, as in BML.
        kind: of the peg: offset, ratio, after, before, latest, block, predicted.
        time: s, global; of a source of a pinned peg: when that was pinned; None while unknown.
        state: ``pinned``, ``moving``, ``unknown``; ``past`` for what a pinned peg hung on and what has moved since.
        rule: how its time follows from others, for people.
        tie: text of the constraint that made it, None if none did.
        commit: what gave it this time; None if it has had it since it was made outside of a transaction.
        sources: the pegs that set it.
    """

    name: str
    kind: str
    time: Time
    state: str
    rule: str
    tie: str | None
    commit: Stamp | None
    sources: tuple["Explanation", ...]

    def as_json(self) -> dict[str, object]:
        """As objects that `json.dumps` takes; the names are those of the attributes."""
        return {
            "name": self.name,
            "kind": self.kind,
            "time": self.time,
            "state": self.state,
            "rule": self.rule,
            "tie": self.tie,
            "commit": None if self.commit is None else asdict(self.commit),
            "sources": [source.as_json() for source in self.sources],
        }


def explain(peg: TimeCell) -> Explanation:
    """The chain that set the time of a peg."""
    return _explain(peg, set(), _DEEPEST)


def _explain(peg: TimeCell, told: set[TimeCell], depth: int) -> Explanation:
    sources: tuple[Explanation, ...] = ()
    rule, tie = "predicted", None
    if isinstance(peg, TimePeg):
        rule, tie = peg.describe(), peg.why
        if peg in told or depth == 0:
            rule += " ..."
        else:
            told.add(peg)
            sources = tuple(_follow(link, told, depth - 1) for link in peg.deciding)
    return Explanation(peg.name, kind_of(peg), time_of(peg), state_of(peg), rule, tie, peg.stamp, sources)


def _follow(link: Link, told: set[TimeCell], depth: int) -> Explanation:
    peg = link.peg()
    if peg is not None and peg.stamp == link.stamp and time_of(peg) == link.time:
        return _explain(peg, told, depth)
    return Explanation(link.name, link.kind, link.time, "past", "has moved since, or is gone", None, link.stamp, ())
