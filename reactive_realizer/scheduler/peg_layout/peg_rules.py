"""The rules that pegs follow, root by root, before they are made."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from graphlib import TopologicalSorter
from typing import NamedTuple


class Position(NamedTuple):
    """A time at an offset (s) from a root."""

    root: int
    offset: float

    def moved(self, distance: float) -> "Position":
        """So much (s) later."""
        return Position(self.root, self.offset + distance)


class Given(NamedTuple):
    """The root has a peg already."""

    @property
    def positions(self) -> tuple[Position, ...]:
        """What it hangs on."""
        return ()


class AfterStart(NamedTuple):
    """A cluster begins with this root, so long (s) after the block: as early as may be (thesis 7.24)."""

    offset: float

    @property
    def positions(self) -> tuple[Position, ...]:
        """What it hangs on, besides the start of the block."""
        return ()


class AtPosition(NamedTuple):
    """At an offset from another root."""

    position: Position

    @property
    def positions(self) -> tuple[Position, ...]:
        """What it hangs on."""
        return (self.position,)


class Between(NamedTuple):
    """At a fraction of the way between two positions: retimed, everything there stretches alike."""

    before: Position
    after: Position
    ratio: float

    @property
    def positions(self) -> tuple[Position, ...]:
        """What it hangs on."""
        return self.before, self.after


Natural = Given | AfterStart | AtPosition | Between


class Step(NamedTuple):
    """A peg to be made: of a root, with its bounds or as it naturally is; where that is the same, there is one."""

    root: int
    bounded: bool


@dataclass(slots=True)
class PegRule:
    """What the peg of a root hangs on.

    Attributes:
        natural: where it is, but for the bounds.
        before: positions that it may not come after; they count as they naturally are.
        floors: positions that are not to come after it whatever ``before`` says.
        after: positions that it may not come before.
        ceilings: positions that are to come after it whatever ``after`` says.
    """

    natural: Natural
    before: list[Position] = field(default_factory=list)
    floors: list[Position] = field(default_factory=list)
    after: list[Position] = field(default_factory=list)
    ceilings: list[Position] = field(default_factory=list)

    @property
    def bounds(self) -> list[Step]:
        """What its bounds hang on."""
        others = (*self.floors, *self.after, *self.ceilings)
        return [
            *(Step(position.root, bounded=False) for position in self.before),
            *(Step(position.root, bounded=True) for position in others),
        ]


def steps(rules: Mapping[int, PegRule]) -> list[Step]:
    """All pegs, each after those that it hangs on.

    Raises:
        graphlib.CycleError: one hangs on itself; its second argument is a circle of steps, each needed for the next.
    """
    needs: dict[Step, list[Step]] = {}
    named = {position.root for rule in rules.values() for position in rule.before}
    for root, rule in rules.items():
        natural, bounded = Step(root, bounded=False), Step(root, bounded=True)
        positions = [Step(position.root, bounded=True) for position in rule.natural.positions]
        if rule.before or rule.after or root in named:
            needs[natural], needs[bounded] = positions, [natural, *rule.bounds]
        else:
            needs[bounded] = positions
    return _in_turn(needs) or list(TopologicalSorter(needs).static_order())


def _in_turn(needs: Mapping[Step, Sequence[Step]]) -> list[Step]:
    """All steps as they come, if each comes after those that it needs, as in almost all plans; else none."""
    made: dict[Step, None] = {}
    for step, needed in needs.items():
        if not made.keys() >= set(needed):
            return []
        made[step] = None
    return list(made)
