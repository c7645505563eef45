"""Which behaviors join late: those that hang on the outside, at a time that has passed."""

from collections.abc import Iterator, Mapping

from reactive_realizer.scheduler.convex.explained_groups import ExplainedGroups
from reactive_realizer.scheduler.convex.relaxed_problem import RelaxedProblem
from reactive_realizer.scheduler.problem import Node, Origin, Point


def late_behaviors(relaxed: RelaxedProblem, nodes: Mapping[Node, int], groups: ExplainedGroups) -> set[int]:
    """The indices of the behaviors with a tied point before the block's start that the outside brought there."""
    times = list(relaxed.fixed.values())

    def passed(node: Node) -> bool:
        root, distance = groups.find(nodes[node])
        time = times[root] if root < len(times) else None
        return time is not None and time + distance < 0

    outside = {node for node in relaxed.fixed if node is not Origin.BLOCK_START}
    late = {nodes[node] for node in outside if passed(node)}
    for node in _tied_to_outside(relaxed):
        if passed(node):
            late.add(groups.find(nodes[node])[0])
    tied = {node for tie in relaxed.ties.values() for node in tie.nodes if isinstance(node, Point) and passed(node)}
    names = {node.behavior for node in tied if groups.find(nodes[node])[0] in late}
    return {index for index, item in relaxed.items.items() if item.behavior.id in names}


def _tied_to_outside(relaxed: RelaxedProblem) -> Iterator[Node]:
    """The points that a tie names together with a peg of another block or of an anticipator."""
    for tie in relaxed.ties.values():
        if any(not isinstance(node, Point | Origin) for node in tie.nodes):
            yield from tie.nodes
