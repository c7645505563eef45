"""What the pegs of a plan are made of, root by root, before they are made."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from graphlib import TopologicalSorter
from typing import NamedTuple


class Spot(NamedTuple):
    """A time at a distance (s) from a root."""

    root: int
    distance: float

    def moved(self, distance: float) -> "Spot":
        """So much (s) later."""
        return Spot(self.root, self.distance + distance)


class Given(NamedTuple):
    """The root's own time comes from outside."""

    @property
    def spots(self) -> tuple[Spot, ...]:
        """What it hangs on."""
        return ()


class First(NamedTuple):
    """A cluster begins with this root, so long (s) after the block: as early as may be (thesis 7.24)."""

    offset: float

    @property
    def spots(self) -> tuple[Spot, ...]:
        """What it hangs on."""
        return ()


class Hung(NamedTuple):
    """At a distance from another root."""

    spot: Spot

    @property
    def spots(self) -> tuple[Spot, ...]:
        """What it hangs on."""
        return (self.spot,)


class Between(NamedTuple):
    """At a fraction of the way between two spots: retimed, everything there stretches alike."""

    before: Spot
    after: Spot
    ratio: float

    @property
    def spots(self) -> tuple[Spot, ...]:
        """What it hangs on."""
        return self.before, self.after


Natural = Given | First | Hung | Between


class Step(NamedTuple):
    """A peg to be made: of a root, with its bounds or as it naturally is; where that is the same, there is one."""

    root: int
    bounded: bool


@dataclass(slots=True)
class Recipe:
    """How the peg of a root is made.

    Attributes:
        natural: where it is, but for the bounds.
        before: spots that it may not come after; they count as they naturally are.
        floors: spots that are not to come after it whatever ``before`` says.
        after: spots that it may not come before.
        ceilings: spots that are to come after it whatever ``after`` says.
    """

    natural: Natural
    before: list[Spot] = field(default_factory=list)
    floors: list[Spot] = field(default_factory=list)
    after: list[Spot] = field(default_factory=list)
    ceilings: list[Spot] = field(default_factory=list)

    @property
    def bounds(self) -> list[Step]:
        """What its bounds hang on."""
        others = (*self.floors, *self.after, *self.ceilings)
        return [
            *(Step(spot.root, bounded=False) for spot in self.before),
            *(Step(spot.root, bounded=True) for spot in others),
        ]


def steps(recipes: Mapping[int, Recipe]) -> list[Step]:
    """All pegs, each after those that it hangs on.

    Raises:
        graphlib.CycleError: one hangs on itself; its second argument is a circle of steps, each needed for the next.
    """
    needs: dict[Step, list[Step]] = {}
    named = {spot.root for recipe in recipes.values() for spot in recipe.before}
    for root, recipe in recipes.items():
        natural, bounded = Step(root, bounded=False), Step(root, bounded=True)
        spots = [Step(spot.root, bounded=True) for spot in recipe.natural.spots]
        if recipe.before or recipe.after or root in named:
            needs[natural], needs[bounded] = spots, [natural, *recipe.bounds]
        else:
            needs[bounded] = spots
    return _in_turn(needs) or list(TopologicalSorter(needs).static_order())


def _in_turn(needs: Mapping[Step, Sequence[Step]]) -> list[Step]:
    """All steps as they come, if each comes after those that it needs, as in almost all plans; else none."""
    made: dict[Step, None] = {}
    for step, needed in needs.items():
        if not made.keys() >= set(needed):
            return []
        made[step] = None
    return list(made)
