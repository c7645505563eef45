"""Warns of constraints that held and can no longer be kept (thesis 7.3.6: drop a violated constraint)."""

from collections.abc import Iterable, Mapping
from typing import Any

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.graph import Cell, Commit
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.faults import ConstraintLost
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.verify import TOLERANCE, missed

_NOTICEABLE = 0.1
"""A gesture that misses its moment by less (s) looks on time."""

Moved = Mapping[Cell[Any], Any]
"""Cells that changed in a tick, with their values before."""


class ConstraintMonitor:
    """Warns once of each constraint of a committed plan that can no longer be kept.

    Pegs keep a constraint until one side has passed, or two times from outside come closer than what lies between
    them can be.
    """

    def __init__(self, board: PegBoard, blocks: Blocks, feedback: BlockFeedback) -> None:
        self._board = board
        self._blocks = blocks
        self._feedback = feedback
        self._ended: list[BMLBlock] = []

    def block_ended(self, block: BMLBlock) -> None:
        """Check a block that ended by itself once more: the tick may have broken a constraint of it."""
        if block.state is BlockState.DONE:
            self._ended.append(block)

    def check(self, commits: Iterable[Commit], now: GlobalTime) -> None:
        """Check the blocks of which the commits of the tick at ``now`` moved something."""
        moved: dict[Cell[Any], Any] = {}
        for change in (change for commit in commits for change in commit.changes):
            moved.setdefault(change.cell, change.old)
        ended, self._ended = self._ended, []
        for block in (*ended, *self._blocks.affected_by(moved, self._board)):
            self._check(block, moved, now)

    def _check(self, block: BMLBlock, moved: Moved, now: GlobalTime) -> None:
        units = {unit.behavior.id: unit for unit in block.units}
        for each in block.kept:
            if each in block.settled or _cut(each, units):
                continue
            late = missed(each, *(_time(node, block, units) for node in each.nodes))
            renewed = _renewed(each, block, units, moved, now)
            if late <= TOLERANCE or _slight(each, late, block, units):
                if renewed and any(node.value is None for node in _outside(each)):
                    block.settled.add(each)  # withdrawn: what is predicted from now on is the next time
                continue
            block.settled.add(each)
            if not renewed:
                self._warn(block, each, late)

    def _warn(self, block: BMLBlock, constraint: Tie | Precedence, late: float) -> None:
        owner = constraint.owner if isinstance(constraint, Tie) else None
        fault = ConstraintLost(constraint=constraint.text, gap=late)
        id_ = block.key.block if owner is None else f"{block.key.block}:{owner}"
        self._feedback.warn(block.key.character, id_, fault, constraint.location)


def _time(node: Node, block: BMLBlock, units: Mapping[str, PlanUnit]) -> Time:
    if isinstance(node, Point):
        return units[node.behavior].time(node.sync)
    return block.start.value if isinstance(node, Origin) else node.value


def _cut(constraint: Tie | Precedence, units: Mapping[str, PlanUnit]) -> bool:
    """Whether a point of it was dropped or interrupted, which gives a warning of its own."""
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    return any(point.behavior not in units or units[point.behavior].was_cut(point.sync) for point in points)


def _slight(constraint: Tie | Precedence, late: float, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Whether a time from outside is corrected unnoticeably after everything that is tied to it has come.

    A behavior that was tied to a beat is then a little ahead of it, or behind, as people are.
    """
    tied = isinstance(constraint, Tie) and bool(_outside(constraint))
    return tied and late <= _NOTICEABLE and _came(constraint, block, units)


def _renewed(
    constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit], moved: Moved, now: GlobalTime
) -> bool:
    """Whether a time from outside that had come, like all that names it, is predicted anew: it means the next time."""
    return any(is_due(moved.get(node), now) for node in _outside(constraint)) and _came(constraint, block, units)


def _outside(constraint: Tie | Precedence) -> list[TimeCell]:
    return [node for node in constraint.nodes if not isinstance(node, Point | Origin)]


def _came(constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Whether everything that it names of its block has come."""
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    started = block.started_at is not None or Origin.BLOCK_START not in constraint.nodes
    return started and all(units[point.behavior].point(point.sync).fired for point in points)
