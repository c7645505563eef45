"""The effects of playing: an engine changes nothing outside of itself, but returns requested changes."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.bml.extensions import Emit
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.humanoid import Dynamics, Eyes
from reactive_realizer.embodiment.picture import Picture
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.reactive.graph import Cell


class Reached(NamedTuple):
    """A sync point was reached.

    Attributes:
        unit: of the point.
        point: the sync point.
        time: of its peg, s, global.
    """

    unit: PlanUnit
    point: SyncPoint
    time: GlobalTime

    @property
    def emits(self) -> Emit | None:
        """The behavior that emits its event at this point, if it is the start of one."""
        behavior = self.unit.behavior
        return behavior if isinstance(behavior, Emit) and self.point.id == "start" else None


class Dropped(NamedTuple):
    """A unit left the plan because of a fault."""

    unit: PlanUnit
    fault: Fault


@dataclass(frozen=True, slots=True)
class ActivateBlock:
    """Requests the start of a preplanned block.

    Attributes:
        unit: of the request.
        target: id of the block.
        time: earliest start, s, global.
    """

    unit: PlanUnit
    target: str
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class InterruptBlock:
    """Requests the interruption of a block, or of some of its behaviors.

    Attributes:
        unit: of the request.
        target: id of the block.
        include: ids of the behaviors to interrupt; all if empty.
        exclude: ids of the behaviors that continue.
        speech: the point at which a speech ends.
        time: s, global.
    """

    unit: PlanUnit
    target: str
    include: tuple[str, ...]
    exclude: tuple[str, ...]
    speech: InterruptSpeech
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class BindParameter:
    """Requests a parameter of a behavior: ``unit.bind(target, parameter)`` is called, or ``unit`` is dropped.

    Attributes:
        unit: of the request.
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
    """Requests a constant value for a parameter; ignored if another unit has bound the parameter since."""

    unit: PlanUnit
    parameter: Parameter
    value: float


@dataclass(frozen=True, slots=True)
class FollowCell:
    """Requests that a parameter follow a cell; ignored if another unit has bound the parameter since."""

    unit: PlanUnit
    parameter: Parameter
    cell: Cell[float]


@dataclass(frozen=True, slots=True)
class EndUnit:
    """Requests the early, regular end of a playing unit: it is not reported as interrupted, and there is no warning.

    Attributes:
        unit: of the request.
        time: s, global; its points ahead are treated as those of an interrupted unit.
    """

    unit: PlanUnit
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class MovePoints:
    """Requests that points ahead come at other times than their pegs say, with what is tied to them.

    Attributes:
        unit: of the points; its block plays.
        times: s, global, by sync id; a point whose time is unknown keeps the new one.
        time: of the request, s.
    """

    unit: PlanUnit
    times: Mapping[str, GlobalTime]
    time: GlobalTime


@dataclass(frozen=True, slots=True)
class Warn:
    """A warning about a unit that continues to play.

    Attributes:
        unit: of the request.
        fault: of the warning.
    """

    unit: PlanUnit
    fault: Fault


@dataclass(frozen=True, slots=True)
class ReportFall:
    """Requests feedback about a figure that has fallen.

    Attributes:
        unit: that moves the figure by forces.
        time: of the frame in which it has fallen, s, global.
    """

    unit: PlanUnit
    time: GlobalTime


class ParameterUser(PlanUnit, ABC):
    """A unit that changes a parameter of another unit."""

    @abstractmethod
    def bind(self, target: PlanUnit, parameter: Parameter) -> None:
        """Bind the parameter of another unit that it changes.

        Raises:
            RealizerError: it cannot be changed as planned, so this unit must be dropped.
        """


Request = (
    ActivateBlock
    | InterruptBlock
    | BindParameter
    | SetParameter
    | FollowCell
    | EndUnit
    | MovePoints
    | Warn
    | ReportFall
)
"""Requests of an engine to the scheduler, carried out in the same tick."""


class Play(NamedTuple):
    """The effects of one engine in one round of a tick.

    Attributes:
        reached: sync points, in order.
        dropped: units that left the plan.
        audio: sounds that start, move or stop.
        requests: to the scheduler.
    """

    reached: tuple[Reached, ...] = ()
    dropped: tuple[Dropped, ...] = ()
    audio: tuple[AudioChange, ...] = ()
    requests: tuple[Request, ...] = ()


NO_EFFECTS = Play()
"""The effects of most frames."""


class Output(NamedTuple):
    """The part of an engine in a frame.

    Attributes:
        layers: joint rotations.
        face: weights of morphs, and of turns of joints (`turn_weights`), 0..1; those of several engines are added.
        eyes: movement of the eyes, applied after the head.
        effects: of showing: units that failed, and warnings.
        dynamics: movement of joints by forces, applied before that of the eyes; None for a figure that none moves.
        pictures: those that show the character in place of its body.
    """

    layers: tuple[Layer, ...] = ()
    face: Mapping[str, float] = MappingProxyType({})
    eyes: Eyes | None = None
    effects: Play = NO_EFFECTS
    dynamics: Dynamics | None = None
    pictures: tuple[Picture, ...] = ()
