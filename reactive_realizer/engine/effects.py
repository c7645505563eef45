"""What playing gives back: an engine changes nothing outside itself, it says what is to be changed."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.humanoid import Eyes
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Parameter
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
class ActivateBlock:
    """A preplanned block is to start.

    Attributes:
        unit: who asks.
        target: id of the block.
        time: from when on.
    """

    unit: PlanUnit
    target: str
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class InterruptBlock:
    """A block, or some behaviors of it, are to be cut.

    Attributes:
        unit: who asks.
        target: id of the block.
        include: ids of the behaviors to be cut; none named: all.
        exclude: ids of the behaviors to be spared.
        gently: whether a speech may end its word.
        time: when.
    """

    unit: PlanUnit
    target: str
    include: tuple[str, ...]
    exclude: tuple[str, ...]
    gently: bool
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class BindParameter:
    """A unit wants to change a parameter of a behavior: ``unit.bind(parameter)`` is called, or the unit is dropped.

    Attributes:
        unit: who asks.
        block: id of the target's block.
        behavior: id of the target.
        parameter: its name.
    """

    unit: "ParameterUser"
    block: str
    behavior: str
    parameter: str


@dataclass(frozen=True, slots=True)
class SetParameter:
    """A parameter is to have a value from now on; ignored if another unit has bound the parameter since."""

    unit: PlanUnit
    parameter: Parameter
    value: float


@dataclass(frozen=True, slots=True)
class EndUnit:
    """A unit ends of its own accord before its time: nothing is missing of it, and nobody is warned.

    Attributes:
        unit: which; it plays.
        time: when; its points ahead are dealt with as those of an interrupted one.
    """

    unit: PlanUnit
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class Warn:
    """Something is wrong with a unit that plays on.

    Attributes:
        unit: which.
        fault: what.
    """

    unit: PlanUnit
    fault: Fault


class ParameterUser(PlanUnit, ABC):
    """A unit that changes a parameter of another one."""

    @abstractmethod
    def bind(self, parameter: Parameter) -> None:
        """Change this one.

        Raises:
            RealizerError: it cannot be changed so; the unit is to be dropped.
        """


Request = ActivateBlock | InterruptBlock | BindParameter | SetParameter | EndUnit | Warn
"""What an engine asks the scheduler to do, in the same tick."""


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
        requests: what others are to do.
    """

    reached: tuple[Reached, ...] = ()
    dropped: tuple[Dropped, ...] = ()
    layers: tuple[Layer, ...] = ()
    face: Mapping[str, float] = field(default_factory=dict)
    eyes: Eyes | None = None
    audio: tuple[AudioChange, ...] = ()
    requests: tuple[Request, ...] = ()
