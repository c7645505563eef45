"""What is heard of the sounds of behaviors, which may differ from their plan (thesis 8.17); clients report it."""

from typing import Final, NamedTuple, Protocol, runtime_checkable

from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit

FRAME: Final = 0.02
"""A drift of at most one frame (s) is not seen."""
MOST: Final = 1.0
"""The greatest drift from the plan that is believed, s."""


class OutsideSound(Fault):
    """A position that a sound does not have, s."""

    code = "outside-sound"
    template = "position {position} s is not in the sound '{id}', which lasts {duration} s"
    compared = ("position", "duration")
    position: float
    id: str
    duration: float


class FarOff(Fault):
    """A sound that is said to be heard at a time at which it cannot be heard; ``off`` and ``most`` in s."""

    code = "far-off"
    template = "the sound '{id}' would be heard {off} s off its plan; at most {most} s are possible"
    compared = ("off", "most")
    id: str
    off: float
    most: float


class Hearing:
    """The drift of one sound from its plan, from reports that are noisy.

    The drift is the median of the last two reports and of no drift: a median filter (J. W. Tukey, *Exploratory Data
    Analysis*, 1977) that keeps to the plan until two reports in a row agree that the sound is early, or late. A drift
    of at most a frame is ignored.

    Args:
        started: when it started, s.

    Attributes:
        drift: by how much it is heard later than planned, s.
    """

    def __init__(self, started: GlobalTime) -> None:
        self.drift = 0.0
        self._started = started
        self._last = 0.0

    def check(self, heard: AudioHeard) -> None:
        """Check whether a report can be true.

        Raises:
            RealizerError: "far-off".
        """
        if not abs(off := self._off(heard)) <= MOST:
            raise RealizerError(FarOff(id=heard.id, off=off, most=MOST))

    def take(self, heard: AudioHeard) -> float:
        """The change of the drift (s) by a report that can be true; mostly 0."""
        off = self._off(heard) - self.drift
        change = sorted((0.0, self._last, off))[1]
        if abs(change) <= FRAME + RESOLUTION:
            self._last = off
            return 0.0
        self._last = 0.0
        self.drift += change
        return change

    @property
    def origin(self) -> GlobalTime:
        """When its first sample was heard, as far as the drift says, s."""
        return GlobalTime(self._started + self.drift)

    def _off(self, heard: AudioHeard) -> float:
        return heard.time - heard.position - self._started


class Drift(NamedTuple):
    """A behavior that is heard off its plan.

    Attributes:
        unit: the behavior.
        seconds: by which its points ahead are to come later; negative if it is heard early.
    """

    unit: PlanUnit
    seconds: float


@runtime_checkable
class HearingEngine(Protocol):
    """An engine that follows reports of what is heard of its sounds."""

    def check_heard(self, heard: AudioHeard) -> bool:
        """Whether a report is about a sound that it plays now.

        Raises:
            RealizerError: the report cannot be true.
        """
        ...

    def hear(self, heard: AudioHeard) -> Drift | None:
        """Take a report; the drift, if there is one to be made up for. A report that cannot be true is ignored."""
        ...
