"""What the scheduler has to tell, as feedback in its place."""

from collections.abc import Iterable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.engine.effects import Reached
from reactive_realizer.errors import Fault
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BlockProgress, SyncPointProgress, WarningFeedback
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Loss

_BEFORE_ALL, _AFTER_ALL = -1.0, float("inf")
_SUBSIDING, _ENDING = 0, 1


class Reporter:
    """Makes messages of what happens to blocks and behaviors."""

    def __init__(self, feedback: FeedbackManager, blocks: Blocks) -> None:
        self._feedback = feedback
        self._blocks = blocks

    def started(self, block: BMLBlock, time: GlobalTime) -> None:
        """A block started, before anything in it."""
        self._progress(block, "start", time, _BEFORE_ALL)

    def subsided(self, block: BMLBlock, time: GlobalTime) -> None:
        """Nothing of a block is ahead but ways back to rest."""
        self._progress(block, "relax", time, _AFTER_ALL, _SUBSIDING)

    def ended(self, block: BMLBlock, time: GlobalTime) -> None:
        """A block ended, after everything in it."""
        self._progress(block, "end", time, _AFTER_ALL, _ENDING)

    def reached(self, reached: Reached) -> None:
        """A behavior reached a sync point."""
        unit, time = reached.unit, reached.time
        block = self._blocks.get(unit.block)
        if block is None or block.start.value is None:
            return
        local = BlockTime(time - block.start.value)
        message = SyncPointProgress(*unit.block, unit.behavior.id, reached.point.id, local, time, reached.details)
        order = unit.timing.points.index(reached.point.id)
        # A point that passed before its block started is told after that start.
        place = block.place(max(time, block.start.value), unit.behavior.order, order)
        self._feedback.progress(message, place)

    def unawaited(self, block: BMLBlock) -> None:
        """A block started beside others that it came after, because what is left of these has no end."""
        place = block.description.location
        for other in {wait.target for wait in block.waits if wait.target.lasting}:
            names = ", ".join(unit.behavior.id for unit in other.live_units)
            fault = Fault("not-awaited", {"block": other.key.block, "behaviors": names})
            self.warn(block.key.character, block.key.block, fault.located(place.line, place.column))

    def lost(self, block: BMLBlock, losses: Iterable[Loss]) -> None:
        """Something of a block could not be planned."""
        for loss in losses:
            self.warn(block.key.character, ":".join(filter(None, (block.key.block, loss.behavior))), loss.fault)

    def meaningless(self, block: BMLBlock, extensions: Iterable[tuple[str, str]], at: BehaviorBlock | Behavior) -> None:
        """Attributes of other namespaces that nobody here understands."""
        id_ = block.key.block if isinstance(at, BehaviorBlock) else f"{block.key.block}:{at.id}"
        for namespace, name in extensions:
            details = {"attribute": name, "namespace": namespace}
            fault = Fault("foreign-attribute", details, at.location.line, at.location.column)
            self.warn(block.key.character, id_, fault)

    def unheard(self, block: BMLBlock, behavior: Behavior) -> None:
        """Parameters of a behavior whose engine reads none."""
        names = ", ".join(sorted(behavior.parameters))
        place = behavior.location
        details = {"names": names, "element": behavior.name, "known": "none"}
        fault = Fault("unknown-parameter", details, place.line, place.column)
        self.warn(block.key.character, f"{block.key.block}:{behavior.id}", fault)

    def passed_over(self, block: BMLBlock, behavior: Behavior, fault: Fault) -> None:
        """A description of a behavior cannot be made; another form of it is played."""
        place = behavior.location
        told = Fault("description-left-out", {"reason": fault.sentence}, place.line, place.column)
        self.warn(block.key.character, f"{block.key.block}:{behavior.id}", told)

    def warn_of(self, unit: PlanUnit, fault: Fault) -> None:
        """Something is wrong with a behavior; its place in the document is told."""
        located = fault.located(unit.behavior.location.line, unit.behavior.location.column)
        self.warn(unit.block.character, f"{unit.block.block}:{unit.behavior.id}", located)

    def warn(self, character: str, id_: str, fault: Fault) -> None:
        """Something is wrong; of an unreadable block nobody knows whose it was."""
        if fault.kind.warning is not None:
            known = None if id_ == BLOCK else character
            self._feedback.say(WarningFeedback(known, id_, fault.kind.warning, str(fault)))

    def _progress(self, block: BMLBlock, sync: str, time: GlobalTime, behavior: float, order: int = 0) -> None:
        message = BlockProgress(*block.key, sync, time, block.state.value)
        self._feedback.progress(message, block.place(time, behavior, order))
