"""A strategy of your own: every behavior with its preferred durations, as early as its ties allow."""

from reactive_realizer.planunit.timing import SHORTEST, TooShort
from reactive_realizer.scheduler.faults import BeforeBlock, ContradictoryTie, NoOrder
from reactive_realizer.scheduler.offset_union_find import TIE_TOLERANCE, OffsetUnionFind
from reactive_realizer.scheduler.problem import Node, Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Loss, Solution, lost_behavior, lost_constraint, with_required


class Earliest:
    """Stretches nothing, and drops before/after constraints, and ties that contradict others."""

    name = "earliest"

    def solve(self, problem: SchedulingProblem) -> Solution:
        """See `SchedulingStrategy`."""
        groups: OffsetUnionFind[Node] = OffsetUnionFind(problem.given)
        losses: list[Loss] = []
        for item in problem.items:
            points = [Point(item.behavior.id, sync) for sync in item.timing.points]
            for point, offset in zip(points[1:], item.timing.offsets[1:], strict=True):
                groups.union(point, points[0], offset)
        for tie in problem.ties:
            gap = groups.union(tie.left, tie.right, tie.offset)
            if gap is not None and abs(gap) > TIE_TOLERANCE:
                losses.append(lost_constraint(tie, ContradictoryTie(tie=tie.text, gap=abs(gap))))
        losses += [lost_constraint(each, NoOrder(strategy=self.name, text=each.text)) for each in problem.orders]
        # A group starts with the block, unless it contains a known time.
        roots = {
            item.behavior.id: groups.find(Point(item.behavior.id, item.timing.points[0])) for item in problem.items
        }
        starts: dict[Node, float] = {}
        for root, offset in roots.values():
            starts[root] = max(starts.get(root, -offset), -offset)
        starts |= {node: time for node, time in problem.given.items() if time is not None}
        times: dict[Point, float] = {}
        for item in problem.items:
            root, offset = roots[item.behavior.id]
            if starts[root] + offset < -SHORTEST:
                losses.append(lost_behavior(item.behavior, BeforeBlock(early=-starts[root] - offset)))
            elif item.timing.offsets[-1] < SHORTEST and not item.timing.instant:
                losses.append(lost_behavior(item.behavior, TooShort()))
            else:
                for sync, time in zip(item.timing.points, item.timing.offsets, strict=True):
                    times[Point(item.behavior.id, sync)] = starts[root] + offset + time
        if not any(loss.dropped for loss in losses):
            return Solution(times, tuple(losses))
        # Without the lost behaviors, the rest may be earlier.
        lost = tuple(with_required(loss, problem) for loss in losses)
        rest = self.solve(Solution(times, lost).kept_of(problem))
        return Solution(rest.times, (*lost, *rest.losses))
