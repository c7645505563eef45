"""Behaviors that are written once and played many times (thesis 6.6.2)."""

from dataclasses import dataclass, field
from typing import Final

from reactive_realizer.bml.attribute_types import Name
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.constraint import Constraint
from reactive_realizer.bml.names import Location

DEFINE: Final = "defineproc"
USE: Final = "useproc"
PROCEDURES: Final = frozenset({DEFINE, USE})
"""Elements of continuous interaction that stand beside blocks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DefineProc:
    """A ``<defineproc>``: behaviors and constraints without a block; nothing of it plays.

    It stands beside blocks, as the thesis has it, and a later one with the same id takes its place.

    Attributes:
        id: its name among procedures.
        behaviors: in document order, also those inside ``<required>``.
        constraints: in document order.
        unread: ids of the behaviors that were dropped because they cannot be read.
        location: of its start tag.
    """

    id: str = field(metadata=attribute(Name()))
    behaviors: tuple[Behavior, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    unread: frozenset[str] = frozenset()
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class UseProc:
    """What a ``<useproc>`` says beside the attributes of a block.

    Attributes:
        procedure: id of the procedure.
        block: id of the block that it becomes.
    """

    procedure: str = field(metadata=attribute(Name(), "procid"))
    block: str = field(metadata=attribute(Name(), "bmlid"))
