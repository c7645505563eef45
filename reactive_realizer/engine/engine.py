"""The interface of a modality (thesis 8.6), and a default implementation."""

from collections.abc import Awaitable, Mapping
from types import MappingProxyType
from typing import Protocol

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.humanoid import Eyes
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engine.effects import Dropped, Play, Reached, Request
from reactive_realizer.engine.player import Player
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.plan_unit import PlanUnit


class Engine(Protocol):
    """One modality of one character.

    Attributes:
        name: for logs: ``character/modality``.
        behaviors: the kinds of behaviors it plays.
        extensions: the attributes of other namespaces that it uses, (namespace, local name).
        reads_parameters: whether it reads ``bmlt:parameter`` elements; then it warns of unknown parameters itself.
            Otherwise, the scheduler warns of all of them.
        parameters: the parameters of its behaviors that may be changed while they play, by name.
        leads: whether it plays before the others in each round of a tick, and its requests are carried out before the
            others play.
    """

    name: str
    leads: bool
    behaviors: frozenset[type[Behavior]]
    extensions: frozenset[tuple[str, str]]
    reads_parameters: bool
    parameters: Mapping[type[Behavior], Mapping[str, Range]]

    def supports(self, behavior: Behavior) -> bool:
        """Whether it plays a behavior."""
        ...

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Slow work to be done before planning, outside of the event loop; None if there is none."""
        ...

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit for the behavior, with its preferred timing; it is not in the plan yet.

        Raises:
            RealizerError: the unit cannot be created; the fault states the reason.
        """
        ...

    def add(self, unit: PlanUnit) -> None:
        """Take a unit with its pegs into the plan."""
        ...

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan, without effects."""
        ...

    def play(self, tick: Tick) -> Play:
        """Play what is due; never blocks.

        Called at least once in each tick in which it has units, lost one, or a frame is due.
        """
        ...

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        """Drop every unit, because the engine itself has failed."""
        ...

    def reset(self, time: GlobalTime) -> None:
        """Undo the lasting effects of behaviors, because a block replaces all others."""
        ...


class DefaultEngine:
    """An engine with a `Player`; modalities override its methods."""

    leads: bool = False
    behaviors: frozenset[type[Behavior]] = frozenset()
    extensions: frozenset[tuple[str, str]] = frozenset()
    reads_parameters: bool = False
    parameters: Mapping[type[Behavior], Mapping[str, Range]] = MappingProxyType({})

    def __init__(self, name: str) -> None:
        self.name = name
        self.player = Player()
        self._reached: list[Reached] = []

    def supports(self, behavior: Behavior) -> bool:
        """Whether a behavior is of one of its kinds, not of a subclass."""
        return type(behavior) in self.behaviors

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """No slow work."""
        return None

    def add(self, unit: PlanUnit) -> None:
        """Take a unit into the plan."""
        self.player.add(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan."""
        self.player.remove(unit)

    def play(self, tick: Tick) -> Play:
        """The sync points that are due and, if a frame is due, its layers, face and eyes."""
        self._reached += self.player.play(tick)
        return Play(
            layers=self.layers(tick) if tick.frame else (),
            face=self.face(tick) if tick.frame else {},
            eyes=self.eyes(tick) if tick.frame else None,
            audio=self.audio(tick),
            requests=(*self.player.take_ending(), *self.requests(tick)),
            dropped=self.player.take_dropped(),  # by all of the above
            reached=self._take_reached(),  # last: if anything raises, `fail` returns them
        )

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        """Drop every unit; the points reached before the failure are returned too."""
        dropped, units = self.player.take_dropped(), self.player.units
        for unit in units:
            unit.drop(time)
            self.player.remove(unit)
        return Play(self._take_reached(), (*dropped, *(Dropped(unit, fault) for unit in units)))

    def reset(self, time: GlobalTime) -> None:
        """No lasting effects."""

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """The requests of this tick."""
        return ()

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """The layers of joint rotations of this tick."""
        return ()

    def face(self, tick: Tick) -> Mapping[str, float]:
        """The weights of morphs of this tick."""
        return {}

    def eyes(self, tick: Tick) -> Eyes | None:
        """The movement of the eyes in this tick, applied after the head."""
        return None

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """The changes of audio since the last tick."""
        return ()

    def _take_reached(self) -> tuple[Reached, ...]:
        reached, self._reached = tuple(self._reached), []
        return reached
