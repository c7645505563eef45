"""Declares attributes of elements as metadata of dataclass fields.

The parser, the support tables and ``/capabilities`` read the declarations with `attributes_of`.
"""

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from reactive_realizer.bml.names import CONTINUOUS
from reactive_realizer.limits import Limits

_METADATA = "bml attribute"


class AttributeType(Protocol):
    """The type of an attribute."""

    @property
    def description(self) -> str:
        """For documentation: the kind of value, its range or words."""

    def read(self, text: str, limits: Limits) -> object:
        """The value of a text.

        Raises:
            RealizerError: with the reason, without a location.
        """


@dataclass(frozen=True, slots=True)
class Attribute:
    """One attribute of an element.

    Attributes:
        name: in XML, without namespace.
        field: of the dataclass that holds its value.
        type: of its values.
        required: whether an element without it is refused.
        default: its value if it is not written.
        continuous: whether it is in the namespace of BMLA or BMLT; otherwise, it is in none.
        synonyms: other names that it may have.
        spellings: its names in Clark notation; if several are written, the first one counts.
    """

    name: str
    field: str
    type: AttributeType
    required: bool
    default: object
    continuous: bool
    synonyms: tuple[str, ...] = ()
    spellings: tuple[str, ...] = dataclasses.field(init=False)

    def __post_init__(self) -> None:
        qualified = tuple(f"{{{namespace}}}{self.name}" for namespace in CONTINUOUS)
        object.__setattr__(self, "spellings", qualified if self.continuous else (self.name, *self.synonyms))


_CACHE: dict[type, tuple[Attribute, ...]] = {}
"""Cache of `attributes_of`, which is called for every behavior."""


def attribute(
    kind: AttributeType, name: str | None = None, continuous: bool = False, synonyms: tuple[str, ...] = ()
) -> Mapping[str, Any]:
    """Metadata of a field that holds an attribute.

    Args:
        kind: its type.
        name: its name; by default, that of the field in camelCase.
        continuous: whether it is in the namespace of BMLA or BMLT; else it is in none.
        synonyms: other names that it may have.
    """
    return {_METADATA: (kind, name, continuous, synonyms)}


def attributes_of(data: type) -> tuple[Attribute, ...]:
    """The attributes that a dataclass declares, in the order of its fields."""
    if data not in _CACHE:
        _CACHE[data] = tuple(_attribute(each) for each in dataclasses.fields(data) if _METADATA in each.metadata)
    return _CACHE[data]


def _attribute(each: "dataclasses.Field[Any]") -> Attribute:
    kind, given, continuous, synonyms = each.metadata[_METADATA]
    name = given or _camel(each.name)
    required = each.default is dataclasses.MISSING
    return Attribute(name, each.name, kind, required, None if required else each.default, continuous, synonyms)


def _camel(name: str) -> str:
    return re.sub(r"_(\w)", lambda match: match[1].upper(), name)
