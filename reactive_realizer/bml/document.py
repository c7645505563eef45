"""Reads a document: its blocks and procedures, with the problems of each."""

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.attribute_types import CompositionValue
from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.block import (
    DEFINE_PROC,
    USE_PROC,
    BehaviorBlock,
    DefineProc,
    Parsed,
    Problem,
    Synchronize,
    UseProc,
)
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.content_reader import ContentReader
from reactive_realizer.bml.draft_documents import BlockNames, rename_elements, unwrapped
from reactive_realizer.bml.drafts import modernize_block
from reactive_realizer.bml.faults import NoBlock, NoBlockId, NotBml, TooManyBytes, TooManyRoots
from reactive_realizer.bml.names import BLOCK, CONTINUOUS
from reactive_realizer.bml.smartbody.blocks import regroup
from reactive_realizer.bml.smartbody.requests import Request
from reactive_realizer.bml.sync_ref import OWN_BLOCK_POINTS, SyncRef
from reactive_realizer.bml.trees import Tree, extensions_of, is_continuous, is_core, name_of
from reactive_realizer.bml.value_faults import NotOuterPoint, NotOwnPoint
from reactive_realizer.bml.xml_roots import Root, decode, read_roots
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits

_ID, *_OTHERS = attributes_of(BehaviorBlock)
_PROCEDURE_ID, _BLOCK_ID = attributes_of(UseProc)
(_DEFINED_ID,) = attributes_of(DefineProc)
_SYNCS: Final = ("start", *OWN_BLOCK_POINTS)
"""The attributes of a block that hold references."""
_START_AFTER: Final = re.compile(r"([^\s:]+):(relax|end)")
_AFTER: Final = {"relax": "chunkAfter", "end": "appendAfter"}
_CONTINUOUS: Final = frozenset(name for each in _OTHERS if each.continuous for name in each.spellings)


def parse(text: str | bytes, limits: Limits, name: str = "document1") -> list[Parsed]:
    """Reads BML 1.0; a document without a namespace is read as a draft of BML.

    A document may hold several blocks; comments, processing instructions and XML declarations may stand before and
    between them. The result has an entry for each block, and for each other thing at the top level, in document order.
    It is never empty, and the function raises nothing.

    Args:
        text: the document.
        limits: the sizes that are refused.
        name: id of the first block of a draft that has none; the second one gets ``name_2``, and so on.
    """
    try:
        parsed = list(islice(_read(text, limits, name), limits.blocks_alive + 1))
    except RealizerError as refused:
        return [_refused(refused)]
    if len(parsed) > limits.blocks_alive:
        parsed[-1] = _refused(RealizerError(TooManyRoots(limit=limits.blocks_alive)))
    return parsed or [_refused(RealizerError(NoBlock(line=1, column=1)))]


def _read(text: str | bytes, limits: Limits, name: str) -> Iterator[Parsed]:
    size = len(text) if isinstance(text, bytes) else len(text.encode("utf-8", "surrogatepass"))
    if size > limits.bml_bytes:
        raise RealizerError(TooManyBytes(size=size, limit=limits.bml_bytes, line=1, column=1))
    request = Request.read(text if isinstance(text, str) else decode(text))
    ids = BlockNames(request.name or name, request.agent)
    for root in unwrapped(read_roots(request.document, limits)):
        if isinstance(root, Problem):
            yield Parsed(None, (root,))
        else:
            rename_elements(root.tree)
            ids.give(root.tree)
            yield _BlockReader(root, limits).read()


def _refused(refused: RealizerError) -> Parsed:
    return Parsed(None, (Problem(refused.fault, BLOCK),))


