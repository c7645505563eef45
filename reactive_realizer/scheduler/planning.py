"""Turns a prepared block into a scheduling problem, and its solution into pegs on the board."""

import logging
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import Bound, OffsetPeg, OpenPeg, TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import OPEN, Timing
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import ReferenceResolver, drop_unplaceable, holding, orders_of, ties_of
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.free_points import through_free
from reactive_realizer.scheduler.peg_layout.peg_layout import PegLayout
from reactive_realizer.scheduler.problem import (
    Item,
    Loss,
    Origin,
    Point,
    Precedence,
    SchedulingProblem,
    Solution,
    Tie,
)
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve

logger = logging.getLogger(__name__)

PlanListener = Callable[[BMLBlock, SchedulingProblem, Solution], None]


@dataclass(frozen=True, slots=True)
class BlockProblem:
    """A block as a problem to be solved.

    Attributes:
        units: its behaviors that can be placed.
        problem: what the strategy gets.
        losses: what was lost before.
        start: when the block was expected to start.
        holds: constraints that the block keeps by starting later, with the bounds that they put on its start.
    """

    units: tuple[PlanUnit, ...]
    problem: SchedulingProblem
    losses: tuple[Loss, ...]
    start: GlobalTime
    holds: Mapping[Tie | Precedence, Bound]


@dataclass(frozen=True, slots=True)
class Plan:
    """A solved block; nothing of it is on the board yet.

    Attributes:
        units: the behaviors that have times.
        losses: what was lost before and by the strategy.
        kept: the constraints that are kept.
        holds: the bounds on the start of the block.
    """

    units: tuple[PlanUnit, ...]
    problem: SchedulingProblem
    solution: Solution
    layout: PegLayout
    losses: tuple[Loss, ...]
    kept: tuple[Tie | Precedence, ...]
    holds: tuple[Bound, ...]

    @property
    def times(self) -> Mapping[Point, float | None]:
        """When its points are, s after the start of the block; None for those that wait for an unknown time."""
        return self.layout.times


