"""From a prepared block to a plan on the board: solved aside, committed in one transaction or not at all."""

import logging
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.following import hangs_on
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import Bound, OffsetPeg, OpenPeg, TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import OPEN, Timing
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import drop_unplaceable, holding, orders_of, ties_of
from reactive_realizer.scheduler.free_points import through_free
from reactive_realizer.scheduler.names import Names
from reactive_realizer.scheduler.peg_builder import PegBuilder
from reactive_realizer.scheduler.problem import (
    Item,
    Loss,
    Order,
    Origin,
    Point,
    Problem,
    Solution,
    Tie,
)
from reactive_realizer.scheduler.strategy import SchedulingStrategy

logger = logging.getLogger(__name__)

PlanListener = Callable[[BMLBlock, Problem, Solution], None]


@dataclass(frozen=True, slots=True)
class Task:
    """A block as a problem to be solved, and what was lost before that.

    Attributes:
        start: when the block was expected to start.
        holds: constraints that the block keeps by starting later, with what it comes after by them.
    """

    units: tuple[PlanUnit, ...]
    problem: Problem
    losses: tuple[Loss, ...]
    start: GlobalTime
    holds: Mapping[Tie | Order, Bound]


@dataclass(frozen=True, slots=True)
class Plan:
    """A solved block; nothing of it is on the board yet."""

    units: tuple[PlanUnit, ...]
    problem: Problem
    solution: Solution
    losses: tuple[Loss, ...]
    kept: tuple[Tie | Order, ...]
    holds: tuple[Bound, ...]


