"""The ties that determine the place of a point."""

from collections import defaultdict, deque
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from reactive_realizer.scheduler.problem import Node, Tie

Links = Mapping[Node, Sequence[Tie]]
"""The ties of each node."""


def links_of(ties: Iterable[Tie]) -> Links:
    """The ties of each node."""
    links: defaultdict[Node, list[Tie]] = defaultdict(list)
    for tie in ties:
        for node in tie.nodes:
            links[node].append(tie)
    return links


def chain(first: Node, links: Links, lost: Collection[int], placed: Callable[[Node], bool]) -> list[Tie]:
    """The shortest chain of ties from a node to another one that is ``placed``, in this order; empty without one.

    Args:
        first: the node.
        links: the ties of each node.
        lost: ids (`id`) of ties that do not count.
        placed: whether a node has its place.
    """
    reached: dict[Node, list[Tie]] = {first: []}
    waiting = deque([first])
    while waiting:
        node = waiting.popleft()
        if node != first and placed(node):
            return reached[node]
        for tie in links.get(node, ()):
            other = tie.right if tie.left == node else tie.left
            if other not in reached and id(tie) not in lost:
                reached[other] = [*reached[node], tie]
                waiting.append(other)
    return []
