"""The behaviors that follow times from outside while they play."""

from collections.abc import Set as AbstractSet

from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.problem import Node, Origin, Point, SchedulingProblem


def following_outside(problem: SchedulingProblem) -> AbstractSet[str]:
    """The behaviors of which a point after the first is tied, directly or through others, to a time from outside."""
    cells = [node for each in problem.ties for node in each.nodes if not isinstance(node, Point | Origin)]
    if not cells:
        return frozenset()
    groups = OffsetUnionFind[Node](cells)
    for tie in problem.ties:
        for node in tie.nodes:
            groups.add(node)
        groups.union(*tie.nodes)
    outside = {groups.find(cell)[0] for cell in cells}
    later = {point for item in problem.items for point in item.points[1:]}
    named = {node for tie in problem.ties for node in tie.nodes if node in later and groups.find(node)[0] in outside}
    return {node.behavior for node in named if isinstance(node, Point)}
