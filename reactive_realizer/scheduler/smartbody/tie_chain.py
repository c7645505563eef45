"""The ties that determine the place of a point."""

from collections import defaultdict, deque
from collections.abc import Callable, Iterable

from reactive_realizer.scheduler.problem import Node, Tie


def chain(first: Node, ties: Iterable[Tie], placed: Callable[[Node], bool]) -> list[Tie]:
    """The shortest chain of ties from a node to another one that is ``placed``, in this order; empty without one."""
    links: defaultdict[Node, list[Tie]] = defaultdict(list)
    for tie in ties:
        for node in tie.nodes:
            links[node].append(tie)
    reached: dict[Node, list[Tie]] = {first: []}
    waiting = deque([first])
    while waiting:
        node = waiting.popleft()
        if node != first and placed(node):
            return reached[node]
        for tie in links[node]:
            other = tie.right if tie.left == node else tie.left
            if other not in reached:
                reached[other] = [*reached[node], tie]
                waiting.append(other)
    return []
