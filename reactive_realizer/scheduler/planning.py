"""Turns a prepared block into a scheduling problem, and its plan into pegs on the board."""

from collections import deque
from collections.abc import Callable, Generator, Iterable, Mapping
from dataclasses import replace
from itertools import islice
from typing import TypeVar

from reactive_realizer.clock.ticker import next_tick
from reactive_realizer.clock.units import GlobalTime, has_passed, is_due
from reactive_realizer.pegboard.block_pegs import LateTiePeg
from reactive_realizer.pegboard.open_pegs import OpenPeg
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OffsetPeg, TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import OPEN
from reactive_realizer.planunit.wait_unit import WaitUnit
from reactive_realizer.scheduler.block_problem import BlockProblem, item_of, pose, pose_again
from reactive_realizer.scheduler.block_solver import BlockSolver
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import ReferenceResolver, constraints_of
from reactive_realizer.scheduler.peg_layout.peg_layout import BuiltPegs
from reactive_realizer.scheduler.plan import Plan
from reactive_realizer.scheduler.problem import Item, SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution

_PEGS_AT_ONCE = 50
"""Pegs that are made in one step."""

_WORK_AT_ONCE = 50
"""Work of resolving references in one step: behaviors, if all references are valid."""

_NAMED_AT_ONCE = 100
"""Pegs that are named in one step; this takes half as long as making them."""

T = TypeVar("T")

PlanListener = Callable[[BMLBlock, SchedulingProblem, Solution], None]


