"""Warns of constraints that held and can no longer be satisfied (thesis 7.3.6: drop a violated constraint)."""

from collections.abc import Mapping
from typing import Any

from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.errors import Fault, SchedulingFault
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.graph import Cell
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_lifecycle import BlockLifecycle
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.block_watch import BlockWatch
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.late_ties import OuterTie, outer_ties
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.verify import TOLERANCE, missed

_NOTICEABLE = 0.1
"""A gesture that is early or late by less (s) looks on time."""


class ConstraintLost(SchedulingFault):
    """A constraint that stopped holding after a change; ``gap`` in s."""

    code = "constraint-lost"
    template = "{constraint} no longer holds: it is off by {gap} s"
    constraint: str
    gap: float


class ConstraintHurried(SchedulingFault):
    """A constraint that a change left too little time for; times in s."""

    code = "constraint-hurried"
    template = "{constraint} no longer holds: it is off by {gap} s, because {point} needs {need} s, has {room} s"
    compared = ("need", "room")
    constraint: str
    gap: float
    point: str
    need: float
    room: float


class ConstraintMonitor:
    """Warns once of each constraint of a committed plan that can no longer be satisfied.

    Pegs keep a constraint until one side has passed, or until two times from outside move too close together.
    """

    def __init__(self, watch: BlockWatch, lifecycle: BlockLifecycle, feedback: BlockFeedback) -> None:
        self._moves = watch.moves()
        self._lifecycle = lifecycle
        self._feedback = feedback
        self._ended: list[BMLBlock] = []
        lifecycle.listen(self._note_end)

    def check(self, now: GlobalTime) -> None:
        """Check the blocks of which something has moved in the tick at ``now``."""
        blocks, moved = self._moves.take()
        ended, self._ended = self._ended, []
        for block in (*ended, *blocks):
            units = {unit.behavior.id: unit for unit in block.units}
            for each in block.kept:
                if not (_holds(each, block, units) or each in block.settled or _cut(each, units)):
                    self._check(each, block, units, moved, now)

    def _note_end(self, block: BMLBlock) -> None:
        """A block that ended by itself is checked once more: the tick may have broken a constraint of it."""
        if block.state is BlockState.DONE:
            self._ended.append(block)

    def _check(
        self,
        constraint: Tie | Precedence,
        block: BMLBlock,
        units: Mapping[str, PlanUnit],
        moved: Mapping[Cell[Any], Any],
        now: GlobalTime,
    ) -> None:
        """Check a constraint.

        Args:
            constraint: of the plan.
            block: that it belongs to.
            units: of the block, by id.
            moved: the cells that changed in this tick, with their values before.
            now: the time of the tick.
        """
        late = _late(constraint, block, units)
        outside = [node for node in constraint.nodes if not isinstance(node, Point | Origin)]
        if late <= TOLERANCE and not any(node.value is None for node in outside):
            return
        fired = bool(outside) and _fired(constraint, block, units)
        if not block.state.plays and not block.state.ended and _outer(constraint) is not None:
            return  # a late tie is reported when the block starts
        if fired and late > TOLERANCE and _kept_ahead(constraint, block, units, moved):
            self._lifecycle.settle(block, constraint)
            return
        # A new prediction of a time that has passed, after all tied points have fired, means its next occurrence.
        renewed = fired and any(is_due(moved.get(node), now) for node in outside)
        hurried = _hurried(constraint, units)
        slight = (fired or hurried is not None) and isinstance(constraint, Tie) and late <= _NOTICEABLE
        lost = late > TOLERANCE and not slight
        if lost and not renewed:
            self._warn(block, constraint, _fault(constraint, late, hurried, units))
        if lost or (renewed and any(node.value is None for node in outside)):
            self._lifecycle.settle(block, constraint)

    def _warn(self, block: BMLBlock, constraint: Tie | Precedence, fault: Fault) -> None:
        owner = constraint.owner if isinstance(constraint, Tie) else None
        id_ = block.key.block if owner is None else f"{block.key.block}:{owner}"
        self._feedback.warn(block.key.character, id_, fault, constraint.location)


