"""Constraints that held and cannot be kept any more (thesis 7.3.6: drop a violated constraint, and say so)."""

from collections.abc import Iterable, Mapping
from typing import Any

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.concerned import concerned
from reactive_realizer.scheduler.problem import Node, Order, Origin, Point, Tie
from reactive_realizer.scheduler.reporter import Reporter
from reactive_realizer.scheduler.verify import TOLERANCE, missed

_NOTICEABLE = 0.1
"""A gesture that misses its moment by less (s) is seen as on time."""

Moved = Mapping[Cell[Any], Any]
"""Cells that changed in a tick, and what they were before."""


class ConstraintWatch:
    """Says once of each constraint of a committed plan that it is missed from now on.

    Pegs keep constraints for as long as they can. They cannot where one side has passed, or where two times from
    outside come closer than what is between them can be.
    """

    def __init__(self, board: PegBoard, blocks: Blocks, reporter: Reporter) -> None:
        self._board = board
        self._blocks = blocks
        self._reporter = reporter

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Check what the commits of the tick at ``now`` moved."""
        moved: dict[Cell[Any], Any] = {}
        for change in (change for commit in commits for change in commit.changes):
            moved.setdefault(change.cell, change.old)
        for block in concerned(self._blocks, self._board, moved):
            self._check(block, moved, now)

    def _check(self, block: BMLBlock, moved: Moved, now: GlobalTime) -> None:
        units = {unit.behavior.id: unit for unit in block.units}
        for each in block.kept:
            if each in block.settled or _cut(each, units):
                continue
            late = missed(each, *(_time(node, block, units) for node in each.nodes))
            if late > TOLERANCE:
                block.settled.add(each)
                if not _over(each, late, block, units, moved, now):
                    self._say(block, each, late)

    def _say(self, block: BMLBlock, constraint: Tie | Order, late: float) -> None:
        owner = constraint.owner if isinstance(constraint, Tie) else None
        fault = Fault("constraint-lost", {"constraint": constraint.text, "gap": late})
        fault = fault.located(constraint.location.line, constraint.location.column)
        id_ = block.key.block if owner is None else f"{block.key.block}:{owner}"
        self._reporter.warn(block.key.character, id_, fault)


def _time(node: Node, block: BMLBlock, units: Mapping[str, PlanUnit]) -> Time:
    if isinstance(node, Point):
        return units[node.behavior].time(node.sync)
    return block.start.value if isinstance(node, Origin) else node.value


def _cut(constraint: Tie | Order, units: Mapping[str, PlanUnit]) -> bool:
    """Whether a point of it was dropped or interrupted: who does that tells what it means."""
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    return any(point.behavior not in units or units[point.behavior].was_cut(point.sync) for point in points)


def _over(
    constraint: Tie | Order,
    late: float,
    block: BMLBlock,
    units: Mapping[str, PlanUnit],
    moved: Moved,
    now: GlobalTime,
) -> bool:
    """Whether all that it names had come when a time from outside was given anew.

    Where that time had come before, what is given anew is another occurrence. Where it comes now, or is corrected by
    less than anybody would see, whoever was tied to it has done its part: one is a little ahead of a beat, or behind.
    """
    outside = [node for node in constraint.nodes if not isinstance(node, Point | Origin)]
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    came = all(units[point.behavior].point(point.sync).fired is not None for point in points)
    started = block.state.plays or Origin.BLOCK_START not in constraint.nodes
    before = any(is_due(moved.get(node), now) for node in outside)
    here = late <= _NOTICEABLE or all(is_due(node.value, now) for node in outside)
    return came and started and (before or (isinstance(constraint, Tie) and here))
