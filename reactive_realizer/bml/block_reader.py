"""From a top-level element to a block or a procedure."""

from collections.abc import Iterable
from typing import Any, Final

from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.block import BehaviorBlock, Parsed, Problem
from reactive_realizer.bml.composition import Composed
from reactive_realizer.bml.content_reader import ContentReader
from reactive_realizer.bml.drafts.block import modernize_block
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.procedure import DEFINE, USE, DefineProc, UseProc
from reactive_realizer.bml.root_builder import Root
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import extensions_of, is_continuous, is_core, name_of
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_ID, *_OTHERS = attributes_of(BehaviorBlock)
_PROCEDURE, _BLOCK = attributes_of(UseProc)
(_NAME,) = attributes_of(DefineProc)
_CONTINUOUS: Final = frozenset(name for each in _OTHERS if each.continuous for name in each.spellings)


class BlockReader:
    """Reads one block, use of a procedure or procedure; what of it cannot be read is dropped with a problem."""

    def __init__(self, root: Root, limits: Limits) -> None:
        self._source = Source(root, limits)
        self._tree = root.tree
        self._id = BLOCK

    def read(self) -> Parsed:
        """What it is, and its problems."""
        try:
            return self._read()
        except RealizerError as refused:
            return Parsed(None, (Problem(refused.fault, self._id),))

    def _read(self) -> Parsed:
        name = name_of(self._tree)
        if self._source.names.draft:
            modernize_block(self._tree)
        if is_core(self._tree) and name == "bml":
            return self._read_block()
        if is_continuous(self._tree) and name == USE:
            return self._read_use()
        if is_continuous(self._tree) and name == DEFINE:
            return self._read_definition()
        raise RealizerError(self._source.fault(self._tree, "not-bml"))

    def _read_block(self) -> Parsed:
        if not self._tree.get("id", "").strip():
            raise RealizerError(self._source.fault(self._tree, "no-block-id"))
        self._id = self._value(_ID)
        content = ContentReader(self._source, self._id)
        attributes = self._attributes(content, [_ID])
        self._source.names.external = attributes.get("external_refs", False) or not self._source.names.draft
        content.read()
        block = BehaviorBlock(
            **attributes, behaviors=content.behaviors, constraints=content.constraints, unread=content.unread
        )
        return Parsed(block, content.problems, content.failed)

    def _read_use(self) -> Parsed:
        self._id = self._value(_BLOCK)
        procedure = self._value(_PROCEDURE)
        content = ContentReader(self._source, self._id)
        attributes = self._attributes(content, [_PROCEDURE, _BLOCK])
        content.report([*self._source.unread_children(self._tree, []), *self._source.stray_text(self._tree)])
        return Parsed(BehaviorBlock(**attributes, procedure=procedure), content.problems)

    def _read_definition(self) -> Parsed:
        self._id = self._value(_NAME)
        content = ContentReader(self._source, self._id)
        content.report(self._source.unread_attributes(self._tree, [_NAME.name]))
        content.read()
        if content.failed:
            return Parsed(None, content.problems)
        location = self._source.location(self._tree)
        procedure = DefineProc(
            id=self._id,
            behaviors=content.behaviors,
            constraints=content.constraints,
            unread=content.unread,
            location=location,
        )
        return Parsed(None, content.problems, procedure=procedure)

    def _value(self, attribute: Attribute) -> str:
        return str(self._source.values(self._tree, [attribute])[attribute.field])

    def _attributes(self, content: ContentReader, own: Iterable[Attribute]) -> dict[str, Any]:
        """All of a block but what stands inside; those that cannot be read have their defaults."""
        values: dict[str, Any] = {}
        for attribute in _OTHERS:
            try:
                values |= self._source.values(self._tree, [attribute])
            except RealizerError as refused:
                content.report([refused.fault])
        continuous = is_continuous(self._tree)
        plain = [each.name for each in (*own, *_OTHERS) if continuous or not each.continuous]
        content.report(self._source.unread_attributes(self._tree, plain))
        return _composed(values) | {
            "id": self._id,
            "extensions": extensions_of(self._tree, _CONTINUOUS),
            "location": self._source.location(self._tree),
        }


def _composed(values: dict[str, Any]) -> dict[str, Any]:
    """The same with what the composition says besides its word."""
    composed = values.pop("composition", Composed())
    appended = (*composed.append_after, *values.get("append_after", ()))
    chunked = (*composed.chunk_after, *values.get("chunk_after", ()))
    return values | {
        "composition": composed.composition,
        "append_after": tuple(dict.fromkeys(appended)),
        "chunk_after": tuple(dict.fromkeys(chunked)),
    }
