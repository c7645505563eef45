"""Points that are tied to times from outside, divided into branches that move on their own."""

from collections import defaultdict, deque
from collections.abc import Iterable, Sequence

from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind


class Branches:
    """The branches of the points that are tied to times from outside.

    A branch is a point, or the points of a behavior with rigid phases between them, which stay together when the first
    one has passed; two speeches in a row are one branch. A branch depends on the branch that it is tied to on the
    shortest path from outside. So it follows the time from outside even if other points tied to that have passed, and
    it stays with a word whose speech cannot follow any more.

    Args:
        size: number of nodes.
        outside: the nodes whose times come from outside.
        rigid: pairs of nodes with nothing but rigid phases between them.
        ties: pairs of nodes that are tied to each other; with ``rigid`` no more than are needed to connect them.

    Attributes:
        pieces: of each node the first node of its branch.
        rigid: the first nodes of branches of several points.
        hosts: the first node of each branch -> that of the branch that it depends on, or the node from outside.
    """

    def __init__(
        self, size: int, outside: Sequence[int], rigid: Sequence[tuple[int, int]], ties: Iterable[tuple[int, int]]
    ) -> None:
        self.pieces: Sequence[int] = range(size)
        self.rigid: set[int] = set()
        self.hosts: dict[int, int] = {}
        if outside:
            self._find(outside, rigid, [*rigid, *ties])

    def _find(self, outside: Sequence[int], rigid: Sequence[tuple[int, int]], links: Sequence[tuple[int, int]]) -> None:
        held = {node for pair in rigid for node in pair}
        groups = OffsetUnionFind[int]()
        for node in self.pieces:
            groups.add(node)
        neighbors: defaultdict[int, list[int]] = defaultdict(list)
        for one, other in links:
            neighbors[one].append(other)
            neighbors[other].append(one)
            if one in held and other in held:
                groups.union(one, other)
        self.pieces = [groups.find(node)[0] for node in self.pieces]
        self.rigid = {self.pieces[node] for node in held}
        members: defaultdict[int, list[int]] = defaultdict(list)
        for node, piece in enumerate(self.pieces):
            members[piece].append(node)
        waiting = deque(outside)
        while waiting:
            host = waiting.popleft()
            tied = (self.pieces[other] for node in members[host] for other in neighbors[node])
            for piece in tied:
                if piece not in self.hosts and piece not in outside and piece != host:
                    self.hosts[piece] = host
                    waiting.append(piece)
