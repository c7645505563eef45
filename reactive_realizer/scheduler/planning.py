"""Turns a prepared block into a scheduling problem, and its solution into pegs on the board."""

import logging
from collections import deque
from collections.abc import Callable, Container, Generator, Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import TypeVar

from reactive_realizer.clock.ticker import next_tick
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time, has_passed, is_due
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import Bound, LateTiePeg, OffsetPeg, OpenPeg, TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.planunit.timing import OPEN, Timing
from reactive_realizer.planunit.wait_unit import WaitUnit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import ReferenceResolver, bound_on_start, constraints_of
from reactive_realizer.scheduler.duration_limits import limits_not_kept
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.scheduler.following_outside import following_outside
from reactive_realizer.scheduler.free_points import through_free
from reactive_realizer.scheduler.late_ties import LateTies, tie_bounds
from reactive_realizer.scheduler.passed_moments import without_passed
from reactive_realizer.scheduler.peg_layout.peg_layout import BuiltPegs, PegLayout
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss, Solution
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve
from reactive_realizer.scheduler.takeovers import Takeovers, takeovers

logger = logging.getLogger(__name__)

_PEGS_AT_ONCE = 50
"""Pegs that are made in one step."""

_WORK_AT_ONCE = 50
"""Work of resolving references in one step: behaviors, if all references are valid."""

_NAMED_AT_ONCE = 100
"""Pegs that are named in one step; this takes half as long as making them."""

_SOLVED = 3
"""Work of a solution for each point that it has a time for."""

