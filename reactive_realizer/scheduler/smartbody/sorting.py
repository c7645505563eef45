"""The order in which Elckerlyc schedules behaviors (thesis 7.3.5): what bends least goes first."""

from collections import defaultdict
from collections.abc import Iterable, Sequence

from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.problem import Item, Node, Point, SchedulingProblem, Tie


def sort_items(problem: SchedulingProblem, ties: OffsetUnionFind[Node]) -> list[Item]:
    """Rigid behaviors whose time is given; then all others, a rigid one before the behaviors it is in a cycle with.

    Within these groups behaviors stay in document order. (The thesis's third group, completely flexible behaviors,
    follows with the first behavior of that kind.)
    """
    grounded = [item for item in problem.items if item.timing.rigid and _is_grounded(item, ties)]
    order = [item for item in problem.items if item not in grounded]
    groups = _flexible_groups(problem)
    for item in [item for item in order if item.timing.rigid]:
        partners = _cycle_partners(item.behavior.id, groups, problem.ties)
        places = [i for i, other in enumerate(order) if other.behavior.id in partners]
        if places and places[0] < order.index(item):
            order.remove(item)
            order.insert(places[0], item)
    return grounded + order


def _is_grounded(item: Item, ties: OffsetUnionFind[Node]) -> bool:
    nodes = (Point(item.behavior.id, sync) for sync in item.timing.points)
    return any(not isinstance(ties.find(node)[0], Point) for node in nodes)


def _flexible_groups(problem: SchedulingProblem) -> list[set[str]]:
    """Behaviors that are not rigid and are connected with each other."""
    rigid = {item.behavior.id for item in problem.items if item.timing.rigid}
    links = [pair for tie in problem.ties if (pair := _behaviors(tie)) is not None]
    return _connected(links, without=rigid)


def _cycle_partners(rigid: str, groups: Sequence[set[str]], ties: Sequence[Tie]) -> set[str]:
    """The groups that hang on two or more different points of a behavior."""
    touched: defaultdict[str, set[str]] = defaultdict(set)
    for tie in ties:
        for here, there in ((tie.left, tie.right), (tie.right, tie.left)):
            if isinstance(here, Point) and isinstance(there, Point) and here.behavior == rigid:
                touched[there.behavior].add(here.sync)
    partners = [group for group in groups if len(_all_of(touched[id_] for id_ in group & touched.keys())) > 1]
    return _all_of(partners)


def _all_of(sets: Iterable[set[str]]) -> set[str]:
    return set().union(*sets)


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
