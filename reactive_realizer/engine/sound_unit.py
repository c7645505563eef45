"""The plan unit of a behavior that is heard."""

from collections.abc import Iterable
from math import inf
from typing import ClassVar, Final, NamedTuple, Protocol, runtime_checkable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.audio import Caption, Sound
from reactive_realizer.engine.hearing import Hearing
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import TimePeg
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Timing
from reactive_realizer.reactive.graph import Graph

VOLUME_RANGE: Final = Range(0.0, 100.0)

_VOLUME_OF_GAIN_1: Final = 50.0
"""The volume with a gain of 1."""


class SoundPart(NamedTuple):
    """A sound within a behavior.

    Attributes:
        begin: s after the start of the behavior.
        sound: what is heard.
        until: when another sound takes its place, s after the start of the behavior.
    """

    begin: float
    sound: Sound
    until: float = inf

    @property
    def end(self) -> float:
        """When it is over, s after the start of the behavior."""
        return min(self.begin + self.sound.duration, self.until)


@runtime_checkable
class Speaking(Protocol):
    """A unit that speaks; if its words are sync points, they are called ``word0``, ``word1`` and so on.

    Attributes:
        utterance: what is spoken, with the times of its words, s from the start of the unit.
        sounds: what is made of it, in the order of time; parts that were waited for are later than in the utterance.
    """

    utterance: Utterance
    sounds: list[SoundPart]


class SoundUnit(PlanUnit):
    """A sound. Its parameter ``volume`` may be changed while it plays.

    Attributes:
        sounds: its parts in the order of time, as far as they are there.
        hearing: what is known of its sound since its start, None before.
        cut: time at which it was interrupted, None if it was not.
        elastic: whether the times within it, of its caption, may move; then, it has no sound.
    """

    elastic: ClassVar[bool] = False

    def __init__(
        self,
        block: BlockKey,
        behavior: Behavior,
        timing: Timing,
        sounds: list[SoundPart],
        graph: Graph,
        resources: frozenset[str] = frozenset(),
    ) -> None:
        super().__init__(block, behavior, timing, resources)
        self.sounds = sounds
        self.hearing: Hearing | None = None
        self.cut: GlobalTime | None = None
        self._volume = Parameter(graph, str(self.key("volume")), _VOLUME_OF_GAIN_1, VOLUME_RANGE)
        self.parameters["volume"] = self._volume

    @property
    def loose(self) -> bool:
        """Whether its sound follows its points, so that these need not follow what is heard."""
        return False

    @property
    def caption(self) -> Caption | None:
        """What is read while it is heard; None if nothing is."""
        return None

    @property
    def heard_by(self) -> Iterable[TimePeg]:
        """The pegs on which depends what is told of it ahead: that of its start."""
        return (point.peg for point in self.points[:1])

    def make_sound(self, now: GlobalTime) -> None:
        """Make the sound that will be heard soon, if it is not there."""

    @property
    def duration(self) -> float:
        """Of its timing, s."""
        return self.timing.offsets[-1]

    @property
    def length(self) -> float:
        """How long it is heard, s."""
        return self.duration

    @property
    def gain(self) -> float:
        """The gain of its sound; 1 is as recorded."""
        return self._volume.value / _VOLUME_OF_GAIN_1

    def on_start(self, time: GlobalTime) -> None:
        """Notes the time of the start."""
        self.hearing = Hearing(time)

    def on_finish(self, time: GlobalTime) -> None:
        """Notes whether the sound ends early."""
        if self.hearing is not None and self.position(time) < self.duration - RESOLUTION:
            self.cut = time

    def position(self, time: GlobalTime) -> float:
        """The position in the sound that is heard at a time, s; 0 before it has started."""
        return 0.0 if self.hearing is None else time - self.hearing.origin

    @property
    def origin(self) -> Time:
        """When its first sample is heard: at its start or, if it has drifted, as if all had been heard like this."""
        return self.time("start") if self.hearing is None else self.hearing.origin
