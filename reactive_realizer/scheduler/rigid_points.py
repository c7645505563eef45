"""The points at fixed distances from those of a rigid behavior."""

from collections.abc import Iterable

from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Point, Tie


def pegs_ahead(block: BMLBlock, unit: PlanUnit) -> list[TimePeg]:
    """The pegs of the points ahead of a rigid behavior of a block, and of those that are tied to it, each once.

    A peg that follows another of these is left out.
    """
    points = _tied_points(block, unit)
    units = {each.behavior.id: each for each in block.live_units}
    ahead = [each.peg for id_, other in units.items() for each in other.ahead() if Point(id_, each.id) in points]
    pegs = [peg for peg in dict.fromkeys(ahead) if not peg.pinned]
    followers = _followers_of(pegs)
    return [peg for peg in pegs if peg not in followers]


def _tied_points(block: BMLBlock, unit: PlanUnit) -> set[Point]:
    """The points of a behavior, those that are tied to them, those of rigid behaviors among these, and so on."""
    rigid = {each.behavior.id: each for each in block.units if each.timing.rigid}
    ties = [{node for node in tie.nodes if isinstance(node, Point)} for tie in block.kept if isinstance(tie, Tie)]
    points = _points_of(unit)
    while new := {point for tie in ties if tie & points for point in tie} - points:
        points |= new.union(*(_points_of(rigid[point.behavior]) for point in new if point.behavior in rigid))
    return points


def _followers_of(pegs: Iterable[TimePeg]) -> set[TimeCell]:
    """The pegs that follow some of these."""
    followers: set[TimeCell] = set()
    waiting = [follower for peg in pegs for follower in peg.dependents]
    while waiting:
        peg = waiting.pop()
        if peg not in followers:
            followers.add(peg)
            waiting += peg.dependents
    return followers


def _points_of(unit: PlanUnit) -> set[Point]:
    return {Point(unit.behavior.id, sync) for sync in unit.timing.points}
