"""What playing gives back: an engine changes nothing outside itself, it says what is to be changed."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.humanoid import Eyes
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint


@dataclass(frozen=True, slots=True)
class Reached:
    """A sync point was reached.

    Attributes:
        unit: whose.
        point: which.
        time: the time of its peg.
        details: attributes that its feedback carries beside the time.
    """

    unit: PlanUnit
    point: SyncPoint
    time: GlobalTime
    details: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Dropped:
    """A unit left the plan, and why."""

    unit: PlanUnit
    fault: Fault


@dataclass(frozen=True, slots=True)
class Play:
    """All that an engine says in one round of a tick.

    Attributes:
        reached: sync points, in order.
        dropped: units that left the plan.
        layers: what turns the joints, in the frame that is due.
        face: weights of morphs, 0..1, in the frame that is due; those of several engines add up.
        eyes: what the eyes do in the frame that is due, once the head is composed.
        audio: what became audible, moved or fell silent.
    """

    reached: tuple[Reached, ...] = ()
    dropped: tuple[Dropped, ...] = ()
    layers: tuple[Layer, ...] = ()
    face: Mapping[str, float] = field(default_factory=dict)
    eyes: Eyes | None = None
    audio: tuple[AudioChange, ...] = ()
