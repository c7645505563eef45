"""The points at fixed distances from those of a rigid behavior."""

from collections.abc import Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.block_pegs import LatestPeg
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Node, Point, Precedence, Tie
from reactive_realizer.scheduler.verify import TOLERANCE, missed


def shift_ahead(block: BMLBlock, unit: PlanUnit, seconds: Mapping[str, float], board: PegBoard) -> None:
    """Within a transaction, move the points ahead of a rigid behavior, and those that are tied to them.

    A point that would come before the last tick is pinned at this one. Points that a `before` or an `after` constraint
    keeps behind or ahead of these give way.

    Args:
        block: of the behavior.
        unit: the behavior.
        seconds: how much later each of its points is to come.
        board: of the pegs.
    """
    shifts = _shifts(block, unit, seconds)
    pegs = ((peg, point) for point, peg in _pegs_ahead(block).items() if point in shifts and not peg.pinned)
    wanted = {peg: (peg.value, shifts[point]) for peg, point in pegs}
    moved: dict[TimePeg, float] = {}
    for peg in sorted(wanted, key=lambda each: each.rank):
        time, shift = wanted[peg]
        if time is not None and time + shift < board.previous:
            moved[peg] = board.time - time
            peg.pin(board.time)
        else:
            own = shift - (_inherited(peg, moved) or 0.0)
            moved[peg] = shift
            if own:
                peg.shift(own)
    _keep_orders(block, shifts)


def fixed_point(block: BMLBlock, unit: PlanUnit) -> str:
    """The point of a rigid behavior that keeps its time when its timing changes before it begins.

    It is the first one that is tied to a time from outside or to the start of the block, directly or through other
    behaviors; without one, its start.
    """
    tied = _tied_nodes(block)
    rigid = {each.behavior.id: each for each in block.units if each.timing.rigid and each is not unit}
    for point in _points_of(unit):
        seen, waiting = {point}, [point]
        while waiting:
            for node in tied.get(waiting.pop(), ()):
                if not isinstance(node, Point):
                    return point.sync
                new = _points_of(rigid[node.behavior]) if node.behavior in rigid else [node]
                waiting += [other for other in new if other not in seen and other.behavior != unit.behavior.id]
                seen.update(new)
    return unit.timing.points[0]


def _inherited(cell: TimeCell, moved: Mapping[TimePeg, float]) -> float | None:
    """The shift that a peg takes over from those that it depends on; None if it depends on none that is shifted."""
    for each in cell.dependencies:
        if isinstance(each, TimePeg) and each in moved:
            return moved[each]
        if not isinstance(each, LatestPeg) and (inherited := _inherited(each, moved)) is not None:
            return inherited
    return None


def _keep_orders(block: BMLBlock, shifts: Mapping[Point, float]) -> None:
    """Have points give way to some that have moved."""
    pegs = _pegs_ahead(block)
    for each in block.kept:
        if not isinstance(each, Precedence):
            continue
        (after, later), (before, earlier) = (
            (shifts.get(node), pegs.get(node)) if isinstance(node, Point) else (None, None) for node in each.nodes
        )
        if after == before or later is None or earlier is None or missed(each, later.value, earlier.value) <= TOLERANCE:
            continue
        if before is not None and earlier.value is not None:
            later.keep_after(GlobalTime(earlier.value + each.offset))
        elif not earlier.pinned:
            earlier.keep_before(later, -each.offset)


def _pegs_ahead(block: BMLBlock) -> dict[Point, TimePeg]:
    """The pegs of the points of a block that have not fired."""
    return {Point(unit.behavior.id, point.id): point.peg for unit in block.live_units for point in unit.ahead()}


def _shifts(block: BMLBlock, unit: PlanUnit, seconds: Mapping[str, float]) -> dict[Point, float]:
    """The shifts (s) of the points of a behavior, of those that are tied to them, of behaviors there, and so on.

    A rigid behavior moves as a whole, and so does one that has not begun and is held at a single point, so that it
    keeps its preferred durations. Of others, that point moves, and later ones that are tied only to what follows them.
    Points that have fired stay, and what is tied to them.

    Args:
        block: of the behavior.
        unit: the behavior.
        seconds: the shift of each of its points.
    """
    tied, ahead = _tied_nodes(block), _pegs_ahead(block)
    units = {each.behavior.id: each for each in block.units}
    shifts = {Point(unit.behavior.id, sync): shift for sync, shift in seconds.items()}
    waiting = list(shifts)
    while waiting:
        point = waiting.pop(0)
        for each in tied.get(point, ()):
            if not isinstance(each, Point):
                continue
            own = _moving_with(each, units, tied) if each.behavior in units else [each]
            new = [other for other in own if other in ahead and other not in shifts]
            shifts.update(dict.fromkeys(new, shifts[point]))
            waiting += new
    return shifts


def _moving_with(point: Point, units: Mapping[str, PlanUnit], tied: Mapping[Point, Sequence[Node]]) -> list[Point]:
    """The points of a behavior that move with one of them: see `_shifts`."""
    unit = units[point.behavior]
    points = _points_of(unit)
    if unit.timing.rigid:
        return points
    later = points[points.index(point) + 1 :]
    following = [each for each in later if each in tied and _is_followed(each, points, units, tied)]
    held = [each for each in points if each in tied and each not in following]
    return points if held == [point] and not unit.begun else [point, *following]


def _is_followed(
    point: Point, own: Sequence[Point], units: Mapping[str, PlanUnit], tied: Mapping[Point, Sequence[Node]]
) -> bool:
    """Whether a point is tied only to behaviors that have not begun and that nothing else holds.

    Args:
        point: of a behavior.
        own: the points of that behavior.
        units: of the block.
        tied: the nodes to which each point is tied.
    """
    seen, waiting = {point}, [point]
    while waiting:
        for node in tied.get(waiting.pop(), ()):
            if not isinstance(node, Point) or node.behavior not in units:
                return False
            if node in seen:
                continue
            if node in own or units[node.behavior].begun:
                return False
            new = {*_points_of(units[node.behavior])} - seen
            seen |= new
            waiting += new
    return True


def _tied_nodes(block: BMLBlock) -> Mapping[Point, Sequence[Node]]:
    """The nodes to which each point of a block is tied, and the point itself."""
    tied: dict[Point, list[Node]] = {}
    for tie in block.kept:
        for node in tie.nodes if isinstance(tie, Tie) else ():
            if isinstance(node, Point):
                tied.setdefault(node, []).extend(tie.nodes)
    return tied


def _points_of(unit: PlanUnit) -> list[Point]:
    return [Point(unit.behavior.id, sync) for sync in unit.timing.points]
