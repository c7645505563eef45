"""The states of a block, and every transition between them as one table (thesis 7.3.4; BMLA status)."""

from dataclasses import dataclass
from enum import Enum


class BlockState(Enum):
    """The state of a block; the values are those of BMLA's status."""

    IN_PREP = "IN_PREP"
    PENDING = "PENDING"
    """Planned, and not to start before it is activated (BMLA preplan)."""
    LURKING = "LURKING"
    IN_EXEC = "IN_EXEC"
    SUBSIDING = "SUBSIDING"
    DONE = "DONE"
    INTERRUPTED = "INTERRUPTED"
    REVOKED = "REVOKED"
    FAILED = "FAILED"

    @property
    def plays(self) -> bool:
        """Whether the block has started and not ended."""
        return self in (BlockState.IN_EXEC, BlockState.SUBSIDING)

    @property
    def ended(self) -> bool:
        """Whether nothing of the block is ahead."""
        return self in (BlockState.DONE, BlockState.INTERRUPTED, BlockState.REVOKED, BlockState.FAILED)


class BlockEvent(Enum):
    """Something that takes a block from one state to another."""

    PLAN = "plan"
    PREPLAN = "preplan"
    ACTIVATE = "activate"
    START = "start"
    SUBSIDE = "subside"
    FINISH = "finish"
    INTERRUPT = "interrupt"
    REVOKE = "revoke"
    FAIL = "fail"


@dataclass(frozen=True, slots=True)
class BlockTransition:
    """One row of the table.

    Attributes:
        sources: the states in which the event is legal.
        event: that leads to the target.
        target: the state after it.
        writes: other writes than the state and the pins, in words.
        pins: the points of the block whose times become final, in order.
        reports: the feedback: sync points of ``blockProgress``, and ``predictionFeedback`` at the end of the tick.
    """

    sources: tuple[BlockState, ...]
    event: BlockEvent
    target: BlockState
    writes: str = ""
    pins: tuple[str, ...] = ()
    reports: tuple[str, ...] = ()


REMAINING = "remaining"
"""In `BlockTransition.pins`: every point that is not pinned yet, at its last predicted time."""

PREDICTION = "prediction"
"""In `BlockTransition.reports`: ``predictionFeedback``."""

_WAITING = (BlockState.IN_PREP, BlockState.PENDING, BlockState.LURKING)
_PLAYING = (BlockState.IN_EXEC, BlockState.SUBSIDING)
_PLAN = "behaviors, their points, what `start` waits for"
_ACTIVATION = "activation; a new plan, if points from outside have passed"
_END = "leaves the board and the engines"


def _end(sources: tuple[BlockState, ...], event: BlockEvent, target: BlockState) -> BlockTransition:
    return BlockTransition(sources, event, target, _END, pins=("end", "relax", REMAINING), reports=("end",))


TRANSITIONS = (
    BlockTransition((BlockState.IN_PREP,), BlockEvent.PLAN, BlockState.LURKING, _PLAN, reports=(PREDICTION,)),
    BlockTransition((BlockState.IN_PREP,), BlockEvent.PREPLAN, BlockState.PENDING, _PLAN, reports=(PREDICTION,)),
    BlockTransition((BlockState.IN_PREP,), BlockEvent.ACTIVATE, BlockState.IN_PREP, "activation"),
    BlockTransition((BlockState.PENDING,), BlockEvent.ACTIVATE, BlockState.LURKING, _ACTIVATION),
    BlockTransition(
        (BlockState.LURKING,),
        BlockEvent.START,
        BlockState.IN_EXEC,
        "behaviors may begin",
        pins=("start",),
        reports=("start", PREDICTION),
    ),
    BlockTransition(
        (BlockState.IN_EXEC,), BlockEvent.SUBSIDE, BlockState.SUBSIDING, pins=("relax",), reports=("relax",)
    ),
    _end(_PLAYING, BlockEvent.FINISH, BlockState.DONE),
    _end(_PLAYING, BlockEvent.INTERRUPT, BlockState.INTERRUPTED),
    _end(_WAITING, BlockEvent.REVOKE, BlockState.REVOKED),
    _end((*_WAITING, *_PLAYING), BlockEvent.FAIL, BlockState.FAILED),
)
"""All transitions. A block starts in IN_PREP; an ended one stays ended."""

_ROWS = {(source, row.event): row for row in TRANSITIONS for source in row.sources}


class IllegalTransitionError(Exception):
    """An event happened to a block in a state that has no such transition."""


def transition(state: BlockState, event: BlockEvent) -> BlockTransition:
    """The row of the table for an event in a state.

    Raises:
        IllegalTransitionError: the table has none.
    """
    try:
        return _ROWS[state, event]
    except KeyError:
        raise IllegalTransitionError(f"no transition from {state.value} by '{event.value}'") from None
