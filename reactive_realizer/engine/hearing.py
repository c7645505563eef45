"""Engines with sounds, which clients report when they are heard."""

from typing import NamedTuple, Protocol, runtime_checkable

from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.planunit.plan_unit import PlanUnit


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
