"""The plans of blocks: the first one, and others when a block is activated or starts, or a behavior is timed anew."""

from collections.abc import Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.block_state import BlockEvent, BlockState
from reactive_realizer.scheduler.block_transitions import BlockTransitions
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.plan import Plan
from reactive_realizer.scheduler.planning import Planning
from reactive_realizer.scheduler.solution import Loss
from reactive_realizer.scheduler.tie_release import DroppedTie, TieRelease
from reactive_realizer.scheduler.unit_lifecycle import UnitLifecycle


class BlockPlans:
    """Gives blocks their plans for `BlockLifecycle`, and fails those that lose something required."""

    def __init__(
        self,
        board: PegBoard,
        routing: EngineRouting,
        blocks: Blocks,
        planner: BlockPlanner,
        planning: Planning,
        feedback: BlockFeedback,
        units: UnitLifecycle,
        ties: TieRelease,
        transitions: BlockTransitions,
    ) -> None:
        self._board = board
        self._routing = routing
        self._blocks = blocks
        self._planner = planner
        self._planning = planning
        self._feedback = feedback
        self._units = units
        self._ties = ties
        self._transitions = transitions

    def take(self, block: BMLBlock, outcome: Plan | Loss, now: GlobalTime, floor: GlobalTime) -> None:
        """Commit the plan of a block, or fail the block if something required is lost.

        Args:
            block: in preparation.
            outcome: of its planning.
            now: the time of the tick.
            floor: time before which the block does not start.
        """
        if isinstance(outcome, Loss):
            self.fails_by(block, [outcome], now)
        else:
            self._commit(block, outcome, now, floor)
        self._planner.leave(block)

    def _commit(self, block: BMLBlock, plan: Plan, now: GlobalTime, floor: GlobalTime) -> None:
        if self._fails_by_plan(block, plan, now):
            return
        with self._board.graph.transaction(f"plan {block.key.block}"):
            holds = self._planning.lay_out(block, plan)
            block.set_plan(floor, plan.units, plan.times, plan.kept, plan.bounds, holds)
        self._blocks.watch.follow(block)
        preparation = self._planner.preparation(block)
        for unit in plan.units:
            self._routing.assign(unit, preparation.engine_of(unit))
        self._transitions.take(block, BlockEvent.PREPLAN if block.awaits_activation else BlockEvent.PLAN, now)

    def wait_for_next(self, block: BMLBlock, renewed: Mapping[TimeCell, TimeCell], now: GlobalTime) -> None:
        """Plan a block again that was activated, if points that it names had passed: it waits for the next ones."""
        if not renewed or block.state is not BlockState.LURKING:
            return
        with self._board.graph.transaction(f"wait for the next of {block.key.block}"):
            block.rename_pegs(renewed)
        self.renew(block, f"plan {block.key.block} again", now)

    def renew(self, block: BMLBlock, cause: str, now: GlobalTime) -> None:
        """Plan a block that waits again, from the constraints of its present plan."""
        plan = self._planning.again(block, now)
        if not self._fails_by_plan(block, plan, now):
            with self._board.graph.transaction(cause):
                self.replace(block, plan, now)

    def at_start(self, block: BMLBlock, time: GlobalTime, now: GlobalTime) -> Plan | None:
        """The plan with which a block starts; None if that is the present one, or the block fails by the new one.

        Args:
            block: that is about to start.
            time: of its start, s.
            now: the time of the tick.
        """
        plan = self._planning.at_start(block, time, now)
        return None if plan is None or self._fails_by_plan(block, plan, time) else plan

    def replace(self, block: BMLBlock, plan: Plan, now: GlobalTime) -> None:
        """Within a transaction, give a block another plan, without the behaviors that this one loses."""
        lost = [unit for unit in block.units if unit not in plan.units]
        missed = self._ties.missed_by_drop(lost)
        holds, replaced = self._planning.replace(block, plan)
        for other in self._blocks.watch.following(replaced):
            other.rename_pegs(replaced)
            self._blocks.watch.follow(other)
        self._planner.rename_pegs(replaced)
        block.set_plan(block.end.floor, plan.units, plan.times, plan.kept, plan.bounds, holds)
        self._blocks.watch.follow(block)
        self._units.remove(lost, now)
        block.dropped |= {unit.behavior.id for unit in lost}
        if missed:
            self._ties.release(block, missed, DroppedTie, now)

    def fails_by(self, block: BMLBlock, losses: Sequence[Loss], now: GlobalTime) -> bool:
        """Warn of losses; whether the block fails by them."""
        self._feedback.losses(block.key, losses)
        fails = any(loss.required for loss in losses)
        if fails:
            self._transitions.end(block, BlockEvent.FAIL, now)
        return fails

    def _fails_by_plan(self, block: BMLBlock, plan: Plan, now: GlobalTime) -> bool:
        """Warn of the losses of a plan, and once of each behavior beyond its limits; whether the block fails by it."""
        beyond = [loss for loss in plan.beyond_limits if loss.behavior not in block.beyond_limits]
        block.beyond_limits.update(loss.behavior for loss in beyond if loss.behavior is not None)
        return self.fails_by(block, (*plan.losses, *beyond), now)
