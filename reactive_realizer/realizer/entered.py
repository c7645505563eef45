"""What entered a realizer at a tick: with the same at the same ticks, a session is the same."""

from dataclasses import dataclass

from reactive_realizer.errors import Fault
from reactive_realizer.realizer.inputs import Input


@dataclass(frozen=True, slots=True)
class Delivery:
    """The result of slow work, handed over.

    Attributes:
        request: which work it is, in order of request, from 1.
        failure: why there is no result; None where there is one.
    """

    request: int
    failure: Fault | None = None


@dataclass(frozen=True, slots=True)
class Entered:
    """All that one tick took in.

    Attributes:
        tick: its number; ticks that came late leave out numbers.
        inputs: in the order in which they were applied.
        work: in the order in which it was handed over.
    """

    tick: int
    inputs: tuple[Input, ...] = ()
    work: tuple[Delivery, ...] = ()
