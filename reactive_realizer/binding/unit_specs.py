"""The entries of bindings, and those among them that fit a behavior (thesis 8.6.1)."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from reactive_realizer.binding.unit_spec import UnitSpec, normalized
from reactive_realizer.bml.behavior import Behavior

_MODE = "mode"
"""The attribute that selects the hands. If a behavior omits it, the realizer chooses the hands."""

_LEXEME = "lexeme"
"""The attribute in which most entries differ."""

_CACHE_SIZE = 1000
"""Number of cached matches. Most behaviors are repeated often."""
_LONGEST_KEPT = 1000
"""Characters of the attributes for which the matches are remembered; a client may send more."""

_Attributes = tuple[tuple[str, str], ...]

_LexemeKey = tuple[str, str, str | None]
"""Namespace and name of an element, and its `normalized` lexeme or None."""


@dataclass(frozen=True, slots=True)
class UnitSpecs:
    """The entries of one or more binding files, in order.

    Attributes:
        specs: which unit plays which behaviors.
    """

    specs: tuple[UnitSpec, ...]
    _by_lexeme: Mapping[_LexemeKey, list[UnitSpec]] = field(init=False, repr=False)
    _matches: Callable[[str, str, _Attributes], tuple[UnitSpec, ...]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_by_lexeme", _by_lexeme(self.specs))
        object.__setattr__(self, "_matches", lru_cache(_CACHE_SIZE)(self._match))

    def match(self, behavior: str, namespace: str, attributes: Mapping[str, str]) -> tuple[UnitSpec, ...]:
        """Return the entries that fit a behavior, best first.

        Entries keep the order of the files. If the behavior does not name its hands, entries for specific hands also
        match, after all others. If it does, only its best match may leave the hands open: another such entry might use
        the other hand.

        Args:
            behavior: name of its element.
            namespace: of its element.
            attributes: of the behavior (`behavior_attributes`).
        """
        size = sum(len(name) + len(value) for name, value in attributes.items())
        matches = self._matches if size <= _LONGEST_KEPT else self._match
        return matches(behavior, namespace, tuple(attributes.items()))

    def _match(self, behavior: str, namespace: str, attributes: _Attributes) -> tuple[UnitSpec, ...]:
        values = normalized(dict(attributes))
        others = self._by_lexeme.get((namespace, behavior, None), ())
        specs = self._by_lexeme.get((namespace, behavior, values.get(_LEXEME)), others)
        exact = [spec for spec in specs if spec.fits(values)]
        if _MODE in values:
            return (*exact[:1], *(spec for spec in exact[1:] if _MODE in spec.constraints))
        return (*exact, *(spec for spec in specs if _MODE in spec.constraints and spec.fits(values, _MODE)))

    def binds(self, behavior: Behavior) -> bool:
        """Return whether any entry plays the element of a behavior."""
        return (behavior.namespace, behavior.name, None) in self._by_lexeme

    def constrained_values(self, behavior: str, namespace: str) -> Mapping[str, tuple[str, ...]]:
        """Return the attributes that the entries for an element constrain, each with its values in these entries."""
        values: dict[str, dict[str, None]] = {}
        for spec in self.specs:
            if (spec.behavior, spec.namespace) == (behavior, namespace):
                for name, value in spec.constraints.items():
                    values.setdefault(name, {})[value] = None
        return {name: tuple(own) for name, own in values.items()}


def _by_lexeme(specs: Iterable[UnitSpec]) -> dict[_LexemeKey, list[UnitSpec]]:
    """Index the entries by element and lexeme, in order. Entries without a lexeme are listed under every lexeme."""
    index: dict[_LexemeKey, list[UnitSpec]] = {}
    for spec in specs:
        element, lexeme = (spec.namespace, spec.behavior), spec.normalized_constraints.get(_LEXEME)
        general = index.setdefault((*element, None), [])
        if lexeme is not None:
            index.setdefault((*element, lexeme), [*general]).append(spec)
            continue
        for known, entries in index.items():
            if known[:2] == element:
                entries.append(spec)
    return index
