"""Feedback as data (BML 1.0, with the status of BMLA)."""

from collections.abc import Mapping
from dataclasses import dataclass, field

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
class SyncPointProgress:
    """A behavior reached a sync point; ``details`` are attributes in the realizer's own namespace."""

    character: str
    block: str
    behavior: str
    sync: str
    block_time: BlockTime
    time: GlobalTime
    details: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class BehaviorPrediction:
    """When the sync points of a behavior are predicted to be; unknown ones are not among them."""

    behavior: Behavior
    times: Mapping[str, BlockTime]


@dataclass(frozen=True, slots=True)
class PredictionFeedback:
    """When a block is predicted to start and end, and its behaviors once it is scheduled."""

    character: str
    block: str
    start: GlobalTime
    end: GlobalTime
    status: str
    behaviors: tuple[BehaviorPrediction, ...] = ()


@dataclass(frozen=True, slots=True)
class WarningFeedback:
    """Something could not be as it was asked for.

    Attributes:
        character: whose, None where no block could be read.
        id: ``block``, ``block:behavior`` or ``bml``.
    """

    character: str | None
    id: str
    type: WarningType
    text: str


Message = BlockProgress | SyncPointProgress | PredictionFeedback | WarningFeedback