T = TypeVar("T")

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
        loose: timings of behaviors in this problem that differ from those of their units, by id: rigid ones that can be
            stretched, and gestures that take over from others.
    """

    units: tuple[PlanUnit, ...]
    problem: SchedulingProblem
    losses: tuple[Loss, ...]
    start: GlobalTime
    holds: Mapping[Tie | Precedence, Bound]
    late: AbstractSet[TimeCell]
    awaited: Mapping[WaitUnit, Node] = field(default_factory=dict)
    loose: Mapping[str, Timing] = field(default_factory=dict)

    def loosened(self, behaviors: Container[str], constraints: Iterable[Tie | Precedence]) -> "BlockProblem | None":
        """The same problem, in which some behaviors are stretched where they can be; None if none of them can.

        Args:
            behaviors: their ids.
            constraints: those for which they are.
        """
        named: dict[str, set[str]] = {}
        for node in (node for each in constraints for node in each.nodes):
            if isinstance(node, Point) and node.behavior in behaviors:
                named.setdefault(node.behavior, set()).add(node.sync)
        rigid = {unit.behavior.id: unit for unit in self.units if unit.timing.rigid and unit.behavior.id in named}
        found = {id_: unit.loose_timing(named[id_]) for id_, unit in rigid.items()}
        timings = {id_: timing for id_, timing in found.items() if timing is not None}
        if not timings:
            return None
        items = (replace(each, timing=timings.get(each.behavior.id, each.timing)) for each in self.problem.items)
        return replace(self, problem=replace(self.problem, items=tuple(items)), loose={**self.loose, **timings})

    def with_takeovers(self, takeovers: Takeovers) -> "BlockProblem":
        """The same problem, in which some behaviors start where others relax."""
        timings = {unit.behavior.id: timing.closed for unit, timing in takeovers.values()}
        items = tuple(replace(each, timing=timings.get(each.behavior.id, each.timing)) for each in self.problem.items)
        problem = replace(self.problem, items=items, orders=(*self.problem.orders, *takeovers))
        return replace(self, problem=problem, loose={**self.loose, **timings})


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
        bounds: those that the times from outside set on the ties to them.
        times: of the planned points, s after the start of the block; None for those that depend on an unknown time.
        built: its pegs; None until they are made.
        points: the sync points of its behaviors, on these pegs.
        named: these pegs by name.
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
        self.bounds = tie_bounds(self.layout.kept.items, self.layout.kept.ties)
        waiting = {Point(unit.behavior.id, sync) for unit in self.units for sync in unit.open}
        self.times = {point: time for point, time in self.layout.times.items() if point not in waiting}
        self.built: BuiltPegs | None = None
        self.points: dict[PlanUnit, list[SyncPoint]] = {unit: [] for unit in self.units}
        self.named: dict[PegKey, TimePeg] = {}
        self._reasons: dict[Point, list[str]] = {}
        for each in self.kept:
            for node in each.nodes:
                if isinstance(node, Point):
                    self._reasons.setdefault(node, []).append(each.text)

    @property
    def size(self) -> int:
        """The number of its points."""
        return len(self.times)

    def discard(self) -> None:
        """Dispose of its pegs, if they are made."""
        if self.built is not None:
            self.built.dispose()

    def name_pegs(self) -> Iterator[None]:
        """Make the sync points of its behaviors, and the names and the texts of their pegs, in small steps."""
        units = {unit.behavior.id: unit for unit in self.units}
        for point, peg in self._pegs.items():
            unit = units[point.behavior]
            if point.sync not in unit.open:
                reasons = self._reasons.get(point)
                if reasons is not None:
                    peg.why = "; ".join(reasons)
                self.points[unit].append(SyncPoint(point.sync, peg, tied=reasons is not None))
                self.named[unit.key(point.sync)] = peg
            yield
        for unit, points in self.points.items():
            for sync, peg in unit.open.items():
                points.append(SyncPoint(sync, peg))
                self.named[unit.key(sync)] = peg
            yield

    def give_points(self, start: TimeCell) -> None:
        """Within a transaction, give the behaviors their points.

        Args:
            start: the peg of the start of the block.
        """
        for unit, points in self.points.items():
            unit.points = points
            if (timing := self.posed.loose.get(unit.behavior.id)) is not None:
                unit.loosen(timing)
            unit.wake()
        for unit, node in self.posed.awaited.items():
            if unit in self.points:
                awaited = self._pegs.get(node) if isinstance(node, Point) else node
                unit.follow(start if isinstance(awaited, Origin) else awaited)

    @property
    def _pegs(self) -> Mapping[Point, TimePeg]:
        return {} if self.built is None else self.built.pegs


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
        posed = _pose(block, kept, ties, orders, self._board.time, starts=False)
        awaited = {unit: resolver.locate(unit.until) for unit in kept if isinstance(unit, WaitUnit)}
        return replace(posed, losses=(*losses, *dropped, *lost, *posed.losses), awaited=awaited)

    def solve(self, posed: BlockProblem) -> Plan:
        """A plan by the strategy; thread-safe, because it reads only the problem.

        A speech that can be stretched is first planned as rigid, and stretched only if more constraints are kept that
        way. One that is tied to times from outside can be stretched later.
        """
        return _at_once(self.solve_in_steps(posed))

    def solve_in_steps(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        """As `solve`, in steps, each of which asks the strategy once and gives the work that it took."""
        plan = yield from self._solve(posed)
        posed, problem = plan.posed, plan.posed.problem
        if not plan.solution.losses:
            loosened = posed.loosened(following_outside(problem), problem.constraints)
            return plan if loosened is None else Plan(loosened, plan.solution)
        stretched = yield from self._stretched(posed, problem.constraints, len(plan.losses) - 1)
        if stretched is not None and stretched.solution.losses:
            # A constraint that is lost anyway must not stretch anything.
            kept = stretched.layout.kept.constraints
            stretched = (yield from self._stretched(posed, kept, len(stretched.losses))) or stretched
        return stretched or plan

    def _stretched(
        self, posed: BlockProblem, constraints: Sequence[Tie | Precedence], most: int
    ) -> Generator[int, None, Plan | None]:
        """A plan in which speeches are stretched for some constraints, if no more than a number of things are lost."""
        loosened = posed.loosened({item.behavior.id for item in posed.problem.items}, constraints)
        plan = None if loosened is None else (yield from self._solve(loosened))
        return None if plan is None or len(plan.losses) > most else plan

    def _solve(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        """A plan of a problem; if the strategy raises, only this block fails."""
        try:
            plan = yield from self._solve_as_posed(posed)
            return (yield from self._with_takeovers(plan))
        except Exception as failure:
            logger.exception("the strategy %s failed", self._strategy.name)
            fault = WorkFailed(reason=str(failure))
            return Plan(posed, Solution({}, (Loss(None, fault, dropped=False, required=True),)))

    def _solve_as_posed(self, posed: BlockProblem) -> Generator[int, None, Plan]:
        plan = Plan(posed, solve(self._strategy, posed.problem))
        yield _SOLVED * plan.size
        return plan

    def _with_takeovers(self, plan: Plan) -> Generator[int, None, Plan]:
        """A plan in which gestures take over the arms of others, where nothing is lost for that."""
        refused: set[Precedence] = set()
        while True:
            found = takeovers(plan.posed.problem, plan.posed.units, plan.solution.times, refused)
            tried = refused.union(plan.posed.problem.orders)
            wanted = {order: each for order, each in found.items() if order not in tried}
            if not wanted:
                return plan
            taking = yield from self._solve_as_posed(plan.posed.with_takeovers(wanted))
            if len(taking.solution.losses) <= len(plan.solution.losses):
                plan = taking
                continue
            lost = {loss.constraint for loss in taking.solution.losses}
            refused.update(wanted.keys() & lost or wanted)

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
        return self.solve(_posed_again(block, {unit: item_of(unit) for unit in block.units}, now, starts=False))

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
        plan = self.solve(_posed_again(block, items, start, starts=True))
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


def item_of(unit: PlanUnit) -> Item:
    """A behavior with its preferences, as it is to be timed."""
    return Item(unit.behavior, unit.timing.closed)


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


def _at_once(steps: Generator[int, None, T]) -> T:
    """Do all steps at once; the result of the last one."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            result: T = end.value
            return result


