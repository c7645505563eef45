"""Ties between sync points that are written apart from the behaviors."""

from dataclasses import dataclass
from enum import StrEnum

from reactive_realizer.bml.names import Location
from reactive_realizer.bml.sync_ref import SyncRef


class OrderKind(StrEnum):
    """Where the listed points of an `Order` lie."""

    BEFORE = "before"
    AFTER = "after"


@dataclass(frozen=True, slots=True, kw_only=True)
class Synchronize:
    """All these points are one; an absolute one pins them.

    Attributes:
        id: of its constraint element, if it has one.
        refs: two or more.
        required: whether the block fails without it.
        location: of its start tag.
    """

    id: str | None
    refs: tuple[SyncRef, ...]
    required: bool
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """None of the listed points comes after (before) the one they are compared with.

    Attributes:
        kind: BEFORE: the listed points are not after `ref`; AFTER: not before it.
        id: of its constraint element, if it has one.
        ref: the point of comparison.
        refs: the listed points, one or more.
        required: whether the block fails without it.
        location: of its start tag.
    """

    kind: OrderKind
    id: str | None
    ref: SyncRef
    refs: tuple[SyncRef, ...]
    required: bool
    location: Location


Constraint = Synchronize | Order
"""What a block says apart from its behaviors."""
