"""Behaviors that `at` constraints hold together (thesis 7.1.3.1)."""

from collections.abc import Collection
from dataclasses import dataclass

from reactive_realizer.scheduler.offset_union_find import OffsetUnionFind
from reactive_realizer.scheduler.plan_view import PlanView
from reactive_realizer.scheduler.problem import Point, Tie


@dataclass(frozen=True, slots=True)
class Cluster:
    """Behaviors that are tied to each other.

    Attributes:
        behaviors: their ids.
        ties: those of them and between them.
    """

    behaviors: frozenset[str]
    ties: tuple[Tie, ...]

    @property
    def grounded(self) -> bool:
        """Whether it is tied to the block's start or the outside (7.20, 7.35), or to what is none of its behaviors."""
        nodes = (node for tie in self.ties for node in tie.nodes)
        return any(not isinstance(node, Point) or node.behavior not in self.behaviors for node in nodes)

    def joins_late(self, plan: PlanView) -> bool:
        """Whether the outside brings it before the start of its block.

        What has lost whom it was tied to stays where it was too.
        """
        tied = [tie for tie in self.ties if not plan.outer.keys().isdisjoint(tie.nodes)]
        times = [time for tie in tied for node in tie.nodes if (time := plan.time(node)) is not None]
        lost = any(isinstance(node, Point) and node not in plan.times for tie in self.ties for node in tie.nodes)
        return lost or (plan.start is not None and any(time < plan.start for time in times))


def clusters_of(plan: PlanView, behaviors: Collection[str]) -> list[Cluster]:
    """The clusters of some behaviors of a plan, as if there were no others (7.16, 7.17)."""
    groups = OffsetUnionFind[str]()
    own: dict[str, list[Tie]] = {id_: [] for id_ in behaviors}
    for tie in plan.kept:
        ids = [n.behavior for n in tie.nodes if isinstance(n, Point) and n.behavior in own]
        if isinstance(tie, Tie) and ids:
            own[ids[0]].append(tie)
            groups.union(ids[0], ids[-1])
    members: dict[str, list[str]] = {}
    for id_ in behaviors:
        members.setdefault(groups.find(id_)[0], []).append(id_)
    return [Cluster(frozenset(ids), tuple(tie for id_ in sorted(ids) for tie in own[id_])) for ids in members.values()]
