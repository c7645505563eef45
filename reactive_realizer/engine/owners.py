"""The units that own resources while others begin."""

from collections.abc import Collection, Iterable, Iterator
from typing import Generic, TypeVar

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.planunit.body_parts import BodyPart
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState

K = TypeVar("K")


class _UnitsBy(Generic[K]):
    """Units by keys that several may have, in order of addition."""

    def __init__(self) -> None:
        self._units: dict[K, dict[PlanUnit, None]] = {}

    def add(self, unit: PlanUnit, keys: Iterable[K]) -> None:
        for key in keys:
            self._units.setdefault(key, {})[unit] = None

    def remove(self, unit: PlanUnit, keys: Iterable[K]) -> None:
        for key in keys:
            units = self._units[key]
            del units[unit]
            if not units:
                del self._units[key]

    def of(self, keys: Iterable[K]) -> Iterator[PlanUnit]:
        for key in keys:
            yield from self._units.get(key, ())

    def items(self) -> Iterable[tuple[K, Collection[PlanUnit]]]:
        return self._units.items()


class Owners:
    """The units that others may exclude, by their resources, groups and parts of the body.

    They are those that play, and those that ended since the last tick: in a late tick, they may have been playing when
    another unit was to begin.
    """

    def __init__(self) -> None:
        self._order: dict[PlanUnit, int] = {}
        self._added = 0
        self._taken: dict[PlanUnit, tuple[frozenset[str], tuple[str, ...], frozenset[BodyPart]]] = {}
        """The resources, the group and the parts of the body of each unit when it was added."""
        self._by_resource: _UnitsBy[str] = _UnitsBy()
        self._by_group: _UnitsBy[str] = _UnitsBy()
        self._by_part: dict[bool, _UnitsBy[BodyPart]] = {True: _UnitsBy(), False: _UnitsBy()}
        """By whether they accompany others."""

    def add(self, unit: PlanUnit) -> None:
        """Add a unit that has begun, if it is not among them; one that takes nothing excludes no other one."""
        if unit in self._order:
            return
        resources, groups, parts = unit.resources, () if unit.group is None else (unit.group,), unit.parts
        if not (resources or groups or parts):
            return
        self._added += 1
        self._order[unit] = self._added
        self._taken[unit] = resources, groups, parts
        self._by_resource.add(unit, resources)
        self._by_group.add(unit, groups)
        self._by_part[unit.accompanies].add(unit, parts)

    def remove(self, unit: PlanUnit) -> None:
        """Remove a unit, if it is among them."""
        if self._order.pop(unit, None) is None:
            return
        resources, groups, parts = self._taken.pop(unit)
        self._by_resource.remove(unit, resources)
        self._by_group.remove(unit, groups)
        self._by_part[unit.accompanies].remove(unit, parts)

    def kept_from(self, unit: PlanUnit, time: GlobalTime) -> frozenset[str]:
        """The resources that others keep from a unit at a time; what accompanies keeps none from what was asked for."""
        if not self._order:
            return frozenset()
        owned = self._by_resource.items()
        return frozenset([resource for resource, units in owned if any(_keeps(other, unit, time) for other in units)])

    def excluded_by(self, unit: PlanUnit, time: GlobalTime) -> tuple[list[PlanUnit], list[PlanUnit]]:
        """The units that cannot play together with one that begins at a time: those that stay, and those that leave.

        Both are in the order in which they were added. A unit leaves if it only returns to rest, or accompanies others
        while the one that begins does not.
        """
        if not self._order:
            return [], []
        rivals = {*self._by_resource.of(unit.resources), *self._by_part[not unit.accompanies].of(unit.parts)}
        if unit.group is not None:
            rivals.update(self._by_group.of((unit.group,)))
        if not rivals:
            return [], []
        excluded = sorted((other for other in rivals if unit.excludes(other)), key=self._order.__getitem__)
        staying = [each for each in excluded if _keeps(each, unit, time)]
        leaving = [each for each in excluded if each.state is UnitState.IN_EXEC and each not in staying]
        return staying, leaving


def _keeps(unit: PlanUnit, other: PlanUnit, time: GlobalTime) -> bool:
    """Return whether a unit holds its resources at a time, rather than releasing them to another one that begins."""
    if unit.accompanies and not other.accompanies:
        return False
    asked = other.accompanies and not unit.accompanies
    match unit.state:
        case UnitState.IN_EXEC:
            return asked or not unit.subsiding(time)
        case UnitState.DONE:
            return not is_due(unit.points[-1].peg.value, time) and not unit.subsiding(time)
        case _:
            return False
