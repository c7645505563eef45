"""Turns a prepared block into a scheduling problem, and its solution into pegs on the board."""

import logging
from collections import deque
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from itertools import islice

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, has_passed, is_due
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AfterPeg, Bound, OffsetPeg, OpenPeg, TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import OPEN, Timing
from reactive_realizer.planunit.wait_unit import WaitUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import ReferenceResolver, bound_on_start, constraints_of
from reactive_realizer.scheduler.duration_limits import limits_not_kept
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.free_points import through_free
from reactive_realizer.scheduler.late_ties import LateTies, least_times
from reactive_realizer.scheduler.passed_moments import without_passed
from reactive_realizer.scheduler.peg_layout.peg_layout import BuiltPegs, PegLayout
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss, Solution
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve

logger = logging.getLogger(__name__)

_PEGS_AT_ONCE = 50
"""Pegs that are made in one step."""

PlanListener = Callable[[BMLBlock, SchedulingProblem, Solution], None]


@dataclass(frozen=True, slots=True)
class BlockProblem:
    """A block as a problem to be solved.

    Attributes:
        units: its behaviors that can be placed.
        problem: the input of the strategy.
        losses: behaviors and constraints that were lost before.
        start: when the block was expected to start.
        holds: constraints that the block satisfies by starting later, with the bounds that they put on its start.
        late: the times from outside that count as unknown, because ties to them are late for the expected start.
        awaited: the points for which behaviors wait; empty if they wait already.
    """

    units: tuple[PlanUnit, ...]
    problem: SchedulingProblem
    losses: tuple[Loss, ...]
    start: GlobalTime
    holds: Mapping[Tie | Precedence, Bound]
    late: AbstractSet[TimeCell]
    awaited: Mapping[WaitUnit, Node] = field(default_factory=dict)


class Plan:
    """A solved block; nothing of it is on the board yet.

    Attributes:
        posed: the problem.
        solution: of the strategy.
        layout: how the points depend on each other.
        units: the behaviors that have times.
        losses: those of the problem and of the strategy.
        beyond_limits: the behaviors that do not keep the limits of their authors.
        kept: the constraints that are kept.
        times: of the planned points, s after the start of the block; None for those that depend on an unknown time.
        built: its pegs; None until they are made.
    """

    def __init__(self, posed: BlockProblem, solution: Solution) -> None:
        self.posed = posed
        self.solution = solution
        self.layout = PegLayout(posed.problem, solution)
        planned = {item.behavior.id for item in self.layout.kept.items}
        self.units = [unit for unit in posed.units if unit.behavior.id in planned]
        self.losses = (*posed.losses, *solution.losses)
        self.beyond_limits = tuple(limits_not_kept(posed.problem, solution))
        self.kept = (*self.layout.kept.constraints, *posed.holds)
        waiting = {Point(unit.behavior.id, sync) for unit in self.units for sync in unit.open}
        self.times = {point: time for point, time in self.layout.times.items() if point not in waiting}
        self.built: BuiltPegs | None = None

    @property
    def size(self) -> int:
        """The number of its points."""
        return len(self.times)

    def discard(self) -> None:
        """Dispose of its pegs, if they are made."""
        if self.built is not None:
            self.built.dispose()