class Planning:
    """Poses and solves the problems of blocks, and lays out their plans on the board."""

    def __init__(self, board: PegBoard, blocks: Blocks, strategy: SchedulingStrategy) -> None:
        self._board = board
        self._blocks = blocks
        self._strategy = strategy
        self._listeners: list[PlanListener] = []

    def listen(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` of each plan that is put on the board."""
        self._listeners.append(listener)

    def build_problem(self, block: BMLBlock, timings: Mapping[PlanUnit, Timing], now: GlobalTime) -> BlockProblem:
        """The problem of a block that is ready to start; the board stays as it is.

        Args:
            block: in preparation, or about to start.
            timings: its behaviors, with their preferences.
            now: the earliest start.
        """
        kept = {unit.behavior.id: unit for unit in timings}
        for unit in kept.values():
            self._open(unit)
        resolver = ReferenceResolver(block, kept, self._board, self._blocks)
        losses = drop_unplaceable(kept, resolver)
        ties, lost_ties = ties_of(block.description, kept, resolver)
        orders, lost_orders = orders_of(block.description, resolver)
        wanted = [Item(unit.behavior, timings[unit].closed) for unit in kept.values()]
        items, ties, orders = through_free(wanted, ties, orders)
        holds = _holds([*ties, *orders], _predicted_start(block, now))
        ties, orders = [tie for tie in ties if tie not in holds], [order for order in orders if order not in holds]
        start = _held_start(block, holds.values(), now)
        times = _outer_times([*ties, *orders], start)
        problem = SchedulingProblem(items, tuple(ties), times, tuple(orders))
        return BlockProblem(tuple(kept.values()), problem, (*losses, *lost_ties, *lost_orders), start, holds)

    def _open(self, unit: PlanUnit) -> None:
        """Give a behavior that persists pegs for its unknown points, so that others may hang on them."""
        if unit.timing.persistent and not unit.open:
            graph = self._board.graph
            unit.open = {sync: OpenPeg(graph, str(unit.key(sync))) for sync in unit.timing.points if sync in OPEN}

    def solve(self, posed: BlockProblem) -> Plan:
        """A plan by the strategy; thread-safe, because it reads only the problem.

        A strategy that raises fails the block, and nothing else.
        """
        try:
            solution = solve(self._strategy, posed.problem)
            layout = PegLayout(posed.problem, solution)
        except Exception as failure:
            logger.exception("the strategy %s failed", self._strategy.name)
            fault = WorkFailed(reason=str(failure))
            solution = Solution({}, (Loss(None, fault, dropped=False, required=True),))
            layout = PegLayout(posed.problem, solution)
        left = layout.kept
        behaviors = {item.behavior.id for item in left.items}
        planned = tuple(unit for unit in posed.units if unit.behavior.id in behaviors)
        kept = (*left.ties, *left.orders, *posed.holds)
        losses = (*posed.losses, *solution.losses)
        return Plan(planned, posed.problem, solution, layout, losses, kept, tuple(posed.holds.values()))

    def is_stale(self, posed: BlockProblem) -> bool:
        """Whether times from outside have moved since the problem was posed.

        A later start of the block does not count: the times of a plan are relative to it.
        """
        return any(_moved(cell.value, time, posed.start) for cell, time in posed.problem.times.items())

    def is_cyclic(self, block: BMLBlock, posed: BlockProblem) -> bool:
        """Whether a time from outside has come to depend on the block itself."""
        cells = (*posed.problem.times, *(cell for cell, _ in posed.holds.values()))
        return any(cell.depends_on(block.start) for cell in cells)

    def renewed(self, block: BMLBlock, start: GlobalTime, now: GlobalTime) -> Plan | None:
        """A new plan of a block that starts, with the preferences of its engines now (thesis 12.1.4).

        Args:
            block: about to start.
            start: its time, s.
            now: the time of the tick.

        Returns:
            None if the present plan is still good, or the new one would lose anything.
        """
        if not _is_outdated(block, start):
            return None
        plan = self.solve(self.build_problem(block, {unit: unit.preference(now) for unit in block.units}, start))
        return None if plan.losses or len(plan.units) < len(block.units) else plan

    def lay_out(self, block: BMLBlock, plan: Plan) -> list[TimePeg]:
        """Within a transaction, put the pegs of a plan on the board; those that the block's start waits for."""
        self._board.add_block(block.key, self._hang(block, plan))
        holds = self._holds(block, plan)
        self._announce(block, plan)
        return holds

    def replace(self, block: BMLBlock, plan: Plan) -> dict[TimeCell, TimeCell]:
        """Within a transaction, replace the plan on the board; returns the new pegs by the old ones."""
        replaced: dict[TimeCell, TimeCell] = {}
        for key, peg in self._hang(block, plan).items():
            if (old := self._board.get(key)) is peg:
                continue
            if old is not None:
                replaced[old] = peg
            self._board.replace(key, peg)
        self._announce(block, plan)
        return replaced

    def _announce(self, block: BMLBlock, plan: Plan) -> None:
        for listener in self._listeners:
            listener(block, plan.problem, plan.solution)

    def _holds(self, block: BMLBlock, plan: Plan) -> list[TimePeg]:
        """Pegs for the bounds that constraints put on the start of a block."""
        name = f"{block.key.block}:start as constrained"
        holds: list[TimePeg] = [OffsetPeg(self._board.graph, name, cell, offset) for cell, offset in plan.holds]
        self._board.add_unnamed(block.key, holds)
        return holds

    def _hang(self, block: BMLBlock, plan: Plan) -> dict[PegKey, TimePeg]:
        """Make the pegs of a plan, and have the points of its units reached at them."""
        pegs, unnamed = plan.layout.build(self._board.graph, block.key.block, block.start)
        self._board.add_unnamed(block.key, unnamed)
        reasons = _reasons(plan.kept)
        points: dict[str, dict[str, TimePeg]] = {unit.behavior.id: {} for unit in plan.units}
        for point, peg in pegs.items():
            points[point.behavior][point.sync] = peg
        for unit in plan.units:
            named = reasons.get(unit.behavior.id, {})
            own = points[unit.behavior.id]
            for sync, texts in named.items():
                own[sync].why = "; ".join(texts)
            unit.points = [SyncPoint(sync, peg, sync in named) for sync, peg in own.items()]
            unit.points += [SyncPoint(sync, peg) for sync, peg in unit.open.items()]
        known = {unit.key(sync): peg for unit in plan.units for sync, peg in points[unit.behavior.id].items()}
        return known | {unit.key(sync): peg for unit in plan.units for sync, peg in unit.open.items()}


def _reasons(constraints: Iterable[Tie | Precedence]) -> dict[str, dict[str, list[str]]]:
    """The points of each behavior that constraints name, with the texts of these."""
    found: dict[str, dict[str, list[str]]] = {}
    for each in constraints:
        for node in each.nodes:
            if isinstance(node, Point):
                found.setdefault(node.behavior, {}).setdefault(node.sync, []).append(each.text)
    return found


def _is_outdated(block: BMLBlock, start: GlobalTime) -> bool:
    """Whether a block is to be planned again when it starts.

    It is a chunk, and gestures are prepared from where the hands are; or something of it has come to lie before its
    start, because times from outside are no longer those it was planned with.
    """
    times = (point.peg.value for unit in block.units for point in unit.points)
    early = any(time is not None and time < start - RESOLUTION for time in times)
    return early or any(each.chunk for each in block.predecessors)


def _predicted_start(block: BMLBlock, now: GlobalTime) -> GlobalTime:
    """When a block that has not started is expected to start."""
    return max(now, block.start.value or now)


def _holds(constraints: Iterable[Tie | Precedence], start: GlobalTime) -> dict[Tie | Precedence, Bound]:
    """The constraints that a block keeps by starting later; it cannot start earlier for an `at`."""
    bounds = ((each, bound) for each in constraints if (bound := holding(each)) is not None)
    return {each: bound for each, bound in bounds if isinstance(each, Precedence) or not _before(bound, start)}


def _before(bound: Bound, time: GlobalTime) -> bool:
    cell, distance = bound
    return cell.value is not None and cell.value + distance < time - RESOLUTION


def _held_start(block: BMLBlock, holds: Iterable[Bound], now: GlobalTime) -> GlobalTime:
    known = [GlobalTime(cell.value + distance) for cell, distance in holds if cell.value is not None]
    return max([_predicted_start(block, now), *known])


def _outer_times(constraints: Sequence[Tie | Precedence], start: GlobalTime) -> dict[TimeCell, float | None]:
    nodes = [node for each in constraints for node in each.nodes]
    cells = (node for node in nodes if not isinstance(node, Point | Origin))
    return {cell: None if cell.value is None else cell.value - start for cell in cells}


def _moved(now: Time, planned: float | None, start: GlobalTime) -> bool:
    if now is None or planned is None:
        return now is not planned
    return abs(now - start - planned) > RESOLUTION
