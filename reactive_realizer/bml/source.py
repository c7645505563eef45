"""The attributes of the elements of one block."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, Final
from xml.sax.saxutils import escape

from lxml import etree

from reactive_realizer.bml.attributes import Attribute
from reactive_realizer.bml.block_names import BlockNames
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.root_builder import Root
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import (
    Tree,
    extensions_of,
    is_continuous,
    is_part,
    listed,
    name_of,
    names_in,
    shown,
    stray_text_of,
)
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits

_MOST_COPIES: Final = 10
"""Times the size of a document that the texts kept of it may have together."""


class Source:
    """One block as it is written: where its elements stand and what their attributes say.

    Attributes:
        tree: the block's element.
        limits: what may be read.
        names: what references in it can name.
    """

    def __init__(self, root: Root, limits: Limits) -> None:
        self.tree = root.tree
        self.limits = limits
        self.names = BlockNames(root.tree)
        self._written = 0
        self._locations = dict(root.locations)

    def location(self, tree: Tree) -> Location:
        """Where an element starts."""
        return self._locations[tree]

    def place(self, tree: Tree, like: Tree) -> None:
        """Have a new element start where another one does."""
        self._locations[tree] = self._locations[like]

    def xml(self, tree: Tree) -> str:
        """The element as XML that stands by itself.

        Raises:
            RealizerError: ``too-many-bytes``: each such text repeats the namespaces declared around it.
        """
        text = etree.tostring(tree, encoding="unicode", with_tail=False)
        self._written += len(text)
        limit = _MOST_COPIES * self.limits.bml_bytes
        if self._written > limit:
            raise RealizerError(self.fault(tree, "too-many-bytes", size=self._written, limit=limit))
        return text

    def content(self, tree: Tree) -> str:
        """What is inside the element, as XML.

        Raises:
            RealizerError: ``too-many-bytes``.
        """
        inside = (self.xml(child) + escape(child.tail or "") for child in tree)
        return escape(tree.text or "") + "".join(inside)

    def written(self, tree: Tree) -> dict[str, Any]:
        """What is kept of the element of every behavior."""
        return {
            "name": name_of(tree),
            "location": self.location(tree),
            "extensions": extensions_of(tree),
            "source": self.xml(tree),
        }

    def fault(self, tree: Tree, code: str, **details: object) -> Fault:
        """Something wrong with an element."""
        place = self.location(tree)
        return Fault(code, {"element": name_of(tree)} | details, place.line, place.column)

    def values(self, tree: Tree, attributes: Iterable[Attribute]) -> dict[str, Any]:
        """The values of the attributes that are written, by field.

        Raises:
            RealizerError: ``missing-attribute`` or ``bad-attribute``.
        """
        values, continuous = {}, is_continuous(tree)
        for each in attributes:
            text = _text_of(tree, each, continuous) if each.continuous else tree.get(each.name)
            if text is not None:
                values[each.field] = self._read(tree, each, text)
            elif each.required:
                raise RealizerError(self.fault(tree, "missing-attribute", attribute=each.name))
        return values

    def syncs(self, tree: Tree, names: Iterable[str]) -> Mapping[str, SyncRef]:
        """What the sync points of these names are tied to, in order of writing.

        Raises:
            RealizerError: ``bad-attribute``.
        """
        points = set(names)
        return MappingProxyType({name: self.ref(tree, name) for name in names_in(tree) if name in points})

    def holds_ref(self, tree: Tree, name: str) -> bool:
        """Whether an attribute holds a reference."""
        try:
            self.ref(tree, name)
        except RealizerError:
            return False
        return True

    def ref(self, tree: Tree, name: str) -> SyncRef:
        """The reference that an attribute holds.

        Raises:
            RealizerError: ``missing-attribute`` or ``bad-attribute``.
        """
        text = tree.get(name)
        if text is None:
            raise RealizerError(self.fault(tree, "missing-attribute", attribute=name))
        try:
            return self.names.ref(text, self.limits)
        except RealizerError as refused:
            raise self.bad(tree, name, text, refused) from None

    def bad(self, tree: Tree, name: str, text: str, refused: RealizerError) -> RealizerError:
        """An attribute whose value is refused."""
        reason = refused.fault.sentence
        return RealizerError(self.fault(tree, "bad-attribute", attribute=name, value=shown(text), reason=reason))

    def unread(self, tree: Tree, attributes: Iterable[str], children: Iterable[str] = ()) -> list[Fault]:
        """What an element holds beside these attributes and children; all of it is passed over."""
        return [*self.foreign_attributes(tree), *self.unread_but_foreign(tree, attributes, children)]

    def unread_but_foreign(self, tree: Tree, attributes: Iterable[str], children: Iterable[str] = ()) -> list[Fault]:
        """The same of an element whose attributes of other namespaces are kept: what plays it may know them."""
        return [
            *self.unread_attributes(tree, attributes),
            *self.unread_children(tree, children),
            *self.stray_text(tree),
        ]

    def foreign_attributes(self, tree: Tree) -> list[Fault]:
        """A fault for each attribute of another namespace."""
        return [
            self.fault(tree, "foreign-attribute", attribute=name, namespace=namespace)
            for namespace, name in extensions_of(tree)
        ]

    def unread_attributes(self, tree: Tree, names: Iterable[str]) -> list[Fault]:
        """One fault for all un-namespaced attributes that are none of these."""
        known = list(names)
        unknown = [name for name in names_in(tree) if name not in known]
        if not unknown:
            return []
        return [self.fault(tree, "unknown-attribute", attributes=listed(unknown), known=listed(known))]

    def unread_children(self, tree: Tree, names: Iterable[str]) -> list[Fault]:
        """One fault for all child elements that are none of these."""
        known = list(names)
        unknown = [child for child in tree if not is_part(child, tree) or name_of(child) not in known]
        if not unknown:
            return []
        details = {"parent": name_of(tree), "known": listed(known)}
        return [self.fault(unknown[0], "unknown-element", element=listed(map(name_of, unknown)), **details)]

    def stray_text(self, tree: Tree) -> list[Fault]:
        """One fault for all text directly inside an element where none is meant."""
        stray = stray_text_of(tree)
        return [self.fault(tree, "stray-text", text=shown(stray))] if stray else []

    def _read(self, tree: Tree, attribute: Attribute, text: str) -> object:
        try:
            return attribute.type.read(text, self.limits)
        except RealizerError as refused:
            raise self.bad(tree, attribute.name, text, refused) from None


def _text_of(tree: Tree, attribute: Attribute, continuous: bool) -> str | None:
    # An element of continuous interaction has the attributes of its own namespace without a prefix too.
    for name in attribute.spellings:
        if (text := tree.get(name)) is not None:
            return text
    return tree.get(attribute.name) if continuous else None
