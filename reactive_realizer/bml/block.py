"""A block of behaviors, and what came of reading one."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.bml.attribute_types import Boolean, Name, Names, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.composition import CompositionText
from reactive_realizer.bml.constraint import Constraint, Order
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import Fault


@dataclass(frozen=True, slots=True, kw_only=True)
class BehaviorBlock:
    """A ``<bml>`` element, or a ``<useproc>``.

    Attributes:
        id: unique among the blocks alive.
        character: id of who is meant; None is the first one.
        composition: how it joins the earlier blocks.
        append_after: blocks that have ended before it starts; BMLA's appendAfter.
        chunk_after: blocks that subside before it starts: all that is left of them is in retraction.
        prepend_before: blocks that do not start before it has ended.
        chunk_before: blocks that do not start before it subsides.
        interrupts: blocks that are interrupted when it comes in; BMLA's interrupt.
        on_start: planned blocks that start when it starts.
        preplan: whether it waits to be activated.
        external_refs: whether its references may name behaviors of other blocks; only drafts have to say so.
        procedure: id of the procedure whose behaviors and constraints it has; then there are none here.
        behaviors: in document order, also those inside ``<required>``.
        constraints: in document order.
        unread: ids of the behaviors that were dropped because they cannot be read.
        extensions: attributes of other namespaces, (namespace, local name) to value.
        location: of its start tag.
    """

    id: str = field(metadata=attribute(Name()))
    character: str | None = field(default=None, metadata=attribute(Text(), "characterId"))
    composition: Composition = field(default=Composition.MERGE, metadata=attribute(CompositionText()))
    append_after: tuple[str, ...] = field(default=(), metadata=attribute(Names(), continuous=True))
    chunk_after: tuple[str, ...] = field(default=(), metadata=attribute(Names(), continuous=True))
    prepend_before: tuple[str, ...] = field(default=(), metadata=attribute(Names(), continuous=True))
    chunk_before: tuple[str, ...] = field(default=(), metadata=attribute(Names(), continuous=True))
    interrupts: tuple[str, ...] = field(default=(), metadata=attribute(Names(), "interrupt", continuous=True))
    on_start: tuple[str, ...] = field(default=(), metadata=attribute(Names(), continuous=True))
    preplan: bool = field(default=False, metadata=attribute(Boolean(), continuous=True))
    external_refs: bool = field(default=False, metadata=attribute(Boolean(), "allowexternalrefs", continuous=True))
    procedure: str | None = None
    behaviors: tuple[Behavior, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    unread: frozenset[str] = frozenset()
    extensions: Mapping[tuple[str, str], str] = field(default_factory=dict)
    location: Location

    @property
    def refs(self) -> tuple[SyncRef, ...]:
        """All references that stand in it, those of behaviors first."""
        own = (ref for behavior in self.behaviors for ref in behavior.syncs.values())
        pivots = (each.ref for each in self.constraints if isinstance(each, Order))
        return (*own, *pivots, *(ref for each in self.constraints for ref in each.refs))


@dataclass(frozen=True, slots=True)
class Problem:
    """Something of a document that cannot be as it was written.

    Attributes:
        fault: what, and where; the type of its warning is ``fault.kind.warning``.
        id: the block's, ``block:behavior``, or "bml" where no id could be read.
    """

    fault: Fault
    id: str


@dataclass(frozen=True, slots=True)
class Parsed:
    """What came of one top-level element of a document: a block, a procedure, or nothing where it is refused.

    Attributes:
        block: without what was dropped.
        problems: in document order; each is one warning.
        failed: whether something dropped was required, so that the block fails whole.
        procedure: without what was dropped.
    """

    block: BehaviorBlock | None
    problems: tuple[Problem, ...] = ()
    failed: bool = False
    procedure: DefineProc | None = None

    @property
    def refusal(self) -> Fault | None:
        """Why the whole of it is refused."""
        return None if self.block or self.procedure else self.problems[0].fault
