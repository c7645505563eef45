"""The order in which SmartBody's scheduling places behaviors (thesis 7.3.5)."""

from collections import defaultdict

from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Node, Point, SchedulingProblem


def sorted_items(problem: SchedulingProblem, ties: OffsetUnionFind[Node]) -> list[Item]:
    """The order of scheduling (thesis 7.3.5): rigid behaviors whose time is given, then all others.

    Among these, a rigid behavior comes before the behaviors with which it is in a cycle of ties.
    Otherwise, behaviors stay in document order. (The thesis's third group, completely flexible behaviors,
    follows with the first behavior of that kind.)
    """
    rigid = [item for item in problem.items if item.timing.rigid]
    grounded = [item for item in rigid if any(not isinstance(ties.find(node)[0], Point) for node in item.points)]
    order = [item for item in problem.items if item not in grounded]
    flexible = {item.behavior.id for item in problem.items if not item.timing.rigid}
    pairs = [tie.nodes for tie in problem.ties]
    links = [(one, other) for one, other in pairs if isinstance(one, Point) and isinstance(other, Point)]
    groups = OffsetUnionFind[str]()
    for one, other in links:
        if {one.behavior, other.behavior} <= flexible:
            groups.union(one.behavior, other.behavior)
    for item in [item for item in order if item.timing.rigid]:
        touched: defaultdict[str, set[str]] = defaultdict(set)
        for here, there in [*links, *((other, one) for one, other in links)]:
            if here.behavior == item.behavior.id and there.behavior in flexible:
                touched[groups.find(there.behavior)[0]].add(here.sync)
        cycles = {group for group, points in touched.items() if len(points) > 1}
        ahead = order[: order.index(item)]
        place = next((i for i, each in enumerate(ahead) if groups.find(each.behavior.id)[0] in cycles), None)
        if place is not None:
            order.remove(item)
            order.insert(place, item)
    return grounded + order
