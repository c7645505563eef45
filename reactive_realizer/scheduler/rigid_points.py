"""The points at fixed distances from those of a rigid behavior."""

from collections.abc import Container

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_view import followers_of
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Node, Point, Precedence, Tie
from reactive_realizer.scheduler.verify import TOLERANCE, missed


def shift_ahead(block: BMLBlock, unit: PlanUnit, seconds: float) -> None:
    """Within a transaction, move the points ahead of a rigid behavior, and those that are tied to them.

    Points that a `before` or an `after` constraint keeps behind or ahead of these give way.
    """
    points = _tied_points(block, unit)
    pegs = {point: peg for point, peg in _pegs_ahead(block).items() if point in points}
    followers = set[TimeCell]().union(*map(followers_of, pegs.values()))
    for peg in dict.fromkeys(pegs.values()):
        if peg not in followers and not peg.pinned:
            peg.shift(seconds)
    _keep_orders(block, points)


def _keep_orders(block: BMLBlock, moved: Container[Node]) -> None:
    """Have points give way to some that have moved."""
    pegs = _pegs_ahead(block)
    for each in block.kept:
        if not isinstance(each, Precedence) or (each.later in moved) == (each.earlier in moved):
            continue
        later, earlier = (pegs.get(node) if isinstance(node, Point) else None for node in each.nodes)
        if later is None or earlier is None or missed(each, later.value, earlier.value) <= TOLERANCE:
            continue
        if each.earlier in moved and earlier.value is not None:
            later.keep_after(GlobalTime(earlier.value + each.offset))
        elif each.later in moved and not earlier.pinned:
            earlier.keep_before(later, -each.offset)


def _pegs_ahead(block: BMLBlock) -> dict[Point, TimePeg]:
    """The pegs of the points of a block that have not fired."""
    return {Point(unit.behavior.id, point.id): point.peg for unit in block.live_units for point in unit.ahead()}


def _tied_points(block: BMLBlock, unit: PlanUnit) -> set[Point]:
    """The points of a behavior, those that are tied to them, those of rigid behaviors among these, and so on."""
    rigid = {each.behavior.id: each for each in block.units if each.timing.rigid}
    ties = [{node for node in tie.nodes if isinstance(node, Point)} for tie in block.kept if isinstance(tie, Tie)]
    points = _points_of(unit)
    while new := {point for tie in ties if tie & points for point in tie} - points:
        points |= new.union(*(_points_of(rigid[point.behavior]) for point in new if point.behavior in rigid))
    return points


def _points_of(unit: PlanUnit) -> set[Point]:
    return {Point(unit.behavior.id, sync) for sync in unit.timing.points}
