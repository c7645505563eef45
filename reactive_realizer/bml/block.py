"""A block of behaviors, and what came of reading one."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.bml.attributes import Name, Text, Word, attribute
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.constraint import Constraint
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.words import Composition
from reactive_realizer.errors import Fault


@dataclass(frozen=True, slots=True, kw_only=True)
class BehaviorBlock:
    """A ``<bml>`` element.

    Attributes:
        id: unique among the blocks alive.
        character: id of who is meant; None is the first one.
        composition: how it joins the earlier blocks.
        behaviors: in document order, also those inside ``<required>``.
        constraints: in document order.
        extensions: attributes of other namespaces, (namespace, local name) to value.
        location: of its start tag.
    """

    id: str = field(metadata=attribute(Name()))
    character: str | None = field(default=None, metadata=attribute(Text(), "characterId"))
    composition: Composition = field(default=Composition.MERGE, metadata=attribute(Word(Composition)))
    behaviors: tuple[Behavior, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    extensions: Mapping[tuple[str, str], str] = field(default_factory=dict)
    location: Location


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
    """What came of one block of a document.

    Attributes:
        block: without what was dropped; None where the whole of it is refused.
        problems: in document order; each is one warning.
        failed: whether something dropped was required, so that the block fails whole.
    """

    block: BehaviorBlock | None
    problems: tuple[Problem, ...] = ()
    failed: bool = False
