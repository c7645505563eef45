"""Faults of references: blocks, behaviors and sync points that do not exist, or do not any more."""

from reactive_realizer.errors import SchedulingFault


class UnknownReference(SchedulingFault):
    """A reference to a behavior that does not exist."""

    code = "unknown-reference"
    template = "{reference}: there is no behavior '{behavior}'; available: {known}"
    unknown = "behavior"
    reference: str
    behavior: str
    known: tuple[str, ...]


class UnknownSync(SchedulingFault):
    """A reference to a sync point that its behavior does not have."""

    code = "unknown-sync"
    template = "{reference}: '{behavior}' has no sync point '{sync}'; it has {known}"
    unknown = "sync"
    reference: str
    behavior: str
    sync: str
    known: tuple[str, ...]


class UnknownBlock(SchedulingFault):
    """A reference to a block that does not exist, or has ended."""

    code = "unknown-block"
    template = "{reference}: the block '{block}' is unknown or has ended"
    unknown = "block"
    reference: str
    block: str
    known: tuple[str, ...] = ()


class UnknownBlockPoint(SchedulingFault):
    """A reference to a sync point that a block does not have."""

    code = "unknown-block-point"
    template = "{reference}: the block '{block}' has no sync point '{sync}'; it has {known}"
    unknown = "sync"
    reference: str
    block: str
    sync: str
    known: tuple[str, ...]


class UnknownOwner(SchedulingFault):
    """A reference to a block or behavior that does not exist."""

    code = "unknown-owner"
    template = (
        "{reference}: '{block}' is neither a behavior of this block nor a block that is still alive; behaviors: {known}"
    )
    unknown = "block"
    reference: str
    block: str
    known: tuple[str, ...]


class LostWith(SchedulingFault):
    """A reference to a behavior that was dropped."""

    code = "lost-with"
    template = "{reference} has no time because '{behavior}' is dropped; what depends on it is dropped too"
    reference: str
    behavior: str
