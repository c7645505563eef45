"""The inputs of a realizer. Equal inputs at equal ticks give equal sessions."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from reactive_realizer.bml.block import Parsed
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import Fault

WorldPosition = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class BmlText:
    """A document of one or more blocks.

    Attributes:
        text: the document.
        parsed: the parsed document, if it was parsed before; otherwise it is parsed when it enters.
    """

    text: str | bytes
    parsed: Sequence[Parsed] | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Prediction:
    """A prediction of a point of an anticipator; None withdraws it."""

    anticipator: str
    sync: str
    time: GlobalTime | None


@dataclass(frozen=True, slots=True)
class Event:
    """An event, setting or text from which an anticipator makes predictions."""

    anticipator: str
    name: str
    value: float | None = None
    text: str | None = None


@dataclass(frozen=True, slots=True)
class TargetMoved:
    """A new position (m, world) of a target; None if it is removed."""

    target: str
    position: WorldPosition | None


Input = BmlText | Prediction | Event | TargetMoved


@dataclass(frozen=True, slots=True)
class Delivery:
    """The delivery of a result of slow work.

    Attributes:
        request: number of the work, in order of request, from 1.
        failure: the fault of work that failed; None if there is a result.
    """

    request: int
    failure: Fault | None = None


@dataclass(frozen=True, slots=True)
class TickInputs:
    """All inputs of one tick.

    Attributes:
        tick: its number; numbers are skipped when a tick is late.
        inputs: in the order in which they were applied.
        work: in the order in which it was delivered.
    """

    tick: int
    inputs: tuple[Input, ...] = ()
    work: tuple[Delivery, ...] = ()
