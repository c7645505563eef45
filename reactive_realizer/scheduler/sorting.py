"""The order in which Elckerlyc schedules behaviors (thesis 7.3.5): what bends least goes first."""

from collections.abc import Sequence

from reactive_realizer.scheduler.equalities import Equalities
from reactive_realizer.scheduler.problem import Item, Node, Point, Problem, Tie


def sort_items(problem: Problem, equalities: Equalities[Node]) -> list[Item]:
    """Rigid behaviors whose time is given; then all others, a rigid one before the behaviors it is in a cycle with.

    Within these groups behaviors stay in document order. (The thesis's third group, completely flexible behaviors,
    follows with the first behavior of that kind.)
    """
    grounded = [item for item in problem.items if item.timing.rigid and _is_grounded(item, equalities)]
    order = [item for item in problem.items if item not in grounded]
    for item in [item for item in order if item.timing.rigid]:
        partners = _cycle_partners(item, problem)
        places = [i for i, other in enumerate(order) if other.behavior.id in partners]
        if places and places[0] < order.index(item):
            order.remove(item)
            order.insert(places[0], item)
    return grounded + order


def _is_grounded(item: Item, equalities: Equalities[Node]) -> bool:
    nodes = (Point(item.behavior.id, sync) for sync in item.timing.points)
    return any(not isinstance(equalities.find(node)[0], Point) for node in nodes)


def _cycle_partners(item: Item, problem: Problem) -> set[str]:
    """Non-rigid behaviors, connected with each other, that hang on two or more different points of the item."""
    rigid = {other.behavior.id for other in problem.items if other.timing.rigid}
    links = [pair for tie in problem.ties if (pair := _behaviors(tie)) is not None]
    partners: set[str] = set()
    for group in _connected(links, without=rigid):
        if len(_touched_points(item.behavior.id, group, problem.ties)) > 1:
            partners |= group
    return partners


def _behaviors(tie: Tie) -> tuple[str, str] | None:
    if isinstance(tie.left, Point) and isinstance(tie.right, Point):
        return tie.left.behavior, tie.right.behavior
    return None


def _connected(links: Sequence[tuple[str, str]], without: set[str]) -> list[set[str]]:
    groups: list[set[str]] = []
    for pair in links:
        members = set(pair) - without
        touching = [group for group in groups if group & members]
        groups = [group for group in groups if group not in touching]
        if members:
            groups.append(members.union(*touching))
    return groups


def _touched_points(rigid: str, group: set[str], ties: Sequence[Tie]) -> set[str]:
    points = set()
    for tie in ties:
        for here, there in ((tie.left, tie.right), (tie.right, tie.left)):
            if isinstance(here, Point) and isinstance(there, Point) and here.behavior == rigid:
                points |= {here.sync} if there.behavior in group else set()
    return points
