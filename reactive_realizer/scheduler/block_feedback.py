"""Feedback about blocks and behaviors: progress in its order within the tick, and warnings."""

from collections.abc import Iterable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.faults import ForeignAttribute
from reactive_realizer.bml.names import BLOCK, Location
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.engine.effects import Reached
from reactive_realizer.engine.faults import UnknownParameter
from reactive_realizer.errors import Fault
from reactive_realizer.feedback.feedback_manager import FeedbackManager, ProgressOrder
from reactive_realizer.feedback.messages import BlockProgress, SyncPointProgress, WarningFeedback
from reactive_realizer.feedback.xml import as_reported
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.faults import DescriptionLeftOut, NotAwaited
from reactive_realizer.scheduler.problem import Loss

_BEFORE_BEHAVIORS, _AFTER_BEHAVIORS = -1.0, float("inf")
_BLOCK_ORDER = {"start": (_BEFORE_BEHAVIORS, 0), "relax": (_AFTER_BEHAVIORS, 0), "end": (_AFTER_BEHAVIORS, 1)}


class BlockFeedback:
    """Makes the messages about blocks and behaviors. Every sync point that is reported passes `sync_point_reached`."""

    def __init__(self, feedback: FeedbackManager, blocks: Blocks) -> None:
        self._feedback = feedback
        self._blocks = blocks

    # --- progress

    def block_progress(self, block: BMLBlock, sync: str, time: GlobalTime) -> None:
        """Report that a block reached its ``start``, ``relax`` or ``end``."""
        message = BlockProgress(*block.key, sync, time, block.state.value)
        self._feedback.add_progress(message, _order(block, time, *_BLOCK_ORDER[sync]))

    def sync_point_reached(self, reached: Reached) -> None:
        """Report that a behavior reached a sync point."""
        unit, time = reached.unit, reached.time
        block = self._blocks.get(unit.block)
        if block is None or block.start.value is None:
            return
        local = BlockTime(time - block.start.value)
        message = SyncPointProgress(*unit.block, unit.behavior.id, reached.point.id, local, time, reached.details)
        sync = unit.timing.points.index(reached.point.id)
        # A point that passed before its block started is reported after that start.
        order = _order(block, max(time, block.start.value), unit.behavior.order, sync)
        self._feedback.add_progress(message, order)

    # --- warnings

    def not_awaited(self, block: BMLBlock) -> None:
        """Warn that a block started beside predecessors of which only behaviors without an end are left."""
        for other in dict.fromkeys(each.block for each in block.predecessors if each.block.only_persists):
            names = ", ".join(unit.behavior.id for unit in other.live_units)
            fault = NotAwaited(block=other.key.block, behaviors=names)
            self.warn_block(block, fault)

    def losses(self, block: BMLBlock, losses: Iterable[Loss]) -> None:
        """Warn of what could not be planned."""
        for loss in losses:
            self.warn(block.key.character, ":".join(filter(None, (block.key.block, loss.behavior))), loss.fault)

    def unknown_attributes(
        self, block: BMLBlock, names: Iterable[tuple[str, str]], at: BehaviorBlock | Behavior
    ) -> None:
        """Warn of attributes of other namespaces that no engine reads."""
        id_ = block.key.block if isinstance(at, BehaviorBlock) else f"{block.key.block}:{at.id}"
        for namespace, name in names:
            fault = ForeignAttribute(attribute=name, namespace=namespace)
            self.warn(block.key.character, id_, fault, at.location)

    def unread_parameters(self, block: BMLBlock, behavior: Behavior) -> None:
        """Warn of the parameters of a behavior whose engine reads none."""
        names = ", ".join(sorted(behavior.parameters))
        fault = UnknownParameter(names=names, element=behavior.name, known="none")
        self.warn(block.key.character, f"{block.key.block}:{behavior.id}", fault, behavior.location)

    def description_left_out(self, block: BMLBlock, behavior: Behavior, fault: Fault) -> None:
        """Warn that a description cannot be made and another form of the behavior is played."""
        left_out = DescriptionLeftOut(reason=fault.sentence)
        self.warn(block.key.character, f"{block.key.block}:{behavior.id}", left_out, behavior.location)

    def warn_behavior(self, unit: PlanUnit, fault: Fault) -> None:
        """Warn of a behavior, with its place in the document."""
        self.warn(unit.block.character, f"{unit.block.block}:{unit.behavior.id}", fault, unit.behavior.location)

    def warn_block(self, block: BMLBlock, fault: Fault) -> None:
        """Warn of a block, with its place in the document."""
        self.warn(block.key.character, block.key.block, fault, block.description.location)

    def warn(self, character: str, id_: str, fault: Fault, location: Location | None = None) -> None:
        """Warn, if the fault is one that a planner is warned of; an unreadable block has no known character."""
        if fault.warning is not None:
            known = None if id_ == BLOCK else character
            located = fault if location is None else fault.located(location.line, location.column)
            self._feedback.add(WarningFeedback(known, id_, fault.warning, str(located)))


def _order(block: BMLBlock, time: GlobalTime, behavior: float, sync: int) -> ProgressOrder:
    """The order of progress within a tick.

    A block that is revoked before its predicted start counts as one that started when it ended. Times that are equal as
    reported are equal here too: what differs by rounding must not come before its cause.
    """
    start = time if block.start.value is None else min(block.start.value, time)
    return ProgressOrder(as_reported(time), as_reported(start), block.arrival, behavior, sync)
