"""The tree of one top-level element while it is read."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from lxml import etree

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.names import BLOCK, Location
from reactive_realizer.bml.trees import Tree, shown
from reactive_realizer.errors import Fault
from reactive_realizer.limits import Limits


@dataclass(frozen=True, slots=True)
class Root:
    """A well-formed top-level element, and where each element of its tree starts."""

    tree: Tree
    locations: Mapping[Tree, Location]


class RootBuilder:
    """Builds the tree of one top-level element, or finds why it is refused.

    Attributes:
        id: as its start tag says, unchecked; "bml" without one.
        open: the elements that have begun and not ended: local name and place.
    """

    def __init__(self, attributes: Mapping[str, str], limits: Limits) -> None:
        self.id = shown(attributes.get("id", "")) or BLOCK
        self.open: list[tuple[str, Location]] = []
        self._limits = limits
        self._refused: Fault | None = None
        self._builder: Any = etree.TreeBuilder()  # its stubs lack the prefixes
        self._locations: dict[Tree, Location] = {}

    def start(self, name: str, attributes: dict[str, str], prefixes: dict[str | None, str], location: Location) -> None:
        """Takes a start tag, its names in Clark notation."""
        self.open.append((name.rpartition("}")[2], location))
        if len(self.open) > self._limits.xml_depth:
            self._refuse("too-deep", location, limit=self._limits.xml_depth)
        if len(attributes) + len(prefixes) > self._limits.xml_attributes:
            self._refuse("too-many-attributes", location, limit=self._limits.xml_attributes)
        if self._refused:
            return
        try:
            tree = self._builder.start(name, attributes, prefixes)
        except ValueError as unfit:  # lxml is stricter than expat about the URI of a namespace
            self._refuse("malformed-xml", location, reason=shown(str(unfit)))
        else:
            self._locations[tree] = location

    def text(self, text: str) -> None:
        """Takes text."""
        if not self._refused:
            self._builder.data(text)

    def end(self, name: str) -> None:
        """Takes an end tag."""
        self.open.pop()
        if not self._refused:
            self._builder.end(name)

    def close(self) -> Root | Problem:
        """What came of it, after its end tag."""
        if self._refused:
            return Problem(self._refused, self.id)
        return Root(self._builder.close(), self._locations)

    def _refuse(self, code: str, location: Location, **details: object) -> None:
        self._refused = self._refused or Fault(code, details, location.line, location.column)
