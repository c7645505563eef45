"""A peg as seen from outside."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass

from reactive_realizer.clock.units import Time
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg, kind_of, state_of, time_of
from reactive_realizer.reactive.commit import Stamp


@dataclass(frozen=True, slots=True)
class PegView:
    """Everything about a peg at one moment, as data.

    Attributes:
        key: name of the point.
        kind: offset, ratio, after, before, latest, block, predicted.
        time: global time, s; None while unknown.
        state: ``pinned``, ``moving`` or ``unknown``.
        source: what it hangs on and how, for people; once pinned, what it hung on.
        ties: names of the pegs it hangs on; once pinned, hung on.
        parameters: the numbers by which it does: ``offset``, ``ratio``, ``bounds``, ``floor``.
        why: text of the constraint that made it, None if none did.
        owner: the block it was first named for.
        commit: what gave it its time; None if it has had it since it was made outside of a transaction.
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
    """A peg now, under one of its names."""
    time, state, kind = time_of(peg), state_of(peg), kind_of(peg)
    if not isinstance(peg, TimePeg):
        return PegView(key, kind, time, state, "predicted", (), {}, None, owner, peg.stamp)
    ties = tuple(link.name for link in peg.links)
    return PegView(key, kind, time, state, peg.describe(), ties, peg.parameters, peg.why, owner, peg.stamp)
