"""What hangs on a time from outside, piece by piece."""

from collections import defaultdict, deque
from collections.abc import Sequence

from reactive_realizer.scheduler.convex.causes import Rank
from reactive_realizer.scheduler.convex.longest_path import components
from reactive_realizer.scheduler.convex.roots import Roots


class Branches:
    """The pieces into which falls what is tied to times from outside, and what each of them hangs on.

    A piece is a point, or those of a behavior with rigid phases between them, which stay together when the first has
    passed; so do two speeches in a row. It hangs on what it is tied to on the shortest way from outside: so it follows
    the time from outside though others that are tied to it have passed, and stays with a word whose speech cannot
    follow any more.

    Attributes:
        pieces: of each node the first one of its piece.
        rigid: those of pieces of several points.
        hosts: the first node of each piece -> that of the piece that it hangs on, or the node from outside.
    """

    def __init__(self, roots: Roots, outside: Sequence[int]) -> None:
        """Of all that is tied to some nodes."""
        self.pieces: Sequence[int] = range(len(roots))
        self.rigid: set[int] = set()
        self.hosts: dict[int, int] = {}
        if outside:  # else nothing hangs on anything
            self._find(roots, outside)

    def _find(self, roots: Roots, outside: Sequence[int]) -> None:
        inner = [(one, other) for one, other, cause in roots.links if cause.rank is Rank.BEHAVIOR]
        held = {node for pair in inner for node in pair}
        rigid = [(one, other) for one, other, _ in roots.links if {one, other} <= held]
        self.pieces = components(len(roots), rigid)
        self.rigid = {self.pieces[node] for node in held}
        members: defaultdict[int, list[int]] = defaultdict(list)
        for node, piece in enumerate(self.pieces):
            members[piece].append(node)
        waiting = deque(outside)
        while waiting:
            host = waiting.popleft()
            tied = (self.pieces[other] for node in members[host] for other in roots.neighbors(node))
            for piece in tied:
                if piece not in self.hosts and piece not in outside and piece != host:
                    self.hosts[piece] = host
                    waiting.append(piece)
