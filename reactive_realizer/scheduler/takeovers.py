"""Takeovers within a block: a gesture takes over the arm of an earlier one after its stroke."""

from collections.abc import Collection, Iterator, Mapping

from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.scheduler.problem import Point, Precedence, SchedulingProblem

Takeovers = Mapping[Precedence, tuple[PlanUnit, Timing]]
"""Constraints, each with the unit that takes over and its timing from where the other one leaves the body."""

_POINTS = frozenset({"strokeEnd", "stroke", "relax"})


def takeovers(
    problem: SchedulingProblem,
    units: tuple[PlanUnit, ...],
    times: Mapping[Point, float],
    refused: Collection[Precedence] = (),
) -> Takeovers:
    """Return the takeovers that let more units of a block play.

    Two units with the same arm exclude each other from the start of one to its relax. If the stroke of the later one
    comes after that of the earlier one, it need not be lost: it starts at the relax of the earlier one, whose hold is
    shortened for that, and whose retraction is cut when it starts (`PlanUnit.subsiding`). An end and a start that are
    tied stay where they are.

    Where strokes follow each other too closely for one arm, the later unit may be played by the other one
    (`PlanUnit.spares`). The arms then take turns, so it takes over from the unit before the earlier one.

    Args:
        problem: of the block.
        units: its behaviors.
        times: of a plan of the problem, s after the start of the block.
        refused: takeovers that cannot be planned.
    """
    named = {node for each in problem.ties for node in each.nodes}
    found: dict[Precedence, tuple[PlanUnit, Timing]] = {}
    for resource in sorted({resource for unit in units for resource in unit.resources}):
        for unit, after in _overlapping([unit for unit in units if resource in unit.resources], times, refused):
            if not named & {Point(unit.behavior.id, "end"), Point(after.behavior.id, "start")}:
                found.setdefault(_order(unit, after), (after, after.timing_after(unit)))
    return found


def _overlapping(
    units: list[PlanUnit], times: Mapping[Point, float], refused: Collection[Precedence]
) -> Iterator[tuple[PlanUnit, PlanUnit]]:
    """Yield pairs of units with one arm, of which the second starts before the first relaxes, and strokes later."""

    def time(unit: PlanUnit, sync: str) -> float:
        return times[Point(unit.behavior.id, sync)]

    able = [
        unit
        for unit in units
        if unit.timing.closed is unit.timing
        and not unit.accompanies
        and unit.group is None
        and all(Point(unit.behavior.id, sync) in times for sync in _POINTS)
    ]
    able.sort(key=lambda unit: (time(unit, "stroke"), unit.behavior.id))
    for number, other in enumerate(able[1:], 1):
        one = able[number - 1]
        if number > 1 and _order(one, other) in refused and other.spares(one.resources):
            one = able[number - 2]
        overlap = time(other, "start") < time(one, "relax") - RESOLUTION
        if overlap and time(other, "stroke") > time(one, "strokeEnd"):
            yield one, other


def _order(one: PlanUnit, other: PlanUnit) -> Precedence:
    begins, relaxes = Point(other.behavior.id, "start"), Point(one.behavior.id, "relax")
    text = f"{begins.behavior}:{begins.sync} after {relaxes.behavior}:{relaxes.sync}, which has the same arm"
    return Precedence(begins, relaxes, 0.0, text, other.behavior.location, text, required=False)
