"""Writes blocks and procedures as BML 1.0 with its extensions, whatever language they were read from."""

from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any, Final

from lxml import etree

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.block import (
    DEFINE_PROC,
    USE_PROC,
    BehaviorBlock,
    Constraint,
    DefineProc,
    Order,
    Synchronize,
    UseProc,
)
from reactive_realizer.bml.extensions import Emit, Noise, lasts
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, BMLT, OWN, SBM
from reactive_realizer.bml.ssml_elements import SSML
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.writer import attribute_texts, behavior_element, text_of

_EXTENSIONS: Final = {"ext": BML_EXT, "bmla": BMLA, "bmlt": BMLT, "rr": OWN, "ssml": SSML}


def document(written: Iterable[BehaviorBlock | DefineProc]) -> str:
    """The BML of blocks and procedures, one after another, indented."""
    roots = (_Writer(part.behaviors).root(part) for part in written)
    return "".join(f"{etree.tostring(root, encoding='unicode')}\n" for root in roots)


class _Writer:
    """Writes one block or procedure."""

    def __init__(self, behaviors: Iterable[Behavior]) -> None:
        """Write a part of a document with some behaviors."""
        # Elements of drafts are in no namespace, so there must be no default one then.
        prefix = "bml" if any(map(_is_draft, behaviors)) else None
        self._prefixes: Any = {prefix: BML, **_EXTENSIONS}
        self._verbatim: list[tuple[Tree, Tree]] = []

    def root(self, part: BehaviorBlock | DefineProc) -> Tree:
        """The element of the block or procedure."""
        element = self._block(part) if isinstance(part, BehaviorBlock) else self._procedure(part)
        element.extend(self._content(part.behaviors, part.constraints))
        etree.cleanup_namespaces(element, top_nsmap=self._prefixes)
        etree.indent(element)
        for empty, source in self._verbatim:
            empty.text = source.text
            empty.extend(list(source))
        etree.cleanup_namespaces(element)
        return element

    def _block(self, block: BehaviorBlock) -> Tree:
        if block.procedure is None:
            element = etree.Element(f"{{{BML}}}bml", nsmap=self._prefixes)
        else:
            use = UseProc(procedure=block.procedure, block=block.id)
            element = etree.Element(f"{{{BMLA}}}{USE_PROC}", attribute_texts(use), nsmap=self._prefixes)
        for attribute in attributes_of(BehaviorBlock):
            value = getattr(block, attribute.field)
            said = attribute.required or value != attribute.default
            if said and not (block.procedure is not None and attribute.field == "id"):
                name = f"{{{BMLA}}}{attribute.name}" if attribute.continuous else attribute.name
                element.set(name, text_of(value))
        for point, ref in block.points.items():
            element.set(point, str(ref))
        for (namespace, name), value in block.extensions.items():
            element.set(f"{{{namespace}}}{name}", value)
        return element

    def _procedure(self, procedure: DefineProc) -> Tree:
        return etree.Element(f"{{{BMLA}}}{DEFINE_PROC}", {"id": procedure.id}, nsmap=self._prefixes)

    def _content(self, behaviors: Iterable[Behavior], constraints: Iterable[Constraint]) -> Iterator[Tree]:
        for required, some in groupby((*behaviors, *constraints), key=lambda part: part.required):
            elements = map(self._part, some)
            if required:
                holder = etree.Element(f"{{{BML}}}required")
                holder.extend(elements)
                yield holder
            else:
                yield from elements

    def _part(self, part: Behavior | Constraint) -> Tree:
        if isinstance(part, Synchronize | Order):
            return _constraint(part)
        if not isinstance(part, ForeignBehavior | Emit) and not _is_draft(part):
            return behavior_element(part)
        if isinstance(part, Noise):
            return _lasting_noise(part)
        # One of no language known here, or of a draft alone: as it was written.
        source = etree.fromstring(part.source)
        prefixes: Any = source.nsmap
        attributes: Any = source.attrib
        empty = etree.Element(source.tag, attributes, nsmap=prefixes)
        self._verbatim.append((empty, source))
        return empty


def _is_draft(behavior: Behavior) -> bool:
    """Return whether a behavior can be written only in a draft of BML, such as a gaze that persists."""
    return behavior.persistent and not lasts(behavior) and bool(behavior.source)


def _lasting_noise(noise: Noise) -> Tree:
    """Return noise that persists as SmartBody's, which does; BMLT's does not."""
    element = behavior_element(noise)
    element.tag = f"{{{SBM}}}noise"
    return element


def _constraint(constraint: Constraint) -> Tree:
    element = etree.Element(f"{{{BML}}}constraint", {} if constraint.id is None else {"id": constraint.id})
    name = "synchronize" if isinstance(constraint, Synchronize) else constraint.kind.value
    child = etree.SubElement(element, f"{{{BML}}}{name}")
    if isinstance(constraint, Order):
        child.set("ref", str(constraint.ref))
    for ref in constraint.refs:
        etree.SubElement(child, f"{{{BML}}}sync", ref=str(ref))
    return element
