"""Feedback about blocks and behaviors: progress in its order within the tick, and warnings."""

from collections.abc import Container, Iterable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.faults import ForeignAttribute
from reactive_realizer.bml.names import BLOCK, Location
from reactive_realizer.bml.sync_ref import OWN_BLOCK_POINTS
from reactive_realizer.clock.units import BlockTime, GlobalTime, Time
from reactive_realizer.engine.effects import Reached
from reactive_realizer.engine.faults import UnknownParameter
from reactive_realizer.errors import Fault, PlayingFault, SchedulingFault, WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager, ProgressOrder
from reactive_realizer.feedback.messages import (
    BlockProgress,
    EmittedEvent,
    FallFeedback,
    SyncPointProgress,
    WarningFeedback,
)
from reactive_realizer.feedback.xml import as_reported
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.solution import Loss

_tuple = tuple.__new__

_BEFORE_BEHAVIORS, _AFTER_BEHAVIORS = -1.0, float("inf")
_BLOCK_ORDER = {
    "start": (_BEFORE_BEHAVIORS, 0),
    **{sync: (_AFTER_BEHAVIORS, rank) for rank, sync in enumerate((*OWN_BLOCK_POINTS, "relax", "end"))},
}


_MINOR = (SchedulingFault, PlayingFault, UnknownParameter)
_NOT_PLAYED = (WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED, WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED)


class BlockFeedback:
    """Makes the messages about blocks and behaviors; every reported sync point passes `sync_point_reached`."""

    def __init__(self, feedback: FeedbackManager, blocks: Blocks) -> None:
        self._feedback = feedback
        self._blocks = blocks

    # --- progress

    def block_progress(self, block: BMLBlock, sync: str, time: GlobalTime) -> None:
        """Report that a block reached one of its sync points."""
        message = BlockProgress(*block.key, sync, time, block.state.value)
        self._feedback.add_progress(message, _order(block, block.start.value, time, *_BLOCK_ORDER[sync]))

    def sync_point_reached(self, reached: Reached) -> None:
        """Report that a behavior reached a sync point, unless it is one that nobody asked for."""
        unit, point, time = reached
        block = self._blocks.get(unit.block)
        start = None if block is None else block.start.value
        if block is None or start is None or point.id in unit.unreported:
            return
        emitted = reached.emits
        event = None if emitted is None else EmittedEvent(emitted.event, emitted.content)
        behavior, local = unit.behavior, BlockTime(time - start)
        # Equivalent to `SyncPointProgress(...)`, in half the time: this runs for every point that is reached.
        message = _tuple(SyncPointProgress, (*unit.block, behavior.id, point.id, local, time, point.details, event))
        sync = unit.timing.points.index(point.id)
        # A point that passed before its block started is reported after that start.
        self._feedback.add_progress(message, _order(block, start, max(time, start), behavior.order, sync))

    def fall(self, unit: PlanUnit, time: GlobalTime) -> None:
        """Report that the figure has fallen that a behavior moves by forces."""
        self._feedback.add(FallFeedback(*unit.block, unit.behavior.id, time))

    # --- warnings

    def losses(self, block: BlockKey, losses: Iterable[Loss]) -> None:
        """Warn of the parts of a block that could not be planned."""
        for loss in losses:
            self.warn(block.character, ":".join(filter(None, (block.block, loss.behavior))), loss.fault)

    def foreign_attributes(
        self, block: BlockKey, element: BehaviorBlock | Behavior, known: Container[tuple[str, str]] = ()
    ) -> None:
        """Warn of the attributes of other namespaces that are not known."""
        for fault in ForeignAttribute.of(name for name in element.extensions if name not in known):
            self.warn_element(block, element, fault)

    def warn_behavior(self, unit: PlanUnit, fault: Fault) -> None:
        """Warn of a behavior in a plan, with its place in the document."""
        self.warn_element(unit.block, unit.behavior, fault)

    def warn_element(self, block: BlockKey, element: BehaviorBlock | Behavior, fault: Fault) -> None:
        """Warn of a block or a behavior of it, with its place in the document."""
        id_ = block.block if isinstance(element, BehaviorBlock) else f"{block.block}:{element.id}"
        self.warn(block.character, id_, fault, element.location)

    def warn(self, character: str, id_: str, fault: Fault, location: Location | None = None) -> None:
        """Warn, if planners are warned of this fault; a block that cannot be read has no known character.

        That a behavior which accompanies others gives way, or cannot do its part, is no problem of a planner.
        """
        minor = isinstance(fault, _MINOR) or fault.warning in _NOT_PLAYED
        gives_way = minor and self._gives_way(character, id_)
        if fault.warning is not None and not gives_way:
            known = None if id_ == BLOCK else character
            located = fault if location is None else fault.located(location.line, location.column)
            self._feedback.add(WarningFeedback(known, id_, fault.warning, str(located)))

    def _gives_way(self, character: str, id_: str) -> bool:
        """Whether a block, or the block of a behavior, gives way to others."""
        block = self._blocks.get(BlockKey(character, id_.partition(":")[0]))
        return block is not None and block.gives_way


def _order(block: BMLBlock, start: Time, time: GlobalTime, behavior: float, sync: int) -> ProgressOrder:
    """The order of progress within a tick.

    A block that is revoked before its predicted start counts as one that started when it ended. Times that are reported
    as equal are equal here too, so that rounding does not put an effect before its cause.
    """
    reported = as_reported(time)
    block_start = reported if start is None or start >= time else as_reported(start)
    return ProgressOrder(reported, block_start, block.arrival, behavior, sync)