def _left(block: BMLBlock) -> list[Tie | Precedence]:
    """The constraints of the present plan of a block on the behaviors that are left."""
    gone = {behavior.id for behavior in block.description.behaviors} - {unit.behavior.id for unit in block.units}
    return [each for each in block.kept if not each.names(gone)]


def _posed_again(block: BMLBlock, items: Mapping[PlanUnit, Item], now: GlobalTime, *, starts: bool) -> BlockProblem:
    """The problem of a planned block, with the constraints of its present plan on the behaviors that are left."""
    left = _left(block)
    ties = [each for each in left if isinstance(each, Tie)]
    orders = [each for each in left if isinstance(each, Precedence)]
    return _pose(block, items, ties, orders, now, starts=starts)


def _pose(
    block: BMLBlock,
    items: Mapping[PlanUnit, Item],
    ties: Sequence[Tie],
    orders: Sequence[Precedence],
    now: GlobalTime,
    *,
    starts: bool,
) -> BlockProblem:
    """The problem of some constraints on some behaviors of a block, which starts not before ``now``.

    If the block ``starts``, late ties are moved. Until then, they are planned as if their times were unknown.
    """
    behaviors = {unit.behavior.id: unit.behavior for unit in items}
    ties, orders, lost, gone = without_passed(behaviors, ties, orders, block.meant)
    units = tuple(unit for unit in items if unit.behavior.id not in gone)
    timed, ties, orders = through_free([items[unit] for unit in units], ties, orders)
    start = max(now, block.start.value or now)
    constraints: list[Tie | Precedence] = [*ties, *orders]
    holds = {each: bound for each in constraints if (bound := bound_on_start(each)) is not None}
    if holds:
        ties, orders = [tie for tie in ties if tie not in holds], [order for order in orders if order not in holds]
    start = max([start, *(time for bound in holds.values() for time in _known(bound))])
    late = LateTies(timed, ties, start)
    unknown: AbstractSet[TimeCell] = late.cells
    if starts and late.cells:
        unknown = frozenset()
        ties, moved = late.moved()
        lost = (*lost, *moved)
    problem = SchedulingProblem(timed, tuple(ties), _outer_times([*ties, *orders], start, unknown), tuple(orders))
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
