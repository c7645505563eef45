"""EMBR's scheduling: a linear program of least deviations (thesis 7.2.3; Kipp, Heloir, Schröder and Gebhard 2010)."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import accumulate, pairwise

from reactive_realizer.errors import Fault, SchedulingFault
from reactive_realizer.planunit.timing import SHORTEST, TooShort, stretched
from reactive_realizer.scheduler.duration_limits import limits_not_kept
from reactive_realizer.scheduler.embr.embr_problem import EmbrProblem
from reactive_realizer.scheduler.embr.keeping import keep
from reactive_realizer.scheduler.embr.placing import place
from reactive_realizer.scheduler.faults import ContradictoryTie
from reactive_realizer.scheduler.problem import Item, Node, Point, Precedence, SchedulingProblem, Tie
from reactive_realizer.scheduler.solution import Loss, Solution, lost_behavior, with_required


class SelfContradictory(SchedulingFault):
    """A behavior whose own constraints contradict each other; ``gap`` in s."""

    code = "self-contradictory"
    template = "this behavior is dropped: {tie} contradicts its other constraints by {gap} s"
    tie: str
    gap: float


class EmbrStrategy:
    """Stretches phases as little as possible, in seconds over all phases, and keeps before/after constraints.

    This differs from the thesis in three ways. A block may have any number of speeches, because rigid phases are not
    variables. A cluster that is not grounded starts with the block, or as early as it may. And of equally good plans,
    of which a linear program often has many, a second stage chooses the one that spreads the deviation evenly and
    stretches rather than shrinks.

    Constraints are admitted in this order: required, `at`, before/after, and by name; those that contradict earlier
    ones are dropped. Authored limits are admitted last, if the plan does not keep them anyway. A hold is as stiff as a
    stroke.
    """

    name = "embr"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`."""
        items, constraints, given = problem.items, problem.constraints, problem.given
        faults = {item.behavior.id: fault for item in items if (fault := _alone(item, constraints, given)) is not None}
        playable = [item for item in items if item.behavior.id not in faults]
        program = EmbrProblem(playable, [each for each in constraints if not each.names(faults)], given)
        lost = [lost_behavior(item.behavior, faults[item.behavior.id]) for item in items if item not in playable]
        losses = [with_required(loss, problem) for loss in lost]
        solution = _solved(program, losses, limits=False)
        broken = any(limits_not_kept(problem, solution))
        return _solved(program, losses, limits=True) if broken else solution


def _solved(program: EmbrProblem, losses: Iterable[Loss], *, limits: bool) -> Solution:
    """The plan with or without authored limits, and with some more losses."""
    kept = keep(program, limits=limits)
    knots = place(program, kept)
    items = program.items.items()
    times = {point: time for id_, item in items for point, time in _points(item, program.knots[id_], knots)}
    return Solution(times, (*losses, *kept.losses))


def _points(item: Item, knots: Sequence[int], times: Mapping[Node, float]) -> Iterator[tuple[Point, float]]:
    """The times of all points of a behavior: between knots, all phases are stretched evenly."""
    yield item.points[0], times[item.points[0]]
    for before, after in pairwise(knots):
        low, high = times[item.points[before]], times[item.points[after]]
        durations = stretched(item.timing.phases[before:after], high - low)
        ends = (low + passed for passed in accumulate(durations[:-1]))
        yield from zip(item.points[before + 1 : after], ends, strict=True)
        yield item.points[after], high


def _alone(item: Item, constraints: Iterable[Tie | Precedence], given: Mapping[Node, float | None]) -> Fault | None:
    """The fault of a behavior that cannot be played because of its own constraints; a rigid one loses these instead."""
    if item.timing.rigid:
        never = not item.timing.instant and item.timing.offsets[-1] < SHORTEST
        return TooShort() if never else None
    id_ = item.behavior.id
    ties = [each for each in constraints if isinstance(each, Tie) and each.owner == id_]
    own = [tie for tie in ties if all(node in given or _is_of(node, id_) for node in tie.nodes)]
    faults = (loss.fault for loss in keep(EmbrProblem([item], own, given), limits=False).losses) if own else iter(())
    clashes = (fault for fault in faults if isinstance(fault, ContradictoryTie))
    return next((SelfContradictory(tie=clash.tie, gap=clash.gap) for clash in clashes), None)


def _is_of(node: Node, behavior: str) -> bool:
    return isinstance(node, Point) and node.behavior == behavior
