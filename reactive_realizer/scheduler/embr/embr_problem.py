"""Behaviors that are timed together, in an order that does not depend on how the block was written."""

from collections.abc import Mapping, Sequence

from reactive_realizer.scheduler.embr.spans import knots_of, spans_of
from reactive_realizer.scheduler.problem import Item, Node, Point, Precedence, Tie


class EmbrProblem:
    """One problem for the program.

    Attributes:
        items: by id.
        constraints: required ones first, of these and of the others first the `at` ones; the last goes first.
        given: times (s after the start of the block, None while unknown) of what they can be tied to and is not theirs.
        knots: of each behavior, the indices of the points that matter.
        spans: of all behaviors.
    """

    def __init__(
        self, items: Sequence[Item], constraints: Sequence[Tie | Precedence], given: Mapping[Node, float | None]
    ) -> None:
        self.items = {item.behavior.id: item for item in sorted(items, key=lambda item: item.behavior.id)}
        self.constraints = sorted(constraints, key=_rank)
        self.given = given
        self.knots = knots_of(self.items.values(), constraints)
        self.spans = tuple(spans_of(self.items.values(), self.knots))

    def known(self, node: Node) -> float | None:
        """The time (s) of what is given and known."""
        return self.given.get(node)

    def movable(self, node: Node) -> Node | str | None:
        """What moves with a node: its behavior, or the unknown time that it is; nothing moves with a known one."""
        if self.known(node) is not None:
            return None
        return node.behavior if isinstance(node, Point) and node not in self.given else node


def _rank(constraint: Tie | Precedence) -> tuple[bool, bool, str, str, float]:
    owner = constraint.owner or "" if isinstance(constraint, Tie) else constraint.name
    return not constraint.required, isinstance(constraint, Precedence), owner, constraint.text, constraint.offset