def _hurried(constraint: Tie | Precedence, units: Mapping[str, PlanUnit]) -> Point | None:
    """The first point of a constraint that its body cannot reach in time."""
    points = (node for node in constraint.nodes if isinstance(node, Point))
    return next((point for point in points if point.sync in units[point.behavior].hurries), None)


def _fault(constraint: Tie | Precedence, late: float, hurried: Point | None, units: Mapping[str, PlanUnit]) -> Fault:
    if hurried is None:
        return ConstraintLost(constraint=constraint.text, gap=late)
    need, room = units[hurried.behavior].hurries[hurried.sync]
    return ConstraintHurried(constraint=constraint.text, gap=late, point=":".join(hurried), need=need, room=room)


def _time(node: Node, block: BMLBlock, units: Mapping[str, PlanUnit]) -> Time:
    if isinstance(node, Point):
        return units[node.behavior].time(node.sync)
    return block.start.value if isinstance(node, Origin) else node.value


def _holds(constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Return whether the times of a constraint are known and satisfy it; this quick check suffices for most."""
    one, other = constraint.nodes
    first, second = _known_time(one, block, units), _known_time(other, block, units)
    return first is not None and second is not None and missed(constraint, first, second) <= TOLERANCE


def _known_time(node: Node, block: BMLBlock, units: Mapping[str, PlanUnit]) -> Time:
    """The time of a node; None also for a point that was dropped."""
    if isinstance(node, Point):
        unit = units.get(node[0])
        for point in () if unit is None else unit.points:
            if point.id == node[1]:
                return point.peg.value
        return None
    return block.start.value if isinstance(node, Origin) else node.value


def _late(constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit]) -> float:
    """By how much (s) a constraint is missed; minus infinity if a time is unknown.

    A block may start after a time that its start is tied to.
    """
    first, second = [_time(node, block, units) for node in constraint.nodes]
    outer = _outer(constraint) if Origin.BLOCK_START in constraint.nodes else None
    if outer is None or first is None or second is None:
        return missed(constraint, first, second)
    late = second + constraint.offset - first
    return late if constraint.nodes[0] is outer.node else -late


def _kept_ahead(
    constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit], moved: Mapping[Cell[Any], Any]
) -> bool:
    """Whether a point ahead of a time from outside came as that was predicted before this tick."""
    outer = _outer(constraint)
    time, predicted = (None, None) if outer is None else (_time(outer.node, block, units), moved.get(outer.cell))
    if outer is None or outer.offset >= 0 or time is None or predicted is None:
        return False
    return bool(abs(predicted + outer.offset - time) <= _NOTICEABLE)


def _outer(constraint: Tie | Precedence) -> OuterTie | None:
    """The constraint as a tie to a time from outside, if it is one."""
    return next(outer_ties([constraint]), None) if isinstance(constraint, Tie) else None


def _cut(constraint: Tie | Precedence, units: Mapping[str, PlanUnit]) -> bool:
    """Whether a point of it was dropped, or is interrupted now or soon, which gives a warning of its own."""
    points = (node for node in constraint.nodes if isinstance(node, Point))
    return any(point.behavior not in units or _loses(units[point.behavior], point.sync) for point in points)


def _loses(unit: PlanUnit, sync: str) -> bool:
    coming = unit.coming()[:-1] if unit.ends_early else unit.points
    return unit.was_cut(sync) or all(point.id != sync for point in coming)


def _fired(constraint: Tie | Precedence, block: BMLBlock, units: Mapping[str, PlanUnit]) -> bool:
    """Whether all points of the block that it names have fired."""
    points = [node for node in constraint.nodes if isinstance(node, Point)]
    started = block.started_at is not None or Origin.BLOCK_START not in constraint.nodes
    return started and all(units[point.behavior].point(point.sync).fired for point in points)
