"""The interface of a modality (thesis 8.6), and a default implementation."""

from collections.abc import AsyncGenerator, Awaitable, Callable, Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.humanoid import Dynamics, Eyes
from reactive_realizer.embodiment.picture import Picture
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engine.effects import NO_EFFECTS, Dropped, Output, Play, Reached, ReportFall, Request, Warn
from reactive_realizer.engine.player import Player
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.plan_unit import PlanUnit


@dataclass(frozen=True, slots=True)
class Part:
    """What slow work has done so far.

    Attributes:
        result: of all parts up to this one.
        last: whether no other one follows.
    """

    result: object
    last: bool


SlowWork = Awaitable[object] | AsyncGenerator[Part, None]
"""Work outside of the event loop, which gives its result at once or in parts."""


class Engine(Protocol):
    """One modality of one character.

    In the rounds of a tick, an engine plays if its next due time has come, or if it has called ``wake`` since it last
    played. Frames show its output after the last round.

    Attributes:
        name: for logs: ``character/modality``.
        behaviors: the kinds of behaviors it plays.
        extensions: the attributes of other namespaces that it uses, (namespace, local name).
        reads_parameters: whether it reads ``bmlt:parameter`` elements; then it warns of unknown parameters itself.
            Otherwise, the scheduler warns of all of them.
        parameters: the parameters of its behaviors that may be changed while they play, by name.
        leads: whether it plays before the others in each round of a tick, and its requests are carried out before the
            others play. A leading engine has no output.
    """

    name: str
    leads: bool
    behaviors: frozenset[type[Behavior]]
    extensions: frozenset[tuple[str, str]]
    reads_parameters: bool
    parameters: Mapping[type[Behavior], Mapping[str, Range]]

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push the figure at a segment; an engine that moves it by forces lets it give way.

        Args:
            joint: of the segment, or within it.
            force: N, in the figure's frame.
            duration: s, from the next frame on.
        """
        ...

    @property
    def needs_frames(self) -> bool:
        """Whether showing frames now has effects other than the frames, so that they are shown without listeners."""
        ...

    def supports(self, behavior: Behavior) -> bool:
        """Whether it plays a behavior."""
        ...

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """The sync points that the unit of a behavior would have; None if only slow work can tell.

        It is called before the block of the behavior enters, has no effects and is fast, because a client waits for it.

        Raises:
            RealizerError: `plan` would raise it too, as things are now.
        """
        ...

    def prepare(self, behavior: Behavior) -> SlowWork | None:
        """Slow work to be done before planning; None if there is none.

        Of work in parts, planning waits only for the first one; the result of each other one is given to `extend`.
        """
        ...

    def extend(self, unit: PlanUnit, prepared: object, now: GlobalTime) -> None:
        """Have a unit that waits or plays take a later result of its slow work.

        It may get another timing, with the same points and phases of the same kind; what has begun does not change.
        """
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

    @property
    def next_due(self) -> Time:
        """A time before which it has nothing to play, as far as it is known; None while it only waits."""
        ...

    def listen(self, wake: Callable[[], None]) -> None:
        """Call ``wake()`` whenever something has changed on which its playing depends, such as its plan or a peg."""
        ...

    def play(self, tick: Tick) -> Play:
        """Play what is due; never blocks. It may be called several times in a tick."""
        ...

    def show(self, tick: Tick) -> Output:
        """The output for the frame of a tick; never blocks. Called after the last round of the tick.

        It is called once more if its effects have changed something.
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

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Do nothing."""

    @property
    def needs_frames(self) -> bool:
        """False: it plays the same whether frames are shown or not."""
        return False

    def supports(self, behavior: Behavior) -> bool:
        """Whether a behavior is of one of its kinds, not of a subclass."""
        return type(behavior) in self.behaviors

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """Nothing is known about a behavior before it is planned."""
        return None

    def prepare(self, behavior: Behavior) -> SlowWork | None:
        """No slow work."""
        return None

    def extend(self, unit: PlanUnit, prepared: object, now: GlobalTime) -> None:
        """Do nothing: its slow work is done when a unit is planned."""

    def add(self, unit: PlanUnit) -> None:
        """Take a unit into the plan."""
        self.player.add(unit)

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan."""
        self.player.remove(unit)

    @property
    def next_due(self) -> Time:
        """A time before which no unit begins or reaches a point; None while no such time is known."""
        return self.player.next_due

    def listen(self, wake: Callable[[], None]) -> None:
        """Call ``wake()`` when units enter, leave or change."""
        self.player.listen(wake)

    def play(self, tick: Tick) -> Play:
        """The sync points that are due, with audio and requests."""
        self._reached += self.player.play(tick)
        return Play(
            audio=self.audio(tick),
            requests=(*self.player.take_ending(), *self.requests(tick), *self.warnings()),
            dropped=self.player.take_dropped(),  # by all of the above
            reached=self._take_reached(),  # last: if anything raises, `fail` returns them
        )

    def show(self, tick: Tick) -> Output:
        """Layers, face, eyes and pictures; a unit that fails is dropped."""
        layers, face, eyes, dynamics = self.layers(tick), self.face(tick), self.eyes(tick), self.dynamics(tick)
        pictures = self.pictures(tick)
        dropped, warnings = self.player.take_dropped(), self.warnings()
        effects = Play(dropped=dropped, requests=warnings) if dropped or warnings else NO_EFFECTS
        return Output(layers, face, eyes, effects, dynamics, pictures)

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

    def warnings(self) -> tuple[Warn | ReportFall, ...]:
        """The warnings about units, and falls, since the last call, asked for after playing and after showing."""
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

    def dynamics(self, tick: Tick) -> Dynamics | None:
        """The movement of joints by forces in this tick, applied before that of the eyes."""
        return None

    def pictures(self, tick: Tick) -> tuple[Picture, ...]:
        """The pictures of this tick, those of one layer from the lowest to the uppermost."""
        return ()

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """The changes of audio since the last call."""
        return ()

    def _take_reached(self) -> tuple[Reached, ...]:
        reached, self._reached = tuple(self._reached), []
        return reached
