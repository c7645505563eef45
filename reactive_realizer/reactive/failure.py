"""What stands where a value would be."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Failure:
    """The formula of a cell raised: an error as a value, which spreads, is recorded and heals like any other.

    Two failures for the same reason are equal, so that one that repeats itself wakes nobody.

    Attributes:
        cell: name of the cell whose formula raised.
        reason: what it raised, for people.
        error: what it raised.
    """

    cell: str
    reason: str
    error: Exception = field(compare=False, repr=False)
