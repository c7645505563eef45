"""The inputs of a realizer. Equal inputs at equal ticks give equal sessions."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from reactive_realizer.bml.block import Parsed
from reactive_realizer.clock.units import Time
from reactive_realizer.embodiment.audio import AudioHeard, StreamedAudio
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.errors import Fault

WorldPosition = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class BmlText:
    """A document of one or more blocks.

    Attributes:
        text: the document.
        client: that sent it; empty for the session itself. Clients take turns in planning.
        number: of the document in the session, from which its blocks without id get one; 0 if it has none yet.
        media_type: of the document if it determines its dialect; otherwise, the content does.
        parsed: the parsed document, if it was parsed before; otherwise it is parsed when it enters.
    """

    text: str | bytes
    client: str = ""
    number: int = 0
    media_type: str = ""
    parsed: Sequence[Parsed] | None = field(default=None, compare=False, repr=False)

    @property
    def name(self) -> str:
        """The id of its first block without one, with which the ids of the others begin."""
        return f"document{self.number}"


@dataclass(frozen=True, slots=True)
class Prediction:
    """A prediction of a point of an anticipator, by a client or by its own stream; None withdraws it."""

    anticipator: str
    sync: str
    time: Time


@dataclass(frozen=True, slots=True)
class Event:
    """An event, setting or text from which an anticipator makes predictions."""

    anticipator: str
    name: str
    value: float | None = None
    text: str | None = None


@dataclass(frozen=True, slots=True)
class TargetMoved:
    """A new place of a target; one with a number that is not finite is skipped, with a log message.

    Attributes:
        target: its name.
        position: m, in the world; None if it is removed.
        orientation: a unit quaternion from its axes to those of the world; None to keep the one that it has. A place
            with a quaternion of another length is skipped too.
    """

    target: str
    position: WorldPosition | None
    orientation: Quat | None = None


@dataclass(frozen=True, slots=True)
class Push:
    """A push of a character, which gives way where forces move it.

    Attributes:
        character: its id.
        joint: of the pushed segment, or within it.
        force: N, in the axes of the world.
        duration: s, from the next frame on.
    """

    character: str
    joint: str
    force: Vec3
    duration: float


Input = BmlText | Prediction | Event | TargetMoved | AudioHeard | Push | StreamedAudio


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
class Revocation:
    """The last occurrence of a recurring point does not count."""

    anticipator: str
    sync: str


@dataclass(frozen=True, slots=True)
class StreamFailure:
    """The failure of the stream of an anticipator, which ends it; the reason is for people."""

    anticipator: str
    reason: str


Predicted = Prediction | Revocation | StreamFailure
"""What the streams of anticipators give."""


@dataclass(frozen=True, slots=True)
class Forecast:
    """The answer of an anticipator that was asked for the time of a counted point."""

    anticipator: str
    sync: str
    time: Time


@dataclass(frozen=True, slots=True)
class TickInputs:
    """Everything that determines a tick.

    Attributes:
        tick: its number; numbers are skipped when a tick is late.
        inputs: in the order in which they entered.
        work: in the order in which it was delivered.
        predicted: in the order in which it was applied.
        forecasts: the answers during the tick, in order; empty until it has been played.
        watched: whether frames had listeners. Forces move bodies only in ticks with frames.
    """

    tick: int
    inputs: tuple[Input, ...] = ()
    work: tuple[Delivery, ...] = ()
    predicted: tuple[Predicted, ...] = ()
    forecasts: tuple[Forecast, ...] = ()
    watched: bool = False
