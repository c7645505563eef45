"""One entry of a gesture binding."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType

_NONE: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True, eq=False)
class UnitSpec:
    """Which behaviors an entry is for, and what plays them (thesis 8.7.3, fig. 8.11).

    Attributes:
        behavior: name of the behavior's element, such as "gesture".
        namespace: of that element.
        constraints: attribute -> value that a behavior must have; an attribute of another namespace is `{uri}name`.
        unit: kind of the unit that plays it: ProcAnimation (a file as it is), Gesture (a file with preparation and
            retraction), or what the engine knows.
        file: the unit's file, None for a unit without one, or with one that the behavior names.
        parameter_map: attribute of the behavior -> parameter of the unit.
        defaults: parameter of the unit -> value where the behavior says nothing.
        place: its file and line, for people.
        wanted: the constraints, `comparable`.
    """

    behavior: str
    namespace: str
    constraints: Mapping[str, str]
    unit: str
    file: str | None
    parameter_map: Mapping[str, str]
    defaults: Mapping[str, str]
    place: str
    wanted: Mapping[str, str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "wanted", comparable(self.constraints))

    def fits(self, said: Mapping[str, str], leaving: str | None = None) -> bool:
        """Whether a behavior meets every constraint.

        Args:
            said: its attributes, `comparable`.
            leaving: an attribute whose constraint need not be met.
        """
        left = self.wanted.keys() & {leaving}
        wanted = {name: self.wanted[name] for name in self.wanted.keys() - left} if left else self.wanted
        return wanted.items() <= said.items()

    def parameters(self, attributes: Mapping[str, str], own: Mapping[str, str] = _NONE) -> dict[str, str]:
        """The unit's parameters for a behavior: what it says, else the defaults.

        Args:
            attributes: of the behavior, as a binding sees them.
            own: what it says by names of the unit, which no map knows.
        """
        said = {to: attributes[name] for name, to in self.parameter_map.items() if name in attributes}
        return {**self.defaults, **own, **said}


def comparable(attributes: Mapping[str, str]) -> dict[str, str]:
    """Attributes with their words in the one form in which they compare: in any case, `_` like `-`."""
    return {name: _word(value) for name, value in attributes.items()}


@lru_cache
def _word(text: str) -> str:
    return text.strip().casefold().replace("_", "-")