class Planning:
    """Solves blocks with a strategy and commits what comes out."""

    def __init__(self, board: PegBoard, blocks: Blocks, strategy: SchedulingStrategy) -> None:
        self._board = board
        self._blocks = blocks
        self._strategy = strategy
        self._listeners: list[PlanListener] = []

    def listen(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` of each plan that was committed."""
        self._listeners.append(listener)

    def pose(self, block: BMLBlock, timings: Mapping[PlanUnit, Timing], now: GlobalTime) -> Task:
        """What is to be solved for a block that would be ready to start now; the board stays as it is.

        Args:
            block: whose.
            timings: its behaviors, with their preferences.
            now: it starts not before this.
        """
        kept = {unit.behavior.id: unit for unit in timings}
        for unit in kept.values():
            self._open(unit)
        names = Names(block, kept, self._board, self._blocks)
        losses = drop_unplaceable(kept, names)
        ties, lost_ties = ties_of(block.description, kept, names.locate)
        orders, lost_orders = orders_of(block.description, names.locate)
        wanted = [Item(unit.behavior, timings[unit].closed) for unit in kept.values()]
        items, ties, orders = through_free(wanted, ties, orders)
        holds = _holds([*ties, *orders], _predicted_start(block, now))
        ties, orders = [tie for tie in ties if tie not in holds], [order for order in orders if order not in holds]
        start = _held_start(block, holds.values(), now)
        times = _outer_times([*ties, *orders], start)
        problem = Problem(items, tuple(ties), times, tuple(orders))
        return Task(tuple(kept.values()), problem, (*losses, *lost_ties, *lost_orders), start, holds)

    def _open(self, unit: PlanUnit) -> None:
        """Give one that persists the pegs of its points that nobody knows; others may hang on them."""
        if unit.timing.persistent and not unit.open:
            graph = self._board.graph
            unit.open = {sync: OpenPeg(graph, str(unit.key(sync))) for sync in unit.timing.points if sync in OPEN}

    def solve(self, task: Task) -> Plan:
        """A plan by the strategy; it may be called in another thread, for it reads and writes nothing but the task.

        A strategy that raises costs the block, and nothing else.
        """
        try:
            solution = self._strategy.solve(task.problem)
        except Exception as failure:
            logger.exception("the strategy %s failed", self._strategy.name)
            fault = Fault("work-failed", {"reason": failure})
            solution = Solution({}, (Loss(None, fault, dropped=False, required=True),))
        planned = tuple(unit for unit in task.units if unit.behavior.id in solution.pegs)
        kept = (*solution.kept(task.problem), *task.holds)
        losses = (*task.losses, *solution.losses)
        return Plan(planned, task.problem, solution, losses, kept, tuple(task.holds.values()))

    def is_stale(self, task: Task) -> bool:
        """Whether times from outside are not what they were when the problem was posed.

        That the block starts later is nothing new: its plan is in times after its start, and lives.
        """
        return any(_moved(cell.value, time, task.start) for cell, time in task.problem.times.items())

    def is_cyclic(self, block: BMLBlock, task: Task) -> bool:
        """Whether by now something from outside hangs on the block itself."""
        cells = (*task.problem.times, *(cell for cell, _ in task.holds.values()))
        return any(hangs_on(cell, block.start) for cell in cells)

    def commit(self, block: BMLBlock, plan: Plan, now: GlobalTime) -> None:
        """Put a plan on the board: all of it, in one transaction."""
        with self._board.graph.transaction(f"plan {block.key.block}"):
            self._board.add_block(block.key, self._hang(block, plan))
            block.planned(now, plan.units, plan.kept, self._holds(block, plan))
        self._tell(block, plan)

    def recommit(self, block: BMLBlock, plan: Plan) -> None:
        """Within a transaction, put another plan in the place of that on the board; who hung on that hangs on this."""
        replaced: dict[TimeCell, TimeCell] = {}
        for key, peg in self._hang(block, plan).items():
            if (old := self._board.get(key)) is peg:
                continue
            if old is not None:
                replaced[old] = peg
            self._board.replace(key, peg)
        for other in self._blocks.alive:
            other.follow(replaced)
        block.replanned(block.end.floor, plan.units, plan.kept)
        self._tell(block, plan)

    def _tell(self, block: BMLBlock, plan: Plan) -> None:
        for listener in self._listeners:
            listener(block, plan.problem, plan.solution)

    def _holds(self, block: BMLBlock, plan: Plan) -> list[TimePeg]:
        """The pegs that the start of a block hangs on by constraints."""
        name = f"{block.key.block}:start as constrained"
        holds: list[TimePeg] = [OffsetPeg(self._board.graph, name, cell, offset) for cell, offset in plan.holds]
        self._board.add_unnamed(block.key, holds)
        return holds

    def _hang(self, block: BMLBlock, plan: Plan) -> dict[PegKey, TimePeg]:
        specs_of = plan.solution.pegs
        own = {unit: {sync: unit.key(sync) for sync in specs_of[unit.behavior.id]} for unit in plan.units}
        specs = {key: specs_of[unit.behavior.id][sync] for unit, keys in own.items() for sync, key in keys.items()}
        builder = PegBuilder(self._board.graph, block, specs)
        pegs = builder.build()
        self._board.add_unnamed(block.key, builder.unnamed)
        reasons = _reasons(plan.kept)
        for unit, keys in own.items():
            named = reasons.get(unit.behavior.id, {})
            for sync, texts in named.items():
                pegs[keys[sync]].why = "; ".join(texts)
            unit.points = [SyncPoint(sync, pegs[key], sync in named) for sync, key in keys.items()]
            unit.points += [SyncPoint(sync, peg) for sync, peg in unit.open.items()]
        return pegs | {unit.key(sync): peg for unit in plan.units for sync, peg in unit.open.items()}


def _reasons(constraints: Iterable[Tie | Order]) -> dict[str, dict[str, list[str]]]:
    """The points of each behavior that constraints name, with the text of these."""
    found: dict[str, dict[str, list[str]]] = {}
    for each in constraints:
        for node in each.nodes:
            if isinstance(node, Point):
                found.setdefault(node.behavior, {}).setdefault(node.sync, []).append(each.text)
    return found


def _predicted_start(block: BMLBlock, now: GlobalTime) -> GlobalTime:
    """When a block that was not started yet is expected to start."""
    return max(now, block.start.value or now)


def _holds(constraints: Iterable[Tie | Order], start: GlobalTime) -> dict[Tie | Order, Bound]:
    """The constraints that a block keeps by starting later; it cannot start earlier for an `at`."""
    bounds = ((each, bound) for each in constraints if (bound := holding(each)) is not None)
    return {each: bound for each, bound in bounds if isinstance(each, Order) or not _before(bound, start)}


def _before(bound: Bound, time: GlobalTime) -> bool:
    cell, distance = bound
    return cell.value is not None and cell.value + distance < time - RESOLUTION


def _held_start(block: BMLBlock, holds: Iterable[Bound], now: GlobalTime) -> GlobalTime:
    known = [GlobalTime(cell.value + distance) for cell, distance in holds if cell.value is not None]
    return max([_predicted_start(block, now), *known])


def _outer_times(constraints: Sequence[Tie | Order], start: GlobalTime) -> dict[TimeCell, float | None]:
    nodes = [node for each in constraints for node in each.nodes]
    cells = (node for node in nodes if not isinstance(node, Point | Origin))
    return {cell: None if cell.value is None else cell.value - start for cell in cells}


def _moved(now: Time, planned: float | None, start: GlobalTime) -> bool:
    if now is None or planned is None:
        return now is not planned
    return abs(now - start - planned) > RESOLUTION
