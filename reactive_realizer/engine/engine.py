"""The interface of a modality (thesis 8.6), and what all implementations share."""

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
        extensions: the attributes of other namespaces, (namespace, local name), that mean something to it.
        reads_parameters: whether it reads what behaviors say by ``bmlt:parameter``; it tells those of them itself that
            mean nothing to it. Of one that reads none, all are told without it.
        parameters: what of a kind of behaviors may be changed while it plays, by name.
        leads: whether it plays before the others in each round of a tick: what it asks for is done before they play.
    """

    name: str
    leads: bool
    behaviors: frozenset[type[Behavior]]
    extensions: frozenset[tuple[str, str]]
    reads_parameters: bool
    parameters: Mapping[type[Behavior], Mapping[str, Range]]

    def supports(self, behavior: Behavior) -> bool:
        """Whether a behavior is its own."""
        ...

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Slow work that planning needs first, run off the loop; None where there is none."""
        ...

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit for the behavior, with its preferred timing; it is not in the plan yet.

        Raises:
            RealizerError: it cannot be made; the fault says why.
        """
        ...

    def add(self, unit: PlanUnit) -> None:
        """Take a unit with its pegs into the plan."""
        ...

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan, without a trace."""
        ...

    def play(self, tick: Tick) -> Play:
        """Play what is due; never blocks.

        Called once or more in each tick in which it has units, or in which one was taken from it or a frame is due.
        """
        ...

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        """Drop every unit: the engine itself has failed."""
        ...

    def reset(self, time: GlobalTime) -> None:
        """Go back to how everything was at first, whatever behaviors have left behind: a block replaces all others."""
        ...


class DefaultEngine:
    """An engine around a `Player`; modalities override what they have."""

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
        """Behaviors of its kinds, and no special cases of these."""
        return type(behavior) in self.behaviors

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Nothing is slow."""
        return None

    def add(self, unit: PlanUnit) -> None:
        """Take a unit into the plan."""
        self.player.add(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan."""
        self.player.remove(unit)

    def play(self, tick: Tick) -> Play:
        """Sync points that are due, and, where a frame is, what is seen and heard."""
        self._reached += self.player.play(tick)
        return Play(
            layers=self.layers(tick) if tick.frame else (),
            face=self.face(tick) if tick.frame else {},
            eyes=self.eyes(tick) if tick.frame else None,
            audio=self.audio(tick),
            requests=(*self.player.take_ending(), *self.requests(tick)),
            dropped=self.player.take_dropped(),  # by all of the above
            reached=self._take_reached(),  # nothing raised: else `fail` tells it
        )

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        """Drop every unit; what was reached before the failure is told."""
        dropped, units = self.player.take_dropped(), self.player.units
        for unit in units:
            unit.drop(time)
            self.player.remove(unit)
        return Play(self._take_reached(), (*dropped, *(Dropped(unit, fault) for unit in units)))

    def reset(self, time: GlobalTime) -> None:
        """Nothing is left behind."""

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """What others are to do now."""
        return ()

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """What turns the joints now."""
        return ()

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Weights of morphs now."""
        return {}

    def eyes(self, tick: Tick) -> Eyes | None:
        """What the eyes do now, once the head is composed."""
        return None

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """What became audible, moved or fell silent since the last tick."""
        return ()

    def _take_reached(self) -> tuple[Reached, ...]:
        reached, self._reached = tuple(self._reached), []
        return reached
