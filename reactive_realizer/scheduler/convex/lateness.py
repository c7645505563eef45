"""Which behaviors join late: those that hang on the outside, at a time that has passed."""

from collections.abc import Iterator, Mapping

from reactive_realizer.scheduler.convex.case import Stage
from reactive_realizer.scheduler.convex.roots import Roots
from reactive_realizer.scheduler.problem import Node, Origin, Point


def late_behaviors(stage: Stage, nodes: Mapping[Node, int], roots: Roots) -> set[int]:
    """The indices of the behaviors with a tied point before the block's start that the outside brought there."""
    times = [fixed.time for fixed in stage.fixed.values()]

    def passed(node: Node) -> bool:
        root, distance = roots.find(nodes[node])
        time = times[root] if root < len(times) else None
        return time is not None and time + distance < 0

    outside = {node for node in stage.fixed if node is not Origin.BLOCK_START}
    late = {nodes[node] for node in outside if passed(node)}
    for node in _tied_to_outside(stage):
        if passed(node):
            late.add(roots.find(nodes[node])[0])
    tied = {node for tie in stage.ties.values() for node in tie.nodes if isinstance(node, Point) and passed(node)}
    names = {node.behavior for node in tied if roots.find(nodes[node])[0] in late}
    return {index for index, item in stage.items.items() if item.behavior.id in names}


def _tied_to_outside(stage: Stage) -> Iterator[Node]:
    """The points that a tie names together with a peg of another block or of an anticipator."""
    for tie in stage.ties.values():
        if any(not isinstance(node, Point | Origin) for node in tie.nodes):
            yield from tie.nodes
