"""What enters a realizer; every input waits for a tick."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from reactive_realizer.bml.block import Parsed
from reactive_realizer.clock.units import GlobalTime

Position = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class BmlText:
    """A document of one or more blocks.

    Attributes:
        text: the document.
        parsed: what came of it, where somebody has read it already; else it is read as it enters.
    """

    text: str | bytes
    parsed: Sequence[Parsed] | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Prediction:
    """When a point of an anticipator is now said to be; None withdraws what was said."""

    anticipator: str
    sync: str
    time: GlobalTime | None


@dataclass(frozen=True, slots=True)
class Event:
    """Something happened, was set or was said, that an anticipator makes predictions from."""

    anticipator: str
    name: str
    value: float | None = None
    text: str | None = None


@dataclass(frozen=True, slots=True)
class TargetMoved:
    """A target of the world is elsewhere (m), or gone."""

    target: str
    position: Position | None


Input = BmlText | Prediction | Event | TargetMoved
