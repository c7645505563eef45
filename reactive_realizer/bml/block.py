"""Blocks, procedures and their constraints, and the result of reading one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

from reactive_realizer.bml.attribute_types import Boolean, CompositionType, Id, IdList, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import OWN, Location
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import Fault

DEFINE_PROC: Final = "defineproc"
USE_PROC: Final = "useproc"
PROCEDURES: Final = frozenset({DEFINE_PROC, USE_PROC})
"""Elements of continuous interaction that are written beside blocks."""

ACCOMPANIES: Final = (OWN, "accompanies")
"""The attribute of a block that accompanies another one."""
CAST: Final = (OWN, "cast")
"""The attribute of a block for a character that the first one of a scene stands in for if the scene lacks it."""
BLOCK_EXTENSIONS: Final = frozenset({ACCOMPANIES, CAST})
"""The attributes of blocks in our namespace."""


class OrderKind(StrEnum):
    """The side of its reference point on which an `Order` puts the listed points."""

    BEFORE = "before"
    AFTER = "after"


@dataclass(frozen=True, slots=True, kw_only=True)
class Synchronize:
    """A constraint: all these points have the same time.

    Attributes:
        id: of its constraint element, if it has one.
        refs: two or more; an absolute time pins the others.
        required: whether the block fails without it.
        location: of its start tag.
    """

    id: str | None
    refs: tuple[SyncRef, ...]
    required: bool
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """A constraint: the listed points are not after, or not before, a reference point.

    Attributes:
        kind: BEFORE: no listed point is after `ref`; AFTER: none is before it.
        id: of its constraint element, if it has one.
        ref: the reference point.
        refs: the listed points, one or more.
        required: whether the block fails without it.
        location: of its start tag.
    """

    kind: OrderKind
    id: str | None
    ref: SyncRef
    refs: tuple[SyncRef, ...]
    required: bool
    location: Location


Constraint = Synchronize | Order
"""A constraint that is written apart from the behaviors."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DefineProc:
    """A ``<defineproc>``: behaviors and constraints that are written once and played many times (thesis 6.6.2).

    It is written beside blocks, and does not play itself. A later one with the same id replaces it.

    Attributes:
        id: its name among procedures.
        behaviors: in document order, including those inside ``<required>``.
        constraints: in document order.
        unread: ids of the behaviors that were dropped because they cannot be read.
        location: of its start tag.
    """

    id: str = field(metadata=attribute(Id()))
    behaviors: tuple[Behavior, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    unread: frozenset[str] = frozenset()
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class UseProc:
    """The attributes of a ``<useproc>`` that a block does not have.

    Attributes:
        procedure: id of the procedure.
        block: id of the block that it becomes.
    """

    procedure: str = field(metadata=attribute(Id(), "procid"))
    block: str = field(metadata=attribute(Id(), "bmlid"))


@dataclass(frozen=True, slots=True, kw_only=True)
class BehaviorBlock:
    """A ``<bml>`` element, or a ``<useproc>``.

    Attributes:
        id: unique among the blocks alive.
        character: id of its character; None for the first one.
        composition: its relation to earlier blocks.
        append_after: ids of the blocks that end before it starts; BMLA's appendAfter.
        chunk_after: ids of the blocks that subside before it starts: only their retractions are left.
        prepend_before: ids of the blocks that do not start before it has ended.
        chunk_before: ids of the blocks that do not start before it subsides.
        interrupts: ids of the blocks that it interrupts when it enters; BMLA's interrupt.
        on_start: ids of the preplanned blocks that start when it starts.
        preplan: whether it waits to be activated.
        external_refs: whether its references may name behaviors of other blocks; only drafts restrict this.
        points: the points of its behaviors that are its own sync points, by name of these (thesis, example 35).
        procedure: id of the procedure that provides its behaviors and constraints; None if it contains its own.
        behaviors: in document order, including those inside ``<required>``.
        constraints: in document order.
        unread: ids of the behaviors that were dropped because they cannot be read.
        extensions: attributes of other namespaces, (namespace, local name) to value.
        location: of its start tag.
    """

    id: str = field(metadata=attribute(Id()))
    character: str | None = field(default=None, metadata=attribute(Text(), "characterId"))
    composition: Composition = field(default=Composition.MERGE, metadata=attribute(CompositionType()))
    append_after: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), continuous=True))
    chunk_after: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), continuous=True))
    prepend_before: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), continuous=True))
    chunk_before: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), continuous=True))
    interrupts: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), "interrupt", continuous=True))
    on_start: tuple[str, ...] = field(default=(), metadata=attribute(IdList(), continuous=True))
    preplan: bool = field(default=False, metadata=attribute(Boolean(), continuous=True))
    external_refs: bool = field(default=False, metadata=attribute(Boolean(), "allowexternalrefs", continuous=True))
    points: Mapping[str, SyncRef] = field(default_factory=dict)
    procedure: str | None = None
    behaviors: tuple[Behavior, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    unread: frozenset[str] = frozenset()
    extensions: Mapping[tuple[str, str], str] = field(default_factory=dict)
    location: Location

    @property
    def accompanies(self) -> str | None:
        """Id of the block that it accompanies: its behaviors give way to all others, and end with that block."""
        return self.extensions.get(ACCOMPANIES)

    def played_by(self, characters: Sequence[str]) -> str:
        """The id of its character.

        Args:
            characters: of the scene; the first one takes blocks that name none, or that are cast for one who is absent.
        """
        cast = self.extensions.get(CAST)
        return self.character or (cast if cast is not None and cast in characters else characters[0])

    @property
    def refs(self) -> tuple[SyncRef, ...]:
        """All references in it, those of its behaviors first."""
        own = (ref for behavior in self.behaviors for ref in behavior.syncs.values())
        pivots = (each.ref for each in self.constraints if isinstance(each, Order))
        return (*own, *pivots, *(ref for each in self.constraints for ref in each.refs))


@dataclass(frozen=True, slots=True)
class Problem:
    """A part of a document that cannot be read or played as written.

    Attributes:
        fault: the reason and the place; the type of its warning is ``fault.warning``.
        id: of the block, ``block:behavior``, or "bml" if no id could be read.
    """

    fault: Fault
    id: str


@dataclass(frozen=True, slots=True)
class Parsed:
    """The result of reading one top-level element of a document: a block, a procedure, or neither if it is refused.

    Attributes:
        block: without the parts that were dropped.
        problems: in document order; each is one warning.
        failed: whether a dropped part was required, so that the whole block fails.
        procedure: without the parts that were dropped.
    """

    block: BehaviorBlock | None
    problems: tuple[Problem, ...] = ()
    failed: bool = False
    procedure: DefineProc | None = None

    @property
    def refusal(self) -> Fault | None:
        """The reason for which the whole element is refused, if it is."""
        return None if self.written else self.problems[0].fault

    @property
    def written(self) -> BehaviorBlock | DefineProc | None:
        """The block or the procedure."""
        return self.block or self.procedure
