"""Constraints that held and cannot be kept any more (thesis 7.3.6: drop a violated constraint, and say so)."""

from collections.abc import Iterable, Mapping
from typing import Any

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.reactive.commit import Commit
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
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
        self._ended: list[BMLBlock] = []

    def note_end(self, key: BlockKey) -> None:
        """A block ends; if it does so by itself, what the tick has broken of it is still said."""
        block = self._blocks.get(key)
        if block is not None and block.state is BlockState.DONE:
            self._ended.append(block)

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Check what the commits of the tick at ``now`` moved."""
        moved: dict[Cell[Any], Any] = {}
        for change in (change for commit in commits for change in commit.changes):
            moved.setdefault(change.cell, change.old)
        ended, self._ended = self._ended, []
        for block in (*ended, *concerned(self._blocks, self._board, moved)):
            self._check(block, moved, now)

    def _check(self, block: BMLBlock, moved: Moved, now: GlobalTime) -> None:
        units = {unit.behavior.id: unit for unit in block.units}
        for each in block.kept:
            if each in block.settled or _cut(each, units):
                continue
            late = missed(each, *(_time(node, block, units) for node in each.nodes))
            again = _again(each, block, units, moved, now)
            if late <= TOLERANCE or _slight(each, late, block, units):
                if again and any(node.value is None for node in _outside(each)):
                    block.settled.add(each)  # withdrawn: what is given from now on is for the next time
                continue
            block.settled.add(each)
            if not again:
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


def _slight(constraint: Tie | Order, late: float, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Whether a time from outside is corrected by less than anybody would see, after all that is tied to it has come.

    Who was tied to it has done its part: one is a little ahead of a beat, or behind.
    """
    tied = isinstance(constraint, Tie) and bool(_outside(constraint))
    return tied and late <= _NOTICEABLE and _came(constraint, block, units)


def _again(
    constraint: Tie | Order, block: BMLBlock, units: Mapping[str, PlanUnit], moved: Moved, now: GlobalTime
) -> bool:
    """Whether a time from outside is given anew after it had come, as had all that names it: for the next time."""
    return any(is_due(moved.get(node), now) for node in _outside(constraint)) and _came(constraint, block, units)


def _outside(constraint: Tie | Order) -> list[TimeCell]:
    return [node for node in constraint.nodes if not isinstance(node, Point | Origin)]


def _came(constraint: Tie | Order, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Whether all that it names of its block has."""
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    started = block.noticed is not None or Origin.BLOCK_START not in constraint.nodes
    return started and all(units[point.behavior].point(point.sync).fired is not None for point in points)
