"""Poses a block as a scheduling problem."""

from collections.abc import Container, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace

from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.pegboard.bounded_pegs import Bound
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.planunit.wait_unit import WaitUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.constraints import bound_on_start
from reactive_realizer.scheduler.free_points import through_free
from reactive_realizer.scheduler.late_ties import LateTies
from reactive_realizer.scheduler.passed_moments import without_passed
from reactive_realizer.scheduler.problem import Item, Node, Origin, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss
from reactive_realizer.scheduler.takeovers import Takeovers


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

    @property
    def stale(self) -> bool:
        """Whether a time from outside has moved since the problem was posed.

        A later start of the block does not count: the times of a plan are relative to it.
        """
        times = self.problem.times.items()
        return any(_moved(cell.value, time, self.start) for cell, time in times if cell not in self.late)

    def depends_on(self, start: TimeCell) -> bool:
        """Return whether the problem has a time from outside that depends on the start of its block."""
        cells = (*self.problem.times, *(cell for cell, _ in self.holds.values()))
        return any(cell.depends_on(start) for cell in cells)


def item_of(unit: PlanUnit) -> Item:
    """A behavior with its preferences, as it is to be timed."""
    return Item(unit.behavior, unit.timing.closed)


def _left(block: BMLBlock) -> list[Tie | Precedence]:
    """The constraints of the present plan of a block on the behaviors that are left."""
    gone = {behavior.id for behavior in block.description.behaviors} - {unit.behavior.id for unit in block.units}
    return [each for each in block.kept if not each.names(gone)]


def pose_again(block: BMLBlock, items: Mapping[PlanUnit, Item], now: GlobalTime, *, starts: bool) -> BlockProblem:
    """The problem of a planned block, with the constraints of its present plan on the behaviors that are left."""
    left = _left(block)
    ties = [each for each in left if isinstance(each, Tie)]
    orders = [each for each in left if isinstance(each, Precedence)]
    return pose(block, items, ties, orders, now, starts=starts)


def pose(
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
