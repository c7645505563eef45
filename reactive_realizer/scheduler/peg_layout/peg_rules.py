"""The rules by which pegs follow other pegs, before the pegs are made."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from graphlib import TopologicalSorter
from typing import NamedTuple


class Position(NamedTuple):
    """A time at an offset (s) from a root."""

    root: int
    offset: float

    def moved(self, distance: float) -> "Position":
        """The position that is later by a distance (s)."""
        return Position(self.root, self.offset + distance)


class AfterStart(NamedTuple):
    """At an offset (s) from the start of the block; a given root is there by itself."""

    offset: float
    positions: tuple[()] = ()


class AtPosition(NamedTuple):
    """At a position."""

    positions: tuple[Position]


class Between(NamedTuple):
    """At a fraction of the way between two positions, so that phases between them stretch alike."""

    positions: tuple[Position, Position]
    ratio: float


Natural = AfterStart | AtPosition | Between


class PlannedPeg(NamedTuple):
    """A peg to be made: of a root, with its bounds or as it naturally is; where that is the same, there is one."""

    root: int
    bounded: bool


@dataclass(slots=True)
class PegRule:
    """The dependencies of the peg of a root.

    Attributes:
        natural: its place without bounds.
        before: positions that it may not come after; they count as they naturally are.
        floors: positions that do not come after it whatever ``before`` says.
        after: positions that it may not come before.
        ceilings: positions that do not come before it whatever ``after`` says.
    """

    natural: Natural
    before: list[Position] = field(default_factory=list)
    floors: list[Position] = field(default_factory=list)
    after: list[Position] = field(default_factory=list)
    ceilings: list[Position] = field(default_factory=list)

    @property
    def bounds(self) -> list[PlannedPeg]:
        """The pegs that its bounds depend on."""
        others = (*self.floors, *self.after, *self.ceilings)
        return [
            *(PlannedPeg(position.root, bounded=False) for position in self.before),
            *(PlannedPeg(position.root, bounded=True) for position in others),
        ]


def ordered_pegs(rules: Mapping[int, PegRule]) -> list[PlannedPeg]:
    """All pegs, each after those that it depends on.

    Raises:
        graphlib.CycleError: one depends on itself; its second argument is a circle of pegs, each needed for the next.
    """
    needs: dict[PlannedPeg, Sequence[PlannedPeg]] = {}
    named = {position.root for rule in rules.values() for position in rule.before}
    for root, rule in rules.items():
        bounded = PlannedPeg(root, bounded=True)
        needs[bounded] = [PlannedPeg(position.root, bounded=True) for position in rule.natural.positions]
        if rule.before or rule.after or root in named:
            natural = PlannedPeg(root, bounded=False)
            needs[natural], needs[bounded] = needs.pop(bounded), [natural, *rule.bounds]
    return _in_turn(needs) or list(TopologicalSorter(needs).static_order())


def _in_turn(needs: Mapping[PlannedPeg, Sequence[PlannedPeg]]) -> list[PlannedPeg]:
    """All pegs as they come, if each comes after those that it needs, as in almost all plans; else none."""
    made: dict[PlannedPeg, None] = {}
    for peg, needed in needs.items():
        for each in needed:
            if each not in made:
                return []
        made[peg] = None
    return list(made)
