"""EMBR's scheduling: a linear program of least deviations (thesis 7.2.3; Kipp, Heloir, Schröder and Gebhard 2010)."""

from collections.abc import Container, Iterable, Mapping, Sequence

from reactive_realizer.errors import Fault
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.embr.case import Case, Given
from reactive_realizer.scheduler.embr.grounding import ground
from reactive_realizer.scheduler.embr.keeping import keep
from reactive_realizer.scheduler.embr.pegs import Pegs
from reactive_realizer.scheduler.embr.placing import place
from reactive_realizer.scheduler.losses import lost_behavior
from reactive_realizer.scheduler.problem import (
    Anchor,
    AtBlock,
    Item,
    Loss,
    Node,
    Order,
    Origin,
    Point,
    Problem,
    Solution,
    Tie,
)
from reactive_realizer.scheduler.spec_times import SpecTimes


class EmbrStrategy:
    """Stretches as little as can be, in seconds over all phases, and keeps before/after constraints.

    As the thesis describes it, but for three things. Any number of speeches is taken: rigid phases are not variables.
    Clusters need not be grounded: those that are not start with the block, or as early as they may. And of equally good
    plans, of which a linear program mostly has many, a second stage takes the one that spreads the deviation evenly and
    rather stretches than shrinks.

    Constraints that cannot be met with those before them are dropped: in the order required, `at`, before/after, and by
    name. Limits of phases mean nothing here, and a hold is as stiff as a stroke.
    """

    name = "embr"

    def solve(self, problem: Problem) -> Solution:
        """See `SchedulingStrategy`; free behaviors come last, when all others stand."""
        given: dict[Node, Given] = {node: Given(node, time) for node, time in problem.times.items()}
        given[Origin.BLOCK_START] = Given(AtBlock(Anchor(), 0.0), 0.0)
        free = {item.behavior.id for item in problem.items if item.timing.free}
        constraints: list[Tie | Order] = [*problem.ties, *problem.orders]
        last = [each for each in constraints if any(_is_of(node, free) for node in each.nodes)]
        others = [item for item in problem.items if not item.timing.free]
        solved = _solve(others, [each for each in constraints if each not in last], given)
        time_of = SpecTimes(problem.times)
        for id_, pegs in solved.pegs.items():
            given |= {Point(id_, sync): Given(spec, time_of(spec)) for sync, spec in pegs.items()}
        following = _solve([item for item in problem.items if item.timing.free], last, given)
        return Solution({**solved.pegs, **following.pegs}, (*solved.losses, *following.losses))


def _solve(items: Sequence[Item], constraints: Sequence[Tie | Order], given: Mapping[Node, Given]) -> Solution:
    """Time some behaviors; those that cannot be played are dropped, and constraints on them go with them."""
    faults = {item.behavior.id: fault for item in items if (fault := _alone(item, constraints, given)) is not None}
    while True:
        playable = [item for item in items if item.behavior.id not in faults]
        ids = {item.behavior.id for item in playable}
        left = [each for each in constraints if all(node in given or _is_of(node, ids) for node in each.nodes)]
        case = Case(playable, left, given)
        kept = keep(case)
        times = place(case, kept)
        pegs = Pegs(case, kept, times)
        past = {id_: end for id_ in kept.late if (end := times[pegs.knots(id_)[-1]]) < -SHORTEST}
        if not past:  # else what is tied to them may be earlier without them
            break
        faults |= {id_: Fault("all-past", {"late": -end}) for id_, end in past.items()}
    ground(case, kept, times, pegs)
    losses = [_dropped(item, constraints, faults[item.behavior.id]) for item in items if item not in playable]
    return Solution(pegs.all(), (*losses, *kept.losses))


def _is_of(node: Node, behaviors: Container[str]) -> bool:
    return isinstance(node, Point) and node.behavior in behaviors


def _alone(item: Item, constraints: Iterable[Tie | Order], given: Mapping[Node, Given]) -> Fault | None:
    """Why what a behavior says of itself cannot be, whatever others do; a rigid one rather loses a constraint."""
    if item.timing.rigid:
        never = not item.timing.instant and item.timing.offsets[-1] < SHORTEST
        return Fault("too-short") if never else None
    id_ = item.behavior.id
    ties = [each for each in constraints if isinstance(each, Tie) and each.owner == id_]
    own = [tie for tie in ties if all(node in given or _is_of(node, {id_}) for node in tie.nodes)]
    faults = (loss.fault for loss in keep(Case([item], own, given)).losses) if own else iter(())
    clashes = (Fault("self-contradictory", fault.details) for fault in faults if fault.code == "contradictory-tie")
    return next(clashes, None)


def _dropped(item: Item, constraints: Iterable[Tie | Order], fault: Fault) -> Loss:
    """A behavior goes, and with it the constraints on it; the block fails if one of these was required."""
    own = {item.behavior.id}
    needed = any(each.required and any(_is_of(node, own) for node in each.nodes) for each in constraints)
    return lost_behavior(item.behavior, fault, needed=needed)
