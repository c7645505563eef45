"""Sync points of units."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import TimePeg


@dataclass(slots=True)
class SyncPoint:
    """A sync point of one unit.

    Attributes:
        id: the sync id.
        peg: its time; shared with the sync points it is tied to.
        tied: whether a BML constraint names it; otherwise its time follows from the preferences of its behavior.
        fired: whether it has been reported; its peg is pinned then.
        cut: whether it was reported because its behavior was cut short.
        details: attributes of its feedback, beside the time; noted when it fires.
    """

    id: str
    peg: TimePeg
    tied: bool = False
    fired: bool = False
    cut: bool = False
    details: Mapping[str, str] = field(default_factory=dict)


class Hurry(NamedTuple):
    """A point that was asked for earlier than its unit can reach it.

    Attributes:
        need: time that the unit needed from then on, s.
        room: time that it was given, s.
    """

    need: float
    room: float


class DuePoint(NamedTuple):
    """A sync point that is about to fire, and the time (s, global) to report."""

    point: SyncPoint
    time: GlobalTime
