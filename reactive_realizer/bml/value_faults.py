"""Faults of the values of attributes: each is the reason in a `BadAttribute`."""

from reactive_realizer.errors import Fault


class NotAnId(Fault):
    """A value that is not an id."""

    code = "not-an-id"
    template = (
        "an id must have 1 to 200 characters, without white space, control characters, ':' or '+', and cannot be 'bml'"
    )


class NotAVector(Fault):
    """A value that is not a vector."""

    code = "not-a-vector"
    template = "a vector has three numbers, not {size}"
    size: int


class NotWhole(Fault):
    """A value that is not a whole number."""

    code = "not-whole"
    template = "not a whole number"


class OutOfRange(Fault):
    """A number outside of its range."""

    code = "out-of-range"
    template = "not between {low} and {high}"
    low: str
    high: str


class UnknownWord(Fault):
    """A value outside of an enumeration."""

    code = "unknown-word"
    template = "not one of {known}"
    unknown = "word"
    word: str
    known: tuple[str, ...]


class NotAnEvent(Fault):
    """A value that is not the name of an event."""

    code = "not-an-event"
    template = (
        "not the name of an event: it has at most 200 characters, no white space, ':' or '+', and does not end in '-' "
        "and a number"
    )


class NotAReference(Fault):
    """A value that is not a sync reference."""

    code = "not-a-reference"
    template = "not a sync reference; write [block:]behavior:sync[+seconds], or seconds"


class OnlyBlockStart(Fault):
    """A sync point of a block that references cannot name."""

    code = "only-block-start"
    template = "a reference can name the start of its own block, or a sync point of another block: {known}"
    known: tuple[str, ...]


class NotOwnPoint(Fault):
    """A sync point of a block that is not defined by a point of a behavior of this block."""

    code = "not-own-point"
    template = "a sync point of a block is one of its behaviors, behavior:sync, without an offset"


class NotOuterPoint(Fault):
    """A start of a block that is not tied to another block or an anticipator."""

    code = "not-outer-point"
    template = "a block can start at a sync point of another block or of an anticipator"


class ExternalReference(Fault):
    """A reference of a draft to a behavior of another block."""

    code = "external-reference"
    template = "this behavior belongs to another block; a draft must set bmlt:allowexternalrefs='true' to refer to it"


class AbsurdTime(Fault):
    """A time that is too far away, in s."""

    code = "absurd-time"
    template = "times cannot exceed {limit:g} s"
    limit: float