class Planning:
    """Poses and solves the problems of blocks, and lays out their plans on the board."""

    def __init__(self, board: PegBoard, blocks: Blocks, solver: BlockSolver) -> None:
        self._board = board
        self._blocks = blocks
        self._solver = solver
        self._listeners: list[PlanListener] = []

    def listen(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` for each plan that is put on the board."""
        self._listeners.append(listener)

    def build_problem(
        self, block: BMLBlock, items: Mapping[PlanUnit, Item], losses: Iterable[Loss] = ()
    ) -> Generator[int, None, BlockProblem]:
        """The problem of a block that is ready to start, in steps; each gives the work that it took.

        The board stays as it is. The times from outside are those of the last step.

        Args:
            block: in preparation.
            items: its behaviors, with their preferences.
            losses: behaviors that were lost before.
        """
        for unit in items:
            self._open(unit)
        resolver = ReferenceResolver(block, {unit.behavior.id: unit for unit in items}, self._board, self._blocks)
        dropped = yield from _in_steps(resolver.drop_unplaceable())
        ties, orders, lost = yield from _in_steps(constraints_of(block.description, resolver))
        kept = {unit: items[unit] for unit in resolver.units.values()}
        posed = pose(block, kept, ties, orders, self._board.time, starts=False)
        awaited = {unit: resolver.locate(unit.until) for unit in kept if isinstance(unit, WaitUnit)}
        return replace(posed, losses=(*losses, *dropped, *lost, *posed.losses), awaited=awaited)

    def again(self, block: BMLBlock, now: GlobalTime) -> Plan:
        """A new plan of a block that waits, from the constraints of its present one."""
        return self._solver.solve(pose_again(block, {unit: item_of(unit) for unit in block.units}, now, starts=False))

    def at_start(self, block: BMLBlock, start: GlobalTime, now: GlobalTime) -> Plan | None:
        """A new plan of a block that starts at ``start``, with the preferences of its engines ``now`` (thesis 12.1.4).

        A chunk is planned again because gestures are prepared from the position of the hands. So is a block with points
        or ties before its start, because times from outside have moved: no point comes before its block.

        Returns:
            None if the present plan is still good, or the new plan of a chunk would lose anything.
        """
        late = any(has_passed(cell.value, start + least) for cell, (least, _) in block.bounds.items())
        early = late or has_passed(block.earliest_point, start)
        if not early and not any(each.chunk for each in block.predecessors):
            return None
        items = {unit: Item(unit.behavior, unit.preference(now).closed) for unit in block.units}
        plan = self._solver.solve(pose_again(block, items, start, starts=True))
        return plan if early or not plan.losses else None

    def make_pegs(self, block: BMLBlock, plan: Plan) -> Generator[int]:
        """Make the pegs of a plan, in steps that give the work that they took; none is on the board yet.

        If it is closed before the plan is put on the board, it disposes of them.
        """
        graph = self._board.graph
        outside = {} if self._starts(block, plan) else self._not_before(block, plan)
        steps = plan.layout.steps(graph, block.key.block, block.start, outside)
        try:
            while plan.built is None:
                with graph.transaction(f"plan {block.key.block}"):
                    *made, last = islice(steps, _PEGS_AT_ONCE)
                if last is not None:
                    plan.built = BuiltPegs(last.pegs, (*outside.values(), *last.unnamed))
                yield len(made)
            names = plan.name_pegs()
            while named := sum(1 for _ in islice(names, _NAMED_AT_ONCE)):
                yield named // 2
        except GeneratorExit:
            steps.close()
            for peg in outside.values():
                peg.dispose()
            plan.discard()
            raise

    def expect(self, block: BMLBlock) -> None:
        """Have the pegs of a block move that is put on the board in the next tick, and starts in the one after it.

        Otherwise, they would move in the tick in which they are put on the board.
        """
        with self._board.graph.transaction(f"expect {block.key.block}"):
            block.expect(next_tick(next_tick(self._board.time)))

    def lay_out(self, block: BMLBlock, plan: Plan) -> list[TimePeg]:
        """Within a transaction, put the pegs of a plan on the board; returns those that the block's start waits for."""
        self._board.add_block(block.key, self._build(block, plan))
        self._announce(block, plan)
        return self._hold(block, plan)

    def replace(self, block: BMLBlock, plan: Plan) -> tuple[list[TimePeg], dict[TimeCell, TimeCell]]:
        """Within a transaction, replace the plan on the board.

        Returns:
            The pegs that the block's start waits for, and the new pegs of points by the old ones.
        """
        replaced: dict[TimeCell, TimeCell] = {}
        for key, peg in self._build(block, plan).items():
            if (old := self._board.get(key)) is peg:
                continue
            if old is not None:
                replaced[old] = peg
            self._board.replace(key, peg)
        self._announce(block, plan)
        return self._hold(block, plan), replaced

    def _hold(self, block: BMLBlock, plan: Plan) -> list[TimePeg]:
        """The pegs for the bounds on the start of a block."""
        name, bounds = f"{block.key.block}:start as constrained", plan.posed.holds.values()
        holds: list[TimePeg] = [OffsetPeg(self._board.graph, name, cell, offset) for cell, offset in bounds]
        self._board.add_unnamed(block.key, holds)
        return holds

    def _starts(self, block: BMLBlock, plan: Plan) -> bool:
        """Whether a block has started, or starts in this tick."""
        return block.state.plays or (not plan.posed.holds and is_due(block.start.value, self._board.time))

    def _not_before(self, block: BMLBlock, plan: Plan) -> dict[TimeCell, TimePeg]:
        """Pegs for times from outside, for a block that waits: if ties to them are late, as at its start."""
        graph, name = self._board.graph, f"for {block.key.block}"
        bounds = plan.bounds.items()
        return {cell: LateTiePeg(graph, f"{cell.name} {name}", cell, block.start, *each) for cell, each in bounds}

    def _open(self, unit: PlanUnit) -> None:
        """Give a behavior pegs for the points that are not planned, so that others may depend on them."""
        graph = self._board.graph
        if unit.open:
            return
        if isinstance(unit, WaitUnit):
            unit.open = {"end": unit.make_end(graph)}
        elif unit.timing.persistent:
            unit.open = {sync: OpenPeg(graph, str(unit.key(sync))) for sync in unit.timing.points if sync in OPEN}

    def _announce(self, block: BMLBlock, plan: Plan) -> None:
        for listener in self._listeners:
            listener(block, plan.posed.problem, plan.solution)

    def _build(self, block: BMLBlock, plan: Plan) -> Mapping[PegKey, TimePeg]:
        """Give the pegs of a plan to the points of its units; the pegs by name."""
        if plan.built is None:
            deque(self.make_pegs(block, plan), maxlen=0)
        self._board.add_unnamed(block.key, () if plan.built is None else plan.built.unnamed)
        plan.give_points(block.start)
        return plan.named


def _in_steps(small: Generator[int, None, T]) -> Generator[int, None, T]:
    """Do some small steps at once; each gives the work that they took, and the result of the last one is returned."""
    work = 0
    try:
        while True:
            work += next(small)
            if work >= _WORK_AT_ONCE:
                yield work
                work = 0
    except StopIteration as end:
        yield work
        result: T = end.value
        return result
