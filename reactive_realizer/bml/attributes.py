"""How the text of an attribute becomes a value; a dataclass field says it once, in its metadata.

The parser, the support tables and ``/capabilities`` all read it back with `attributes_of`.
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
    """What values an attribute may have."""

    @property
    def description(self) -> str:
        """For people: the kind of value, its range or words."""

    def read(self, text: str, limits: Limits) -> object:
        """The value written as `text`.

        Raises:
            RealizerError: with the reason, without the place.
        """


@dataclass(frozen=True, slots=True)
class Attribute:
    """One attribute of an element.

    Attributes:
        name: in XML, without namespace.
        field: of the dataclass that holds its value.
        type: what it may be.
        required: whether an element without it is refused.
        default: its value where it is not written.
        continuous: whether it stands in the namespace of BMLA or of BMLT; else in none.
        spellings: its names in Clark notation; where several are written the first one counts.
    """

    name: str
    field: str
    type: AttributeType
    required: bool
    default: object
    continuous: bool
    spellings: tuple[str, ...] = dataclasses.field(init=False)

    def __post_init__(self) -> None:
        qualified = tuple(f"{{{namespace}}}{self.name}" for namespace in CONTINUOUS)
        object.__setattr__(self, "spellings", qualified if self.continuous else (self.name,))


_FOUND: dict[type, tuple[Attribute, ...]] = {}
"""Of each dataclass that was asked for; every behavior that is read asks."""


def attribute(kind: AttributeType, name: str | None = None, continuous: bool = False) -> Mapping[str, Any]:
    """Metadata of a field that holds an attribute.

    Args:
        kind: what values it may have.
        name: its name; without one, the field's in camelCase.
        continuous: whether it is BMLA's and BMLT's; else it stands without a namespace.
    """
    return {_METADATA: (kind, name, continuous)}


def attributes_of(data: type) -> tuple[Attribute, ...]:
    """The attributes that the fields of a dataclass hold, in their order."""
    if data not in _FOUND:
        _FOUND[data] = tuple(_attribute(each) for each in dataclasses.fields(data) if _METADATA in each.metadata)
    return _FOUND[data]


def _attribute(each: "dataclasses.Field[Any]") -> Attribute:
    kind, given, continuous = each.metadata[_METADATA]
    name = given or _camel(each.name)
    required = each.default is dataclasses.MISSING
    return Attribute(name, each.name, kind, required, None if required else each.default, continuous)


def _camel(name: str) -> str:
    return re.sub(r"_(\w)", lambda match: match[1].upper(), name)
