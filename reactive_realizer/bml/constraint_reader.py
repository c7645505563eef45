"""From the child of a ``<constraint>`` to a constraint."""

from typing import Final

from reactive_realizer.bml.constraint import Constraint, Order, OrderKind, Synchronize
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import Tree, children_of, name_of
from reactive_realizer.errors import Fault, RealizerError

SYNCHRONIZE: Final = "synchronize"
CONSTRAINTS: Final = (SYNCHRONIZE, *OrderKind)
"""The elements that may stand in a ``<constraint>``."""


def read_constraint(
    tree: Tree, constraint_id: str | None, source: Source, required: bool, notes: list[Fault]
) -> Constraint:
    """The constraint that an element of `CONSTRAINTS` writes.

    Args:
        tree: the element.
        constraint_id: of the ``<constraint>`` around it.
        source: its block.
        required: whether the block fails without it.
        notes: takes the faults that do not prevent it.

    Raises:
        RealizerError: a reference is missing or bad.
    """
    location = source.location(tree)
    if name_of(tree) == SYNCHRONIZE:
        notes += source.unread(tree, [], ["sync"])
        refs = _refs(tree, 2, source, notes)
        return Synchronize(id=constraint_id, refs=refs, required=required, location=location)
    notes += source.unread(tree, ["ref"], ["sync"])
    return Order(
        kind=OrderKind(name_of(tree)),
        id=constraint_id,
        ref=source.ref(tree, "ref"),
        refs=_refs(tree, 1, source, notes),
        required=required,
        location=location,
    )


def _refs(tree: Tree, least: int, source: Source, notes: list[Fault]) -> tuple[SyncRef, ...]:
    syncs = children_of(tree, "sync")
    if len(syncs) < least:
        raise RealizerError(source.fault(tree, "missing-element", children=" and ".join(["<sync>"] * least)))
    for sync in syncs:
        notes += source.unread(sync, ["ref"])
    return tuple(source.ref(sync, "ref") for sync in syncs)