class _BlockReader:
    """Reads one block, procedure, or use of a procedure; a part that cannot be read is dropped with a problem."""

    def __init__(self, root: Root, limits: Limits) -> None:
        self._source = BlockSource(root, limits)
        self._tree = root.tree
        self._notes = root.notes
        self._id = BLOCK

    def read(self) -> Parsed:
        """The block or procedure, with its problems."""
        try:
            return self._read()
        except RealizerError as refused:
            return Parsed(None, (Problem(refused.fault, self._id),))

    def _read(self) -> Parsed:
        name = name_of(self._tree)
        if self._source.ids.draft:
            modernize_block(self._tree)
        _start_after(self._tree)
        if is_core(self._tree) and name == "bml":
            return self._read_block()
        if is_continuous(self._tree) and name == USE_PROC:
            return self._read_use()
        if is_continuous(self._tree) and name == DEFINE_PROC:
            return self._read_definition()
        raise RealizerError(self._source.located(self._tree, NotBml(element=name_of(self._tree))))

    def _read_block(self) -> Parsed:
        if not self._tree.get("id", "").strip():
            raise RealizerError(self._source.located(self._tree, NoBlockId()))
        self._id = self._value(_ID)
        if self._source.ids.draft:
            regroup(self._tree, self._source)
        content = ContentReader(self._source, self._id)
        content.report(list(self._notes))
        attributes = self._attributes(content, [_ID.name], _SYNCS)
        self._source.ids.external = attributes.get("external_refs", False) or not self._source.ids.draft
        content.read()
        syncs = self._syncs(content)
        start = syncs.pop("start", None)
        block = BehaviorBlock(
            **attributes,
            points=MappingProxyType(syncs),
            behaviors=content.behaviors,
            constraints=(*content.constraints, *self._starts(start)),
            unread=content.unread,
        )
        return Parsed(block, content.problems, content.failed)

    def _syncs(self, content: ContentReader) -> dict[str, SyncRef]:
        """The references of the sync points of the block; those that cannot be read are left out."""
        syncs: dict[str, SyncRef] = {}
        for name in [name for name in _SYNCS if name in self._tree.attrib]:
            try:
                ref = self._source.ref(self._tree, name)
                own = ref.block in {None, self._id}
                if name == "start" and (own or not ref.sync):
                    raise self._bad(name, NotOuterPoint())
                if name != "start" and not (own and ref.behavior and ref.offset == 0):
                    raise self._bad(name, NotOwnPoint())
            except RealizerError as refused:
                content.report([refused.fault])
            else:
                syncs[name] = ref
        return syncs

    def _bad(self, attribute: str, fault: Fault) -> RealizerError:
        return self._source.bad_attribute(self._tree, attribute, self._tree.get(attribute, ""), RealizerError(fault))

    def _starts(self, ref: SyncRef | None) -> Iterator[Synchronize]:
        """The constraint on the start of the block."""
        if ref is not None:
            place = self._source.location(self._tree)
            yield Synchronize(id=None, refs=(SyncRef(None, None, None), ref), required=False, location=place)

    def _read_use(self) -> Parsed:
        self._id = self._value(_BLOCK_ID)
        procedure = self._value(_PROCEDURE_ID)
        content = ContentReader(self._source, self._id)
        attributes = self._attributes(content, [_PROCEDURE_ID.name, _BLOCK_ID.name], ())
        content.report([*self._source.unknown_children(self._tree, []), *self._source.stray_text(self._tree)])
        return Parsed(BehaviorBlock(**attributes, procedure=procedure), content.problems)

    def _read_definition(self) -> Parsed:
        self._id = self._value(_DEFINED_ID)
        content = ContentReader(self._source, self._id)
        content.report(self._source.unknown_attributes(self._tree, [_DEFINED_ID.name]))
        content.read()
        if content.failed:
            return Parsed(None, content.problems)
        procedure = DefineProc(
            id=self._id,
            behaviors=content.behaviors,
            constraints=content.constraints,
            unread=content.unread,
            location=self._source.location(self._tree),
        )
        return Parsed(None, content.problems, procedure=procedure)

    def _value(self, attribute: Attribute) -> str:
        return str(self._source.values(self._tree, [attribute])[attribute.field])

    def _attributes(self, content: ContentReader, own: Iterable[str], syncs: Iterable[str]) -> dict[str, Any]:
        """The fields of a block except its content and its sync points; attributes that cannot be read are left out."""
        values: dict[str, Any] = {}
        for attribute in _OTHERS:
            try:
                values |= self._source.values(self._tree, [attribute])
            except RealizerError as refused:
                content.report([refused.fault])
        continuous = is_continuous(self._tree)
        plain = [*own, *(each.name for each in _OTHERS if continuous or not each.continuous), *syncs]
        content.report(self._source.unknown_attributes(self._tree, plain))
        return _composed(values) | {
            "id": self._id,
            "extensions": extensions_of(self._tree, _CONTINUOUS),
            "location": self._source.location(self._tree),
        }


def _start_after(tree: Tree) -> None:
    """Rewrites a start at the relax or the end of another block as chunkAfter or appendAfter (thesis, example 33)."""
    start = _START_AFTER.fullmatch(tree.get("start", "").strip())
    if start is not None:
        del tree.attrib["start"]
        spellings = [f"{{{namespace}}}{_AFTER[start[2]]}" for namespace in CONTINUOUS]
        after = next((name for name in spellings if name in tree.attrib), spellings[0])
        tree.set(after, ",".join(filter(None, [tree.get(after), start[1]])))


def _composed(values: dict[str, Any]) -> dict[str, Any]:
    """The same values, with the blocks that the composition names moved to the fields for them."""
    composed = values.pop("composition", CompositionValue())
    appended = (*composed.append_after, *values.get("append_after", ()))
    chunked = (*composed.chunk_after, *values.get("chunk_after", ()))
    return values | {
        "composition": composed.composition,
        "append_after": tuple(dict.fromkeys(appended)),
        "chunk_after": tuple(dict.fromkeys(chunked)),
    }
