"""Reads the attributes of the elements of one block, and reports what cannot be read."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import count
from types import MappingProxyType
from typing import Any, Final
from xml.sax.saxutils import escape

from lxml import etree

from reactive_realizer.bml.attributes import Attribute
from reactive_realizer.bml.faults import (
    BadAttribute,
    ForeignAttribute,
    MissingAttribute,
    StrayText,
    TooManyBytes,
    UnknownAttribute,
    UnknownElement,
)
from reactive_realizer.bml.names import ANTICIPATORS, BML, BML_EXT, Location
from reactive_realizer.bml.smartbody.requests import UNCLOSED_MARK
from reactive_realizer.bml.sync_ref import DRAFT_SPELLINGS, SPEECH_POINTS, SyncRef
from reactive_realizer.bml.trees import (
    Tree,
    extensions_of,
    is_continuous,
    is_core,
    is_part,
    name_of,
    names_in,
    namespace_of,
    stray_text_of,
)
from reactive_realizer.bml.value_faults import ExternalReference
from reactive_realizer.bml.xml_roots import Root
from reactive_realizer.errors import Fault, RealizerError, quoted
from reactive_realizer.limits import Limits

_MOST_COPIES: Final = 10
"""Limit on the size of all copies that are kept of a document, as a multiple of the limit on its size."""


class BlockSource:
    """The elements of one block, with their locations.

    Attributes:
        tree: the element of the block.
        limits: the sizes that are refused.
        ids: those that references in the block can name.
    """

    def __init__(self, root: Root, limits: Limits) -> None:
        self.tree = root.tree
        self.limits = limits
        self.ids = BlockIds(root.tree)
        self._copied = 0
        self._written: dict[Tree, str] = {}
        self._locations = dict(root.locations)

    # --- elements

    def location(self, tree: Tree) -> Location:
        """The location of the start tag of an element."""
        return self._locations[tree]

    def place(self, tree: Tree, like: Tree) -> None:
        """Gives a new element the location of another one."""
        self._locations[tree] = self._locations[like]

    def insert(self, tree: Tree, name: str, attributes: Mapping[str, str] = MappingProxyType({})) -> Tree:
        """A new first child of an element, with its location."""
        child = etree.Element(name, dict(attributes))
        tree.insert(0, child)
        self.place(child, tree)
        return child

    def rename(self, tree: Tree, name: str, written: str) -> None:
        """Gives an element the name that it has in BML 1.0; faults name it as it was written."""
        tree.tag = name
        self._written[tree] = written

    def xml(self, tree: Tree) -> str:
        """An element as a well-formed XML document.

        Raises:
            RealizerError: ``too-many-bytes``: each such copy repeats the namespaces declared around the element.
        """
        text = etree.tostring(tree, encoding="unicode", with_tail=False)
        self._copied += len(text)
        limit = _MOST_COPIES * self.limits.bml_bytes
        if self._copied > limit:
            raise RealizerError(self.located(tree, TooManyBytes(size=self._copied, limit=limit)))
        return text

    def content(self, tree: Tree) -> str:
        """The content of an element as XML.

        Raises:
            RealizerError: ``too-many-bytes``.
        """
        inside = (self.xml(child) + escape(child.tail or "") for child in tree)
        return escape(tree.text or "") + "".join(inside)

    def element_fields(self, tree: Tree) -> dict[str, Any]:
        """The fields of a behavior that hold its element itself."""
        return {
            "name": name_of(tree),
            "location": self.location(tree),
            "extensions": extensions_of(tree),
            "source": self.xml(tree),
        }

    # --- attributes

    def values(self, tree: Tree, attributes: Iterable[Attribute]) -> dict[str, Any]:
        """The values of those attributes that are written, by field.

        Raises:
            RealizerError: ``missing-attribute`` or ``bad-attribute``.
        """
        values, continuous = {}, is_continuous(tree)
        for each in attributes:
            text = _text_of(tree, each, continuous)
            if text is not None:
                values[each.field] = self._read(tree, each, text)
            elif each.required:
                raise RealizerError(self.located(tree, MissingAttribute(element=name_of(tree), attribute=each.name)))
        return values

    def syncs(self, tree: Tree, names: Iterable[str]) -> Mapping[str, SyncRef]:
        """The references of the sync points with these names, in the order of writing.

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
        """The reference in an attribute.

        Raises:
            RealizerError: ``missing-attribute`` or ``bad-attribute``.
        """
        text = tree.get(name)
        if text is None:
            raise RealizerError(self.located(tree, MissingAttribute(element=name_of(tree), attribute=name)))
        try:
            return self.ids.ref(text, self.limits)
        except RealizerError as refused:
            raise self.bad_attribute(tree, name, text, refused) from None

    # --- faults

    def located(self, tree: Tree, fault: Fault) -> Fault:
        """A fault with the location of an element."""
        place = self.location(tree)
        return fault.located(place.line, place.column)

    def bad_attribute(self, tree: Tree, name: str, text: str, refused: RealizerError) -> RealizerError:
        """The error for an attribute whose value was refused."""
        fault = BadAttribute(element=name_of(tree), attribute=name, value=quoted(text), reason=refused.fault.sentence)
        return RealizerError(self.located(tree, fault))

    def unknown_content(self, tree: Tree, attributes: Iterable[str], children: Iterable[str] = ()) -> list[Fault]:
        """A fault for each kind of content other than these attributes and children; such content is ignored."""
        return [*self.unknown_parts(tree, attributes, children), *self.stray_text(tree)]

    def unknown_parts(self, tree: Tree, attributes: Iterable[str], children: Iterable[str] = ()) -> list[Fault]:
        """The same for an element that may contain text."""
        return [
            *self.foreign_attributes(tree),
            *self.unknown_attributes(tree, attributes),
            *self.unknown_children(tree, children),
        ]

    def unknown_core_content(self, tree: Tree, attributes: Iterable[str], children: Iterable[str] = ()) -> list[Fault]:
        """The same, without attributes of other namespaces, which an engine may understand."""
        return [
            *self.unknown_attributes(tree, attributes),
            *self.unknown_children(tree, children),
            *self.stray_text(tree),
        ]

    def foreign_attributes(self, tree: Tree) -> list[Fault]:
        """One fault for all attributes of each other namespace."""
        return [self.located(tree, fault) for fault in ForeignAttribute.of(extensions_of(tree))]

    def unknown_attributes(self, tree: Tree, names: Iterable[str]) -> list[Fault]:
        """One fault for all attributes without a namespace that have other names than these."""
        known = list(names)
        unknown = [name for name in names_in(tree) if name not in known]
        if not unknown:
            return []
        element = self._written.get(tree, name_of(tree))
        return [self.located(tree, UnknownAttribute(element=element, attributes=tuple(unknown), known=tuple(known)))]

    def unknown_children(self, tree: Tree, names: Iterable[str]) -> list[Fault]:
        """One fault for all child elements that have other names than these."""
        known = list(names)
        unknown = [child for child in tree if not is_part(child, tree) or name_of(child) not in known]
        if not unknown:
            return []
        fault = UnknownElement(elements=tuple(map(name_of, unknown)), parent=name_of(tree), known=tuple(known))
        return [self.located(unknown[0], fault)]

    def stray_text(self, tree: Tree) -> list[Fault]:
        """One fault for all text directly inside an element that should have none."""
        stray = stray_text_of(tree)
        return [self.located(tree, StrayText(text=quoted(stray)))] if stray else []

    def _read(self, tree: Tree, attribute: Attribute, text: str) -> object:
        try:
            return attribute.type.read(text, self.limits)
        except RealizerError as refused:
            raise self.bad_attribute(tree, attribute.name, text, refused) from None