class Planning:
    """Poses and solves the problems of blocks, and lays out their plans on the board."""

    def __init__(self, board: PegBoard, blocks: Blocks, strategy: SchedulingStrategy) -> None:
        self._board = board
        self._blocks = blocks
        self._strategy = strategy
        self._listeners: list[PlanListener] = []

    def listen(self, listener: PlanListener) -> None:
        """Call ``listener(block, problem, solution)`` for each plan that is put on the board."""
        self._listeners.append(listener)

    def build_problem(
        self, block: BMLBlock, timings: Mapping[PlanUnit, Timing], now: GlobalTime, losses: Iterable[Loss] = ()
    ) -> BlockProblem:
        """The problem of a block that is ready to start; the board stays as it is.

        Args:
            block: in preparation.
            timings: its behaviors, with their preferences.
            now: the earliest start.
            losses: behaviors that were lost before.
        """
        for unit in timings:
            self._open(unit)
        resolver = ReferenceResolver(block, {unit.behavior.id: unit for unit in timings}, self._board, self._blocks)
        dropped = resolver.drop_unplaceable()
        ties, orders, lost = constraints_of(block.description, resolver)
        kept = {unit: timings[unit] for unit in resolver.units.values()}
        posed = _pose(block, kept, ties, orders, now, starts=False)
        awaited = {unit: resolver.locate(unit.until) for unit in kept if isinstance(unit, WaitUnit)}
        return replace(posed, losses=(*losses, *dropped, *lost, *posed.losses), awaited=awaited)

    def solve(self, posed: BlockProblem) -> Plan:
        """A plan by the strategy; thread-safe, because it reads only the problem.

        If the strategy raises, only this block fails.
        """
        try:
            return Plan(posed, solve(self._strategy, posed.problem))
        except Exception as failure:
            logger.exception("the strategy %s failed", self._strategy.name)
            fault = WorkFailed(reason=str(failure))
            return Plan(posed, Solution({}, (Loss(None, fault, dropped=False, required=True),)))

    def is_stale(self, posed: BlockProblem) -> bool:
        """Whether times from outside have moved since the problem was posed.

        A later start of the block does not count: the times of a plan are relative to it.
        """
        times = posed.problem.times.items()
        return any(_moved(cell.value, time, posed.start) for cell, time in times if cell not in posed.late)

    def is_cyclic(self, block: BMLBlock, posed: BlockProblem) -> bool:
        """Whether a time from outside has come to depend on the block itself."""
        cells = (*posed.problem.times, *(cell for cell, _ in posed.holds.values()))
        return any(cell.depends_on(block.start) for cell in cells)

    def again(self, block: BMLBlock, now: GlobalTime) -> Plan:
        """A new plan of a block that waits, from the constraints of its present one."""
        return self.solve(_posed_again(block, {unit: unit.timing for unit in block.units}, now, starts=False))

    def at_start(self, block: BMLBlock, start: GlobalTime, now: GlobalTime) -> Plan | None:
        """A new plan of a block that starts at ``start``, with the preferences of its engines ``now`` (thesis 12.1.4).

        A chunk is planned again because gestures are prepared from the position of the hands. So is a block with points
        or ties before its start, because times from outside have moved: no point comes before its block.

        Returns:
            None if the present plan is still good, or the new plan of a chunk would lose anything.
        """
        times = (point.peg.value for unit in block.units for point in unit.points)
        early = any(has_passed(time, start) for time in times) or _has_late_ties(block, start)
        if not early and not any(each.chunk for each in block.predecessors):
            return None
        timings = {unit: unit.preference(now) for unit in block.units}
        plan = self.solve(_posed_again(block, timings, start, starts=True))
        return plan if early or not plan.losses else None

    def make_pegs(self, block: BMLBlock, plan: Plan) -> Generator[int]:
        """Make the pegs of a plan, in steps that give their numbers; none is on the board yet.

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
        except GeneratorExit:
            steps.close()
            for peg in outside.values():
                peg.dispose()
            plan.discard()
            raise

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
        """Pegs for times from outside, for a block that waits: none comes before a tie to it can be met."""
        graph, layout = self._board.graph, plan.layout.kept
        least = least_times(layout.items, layout.ties).items()
        name = f"for {block.key.block}"
        return {cell: AfterPeg(graph, f"{cell.name} {name}", cell, [(block.start, time)]) for cell, time in least}

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

    def _build(self, block: BMLBlock, plan: Plan) -> dict[PegKey, TimePeg]:
        """Give the pegs of a plan to the points of its units."""
        if plan.built is None:
            deque(self.make_pegs(block, plan), maxlen=0)
        pegs, unnamed = plan.built or BuiltPegs({}, ())
        self._board.add_unnamed(block.key, unnamed)
        reasons: dict[Point, list[str]] = {}
        for each in plan.kept:
            for node in each.nodes:
                if isinstance(node, Point):
                    reasons.setdefault(node, []).append(each.text)
        units = {unit.behavior.id: unit for unit in plan.units}
        known: dict[PegKey, TimePeg] = {}
        for unit in plan.units:
            unit.points = []
        for point, peg in pegs.items():
            unit, texts = units[point.behavior], reasons.get(point)
            if point.sync in unit.open:
                continue
            if texts:
                peg.why = "; ".join(texts)
            unit.points.append(SyncPoint(point.sync, peg, tied=bool(texts)))
            known[unit.key(point.sync)] = peg
        for unit in plan.units:
            unit.points += [SyncPoint(sync, peg) for sync, peg in unit.open.items()]
            unit.wake()
        planned = set(plan.units)
        for unit, node in plan.posed.awaited.items():
            if unit in planned:
                unit.follow(_cell_of(node, block, pegs))
        return known | {unit.key(sync): peg for unit in plan.units for sync, peg in unit.open.items()}


def _cell_of(node: Node, block: BMLBlock, pegs: Mapping[Point, TimePeg]) -> TimeCell | None:
    if isinstance(node, Point):
        return pegs.get(node)
    return block.start if isinstance(node, Origin) else node


def _has_late_ties(block: BMLBlock, start: GlobalTime) -> bool:
    if not block.outside:
        return False
    items = (Item(unit.behavior, unit.timing.closed) for unit in block.units)
    ties = (each for each in _left(block) if isinstance(each, Tie))
    return any(has_passed(cell.value, start + time) for cell, time in least_times(items, ties).items())


def _left(block: BMLBlock) -> list[Tie | Precedence]:
    """The constraints of the present plan of a block on the behaviors that are left."""
    gone = {behavior.id for behavior in block.description.behaviors} - {unit.behavior.id for unit in block.units}
    return [each for each in block.kept if not each.names(gone)]


def _posed_again(block: BMLBlock, timings: Mapping[PlanUnit, Timing], now: GlobalTime, *, starts: bool) -> BlockProblem:
    """The problem of a planned block, with the constraints of its present plan on the behaviors that are left."""
    left = _left(block)
    ties = [each for each in left if isinstance(each, Tie)]
    orders = [each for each in left if isinstance(each, Precedence)]
    return _pose(block, timings, ties, orders, now, starts=starts)


def _pose(
    block: BMLBlock,
    timings: Mapping[PlanUnit, Timing],
    ties: Sequence[Tie],
    orders: Sequence[Precedence],
    now: GlobalTime,
    *,
    starts: bool,
) -> BlockProblem:
    """The problem of some constraints on some behaviors of a block, which starts not before ``now``.

    If the block ``starts``, late ties are moved. Until then, they are planned as if their times were unknown.
    """
    behaviors = {unit.behavior.id: unit.behavior for unit in timings}
    ties, orders, lost, gone = without_passed(behaviors, ties, orders, block.meant)
    units = tuple(unit for unit in timings if unit.behavior.id not in gone)
    items, ties, orders = through_free([Item(unit.behavior, timings[unit].closed) for unit in units], ties, orders)
    start = max(now, block.start.value or now)
    constraints: list[Tie | Precedence] = [*ties, *orders]
    holds = {each: bound for each in constraints if (bound := bound_on_start(each)) is not None}
    if holds:
        ties, orders = [tie for tie in ties if tie not in holds], [order for order in orders if order not in holds]
    start = max([start, *(time for bound in holds.values() for time in _known(bound))])
    late = LateTies(items, ties, start)
    unknown: AbstractSet[TimeCell] = late.cells
    if starts and late.cells:
        unknown = frozenset()
        ties, moved = late.moved()
        lost = (*lost, *moved)
    problem = SchedulingProblem(items, tuple(ties), _outer_times([*ties, *orders], start, unknown), tuple(orders))
    return BlockProblem(units, problem, tuple(lost), start, holds, unknown)


def _known(bound: Bound) -> list[GlobalTime]:
    """The time of a bound; empty if it is unknown."""
    cell, distance = bound
    return [] if cell.value is None else [GlobalTime(cell.value + distance)]


def _outer_times(
    constraints: Sequence[Tie | Precedence], start: GlobalTime, late: AbstractSet[TimeCell]
) -> dict[TimeCell, float | None]:
    nodes = [node for each in constraints for node in each.nodes]
    cells = (node for node in nodes if not isinstance(node, Point | Origin))
    return {cell: None if cell.value is None or cell in late else cell.value - start for cell in cells}


def _moved(now: Time, planned: float | None, start: GlobalTime) -> bool:
    if now is None or planned is None:
        return now is not planned
    return abs(now - start - planned) > RESOLUTION
