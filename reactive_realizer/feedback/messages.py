"""Feedback as data (BML 1.0, with the status of BMLA, and falls)."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.errors import WarningType


@dataclass(frozen=True, slots=True)
class BlockProgress:
    """A block started or ended; ``status`` is its BMLA state after that."""

    character: str
    block: str
    sync: str
    time: GlobalTime
    status: str


@dataclass(frozen=True, slots=True)
class EmittedEvent:
    """An event for planners; its content is XML."""

    name: str
    content: str


class SyncPointProgress(NamedTuple):
    """A behavior reached a sync point.

    Attributes:
        details: attributes in the realizer's own namespace.
        event: that it emits.
    """

    character: str
    block: str
    behavior: str
    sync: str
    block_time: BlockTime
    time: GlobalTime
    details: Mapping[str, str] = MappingProxyType({})
    event: EmittedEvent | None = None


@dataclass(frozen=True, slots=True)
class BehaviorPrediction:
    """The predicted times of a behavior's sync points; those that are unknown are left out."""

    behavior: Behavior
    times: Mapping[str, BlockTime]


@dataclass(frozen=True, slots=True)
class PredictionFeedback:
    """The predicted start and end of a block, and the times of its behaviors once it is scheduled."""

    character: str
    block: str
    start: GlobalTime
    end: GlobalTime
    status: str
    behaviors: Collection[BehaviorPrediction] = ()


@dataclass(frozen=True, slots=True)
class WarningFeedback:
    """A part of a block that could not be realized as written.

    Attributes:
        character: of the block; None if no block could be read.
        id: ``block``, ``block:behavior`` or ``bml``.
    """

    character: str | None
    id: str
    type: WarningType
    text: str


@dataclass(frozen=True, slots=True)
class FallFeedback:
    """A figure fell while a behavior moved it by forces."""

    character: str
    block: str
    behavior: str
    time: GlobalTime


Feedback = BlockProgress | SyncPointProgress | PredictionFeedback | WarningFeedback | FallFeedback
