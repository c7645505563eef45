"""Read-only views of pegs: kind, time, dependencies and dependents, and explanations of times."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.block_pegs import LatestPeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.time_peg import Link, TimeCell, TimePeg, kind_of, state_of, time_of
from reactive_realizer.reactive.graph import Stamp

_DEEPEST = 64
"""Depth limit of an explanation: a chain of appended blocks can have any length, but JSON readers limit the nesting."""


@dataclass(frozen=True, slots=True)
class PegView:
    """Everything about a peg at one moment, as data.

    Attributes:
        key: name of the point.
        kind: offset, ratio, after, before, late, latest, block, predicted.
        time: global time, s; None while unknown.
        state: ``pinned``, ``moving`` or ``unknown``.
        source: the rule by which its time follows from others, for people.
        ties: names of the pegs that it depends on; once pinned, of those that it was cut from.
        parameters: the numbers of the rule: ``offset``, ``ratio``, ``bounds``, ``floor``.
        why: text of the constraint that it was made for; None if there is none.
        owner: the block it was first named for.
        commit: the commit that gave it its time; None if it was created with it, outside of a transaction.
    """

    key: PegKey
    kind: str
    time: Time
    state: str
    source: str
    ties: tuple[str, ...]
    parameters: Mapping[str, object]
    why: str | None
    owner: BlockKey | None
    commit: Stamp | None

    def as_json(self) -> dict[str, object]:
        """As objects that `json.dumps` takes; the names are those of the attributes, and ``name`` the key in BML."""
        return {
            "name": str(self.key),
            "key": self.key._asdict(),
            "kind": self.kind,
            "time": self.time,
            "state": self.state,
            "source": self.source,
            "ties": list(self.ties),
            "parameters": dict(self.parameters),
            "why": self.why,
            "owner": None if self.owner is None else self.owner._asdict(),
            "commit": None if self.commit is None else asdict(self.commit),
        }


def view_of(key: PegKey, peg: TimeCell, owner: BlockKey | None) -> PegView:
    """The present view of a peg, under one of its names."""
    time, state, kind = time_of(peg), state_of(peg), kind_of(peg)
    if not isinstance(peg, TimePeg):
        return PegView(key, kind, time, state, "predicted", (), {}, None, owner, peg.stamp)
    ties = tuple(link.name for link in peg.links)
    return PegView(key, kind, time, state, peg.describe(), ties, peg.parameters, peg.why, owner, peg.stamp)


@dataclass(frozen=True, slots=True)
class Explanation:
    """The explanation of the time of a peg, with those of the pegs that determined it.

    If a peg depends on several others, only the one that determines its time is followed; if its time is unknown, those
    that are unknown. The rule of a peg that is not followed, because it was explained before or is too deep, ends with
    three dots.

    Attributes:
        name: of the peg, as in BML.
        kind: of the peg: offset, ratio, after, before, latest, block, predicted.
        time: s, global, None while unknown; for a source of a pinned peg, the time when that was pinned.
        state: ``pinned``, ``moving``, ``unknown``; ``past`` for a source of a pinned peg that has moved since.
        rule: the rule by which its time follows from others, for people.
        tie: text of the constraint that it was made for; None if there is none.
        commit: the commit that gave it this time; None if it was created with it, outside of a transaction.
        sources: explanations of the pegs that determined it.
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
    """The explanation of the time of a peg."""
    return _explain(peg, set(), _DEEPEST)


def _explain(peg: TimeCell, explained: set[TimeCell], depth: int) -> Explanation:
    sources: tuple[Explanation, ...] = ()
    rule, tie = "predicted", None
    if isinstance(peg, TimePeg):
        rule, tie = peg.describe(), peg.why
        if peg in explained or depth == 0:
            rule += " ..."
        else:
            explained.add(peg)
            sources = tuple(_follow(link, explained, depth - 1) for link in peg.deciding)
    return Explanation(peg.name, kind_of(peg), time_of(peg), state_of(peg), rule, tie, peg.stamp, sources)


def _follow(link: Link, explained: set[TimeCell], depth: int) -> Explanation:
    peg = link.peg()
    if peg is not None and peg.stamp == link.stamp and time_of(peg) == link.time:
        return _explain(peg, explained, depth)
    return Explanation(
        link.name, link.kind, link.time, "past", "has moved since, or no longer exists", None, link.stamp, ()
    )


def followers_of(peg: TimeCell) -> set[TimeCell]:
    """The pegs that move with a peg, except the starts and ends of blocks and what depends on these alone."""
    followers: set[TimeCell] = set()
    waiting = [peg]
    while waiting:
        for cell in waiting.pop().dependents:
            if cell not in followers and not isinstance(cell, LatestPeg):
                followers.add(cell)
                waiting.append(cell)
    return followers


def unknown_sources(pegs: Iterable[TimeCell]) -> list[str]:
    """Names of the unknown points without a formula that some pegs depend on."""
    seen: dict[TimeCell, None] = dict.fromkeys(pegs)
    waiting = list(seen)
    while waiting:
        for cell in waiting.pop().dependencies:
            if cell not in seen:
                seen[cell] = None
                waiting.append(cell)
    return [cell.name for cell in seen if cell.value is None and not cell.dependencies]