class BlockIds:
    """The ids of a block, its behaviors and its marks, collected before any of them is read.

    Attributes:
        draft: whether the block is older than BML 1.0, with other spellings of sync points.
        external: whether references may name behaviors of other blocks.
    """

    def __init__(self, block: Tree) -> None:
        self.draft = namespace_of(block) not in {BML, BML_EXT}
        self.external = True
        self._block = block.get("id", "").strip()
        self._behaviors = {id_.strip() for each in _behaviors_in(block) if (id_ := each.get("id"))}
        marks = block.iter("{*}sync", "{*}tm", f"{{*}}{UNCLOSED_MARK}", "{*}mark")
        self._marks = frozenset(id_ for mark in marks if (id_ := mark.get("id") or mark.get("name")))
        self._speeches = {each.get("id", "").strip() for each in _behaviors_in(block) if name_of(each) == "speech"}
        self._numbers: defaultdict[str, Iterator[int]] = defaultdict(partial(count, 1))

    def give(self, behavior: Tree) -> None:
        """Gives a behavior an id made of the name of its element and the first free number, such as activate1."""
        element = name_of(behavior)
        ids = (f"{element}{number}" for number in self._numbers[element])
        free = next(id_ for id_ in ids if id_ not in self._behaviors)
        behavior.set("id", free)
        self._behaviors.add(free)

    def ref(self, text: str, limits: Limits) -> SyncRef:
        """The point that a reference in this block names.

        Raises:
            RealizerError: it is not a reference, or it names a behavior of another block, which is not allowed.
        """
        ref = SyncRef.parse(text, limits, self._marks).read_in(self._block, self._behaviors)
        if self.draft and ref.sync not in self._marks:
            ref = replace(ref, sync=DRAFT_SPELLINGS.get(ref.sync or "", ref.sync))
            if ref.block is None and ref.behavior in self._speeches:
                ref = replace(ref, sync=SPEECH_POINTS.get(ref.sync or "", ref.sync))
        outside = ref.behavior is not None and ref.block not in {None, self._block, ANTICIPATORS}
        if outside and not self.external:
            raise RealizerError(ExternalReference())
        return ref


def _text_of(tree: Tree, attribute: Attribute, continuous: bool) -> str | None:
    # An element of continuous interaction may write the attributes of its own namespace without a prefix.
    for name in attribute.spellings:
        if (text := tree.get(name)) is not None:
            return text
    return tree.get(attribute.name) if continuous and attribute.continuous else None


def _behaviors_in(block: Tree) -> Iterator[Tree]:
    """The elements of behaviors, also unreadable ones: a reference to any of them does not name another block."""
    holders = [block, *block.iter("{*}required")]
    others = ("constraint", "required")
    return (child for holder in holders for child in holder if not (is_core(child) and name_of(child) in others))
