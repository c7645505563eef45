"""An engine behind a guard: whatever a plug-in raises or returns costs its own behaviors, and nothing else."""

import logging
from asyncio import CancelledError
from collections.abc import AsyncGenerator, Awaitable, Callable, Collection
from typing import Final, TypeVar

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.embodiment.humanoid import Dynamics, EyePose, Eyes
from reactive_realizer.embodiment.pose import check_layers
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engine.answer_checks import (
    check_body,
    check_drift,
    check_eyes,
    check_pictures,
    check_play,
    check_weights,
    expected,
    number,
)
from reactive_realizer.engine.effects import Dropped, Output, Play
from reactive_realizer.engine.engine import Engine, SlowWork
from reactive_realizer.engine.faults import EngineFailed
from reactive_realizer.engine.hearing import Drift, HearingEngine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit

logger = logging.getLogger(__name__)

T = TypeVar("T")

FAILURES: Final = (Exception, SystemExit, CancelledError, GeneratorExit)
"""The exceptions of a plug-in that cost only its own behaviors: all but KeyboardInterrupt.

A CancelledError cannot come from the event loop, because the guarded calls do not await.
"""


class GuardedEngine:
    """Passes calls on to an engine, and checks its answers; if a call fails, the engine drops its units.

    See `Engine` for the methods. `supports`, `check`, `prepare` and `plan` only cost the behavior that they concern.
    """

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self.name = engine.name
        self.leads = engine.leads
        self.behaviors = engine.behaviors
        self.extensions = engine.extensions
        self.reads_parameters = engine.reads_parameters
        self.parameters = engine.parameters
        self._units: dict[PlanUnit, None] = {}
        self._failure: BaseException | None = None
        """The exception of a call since the engine last played."""
        self._told = ""
        """The failure that was logged last."""
        self._wake: Callable[[], None] = lambda: None

    def supports(self, behavior: Behavior) -> bool:
        """Return whether the engine plays a behavior: False if it raises."""
        try:
            return bool(self.engine.supports(behavior))
        except FAILURES:
            logger.exception("engine %s does not know whether it plays <%s>", self.name, behavior.name)
            return False

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """The sync points that the unit of a behavior would have.

        Raises:
            Exception: as the engine does, or because it returns something else.
        """
        points = _called(lambda: self.engine.check(behavior))
        return None if points is None else [expected(str, point) for point in expected(Collection, points)]

    def prepare(self, behavior: Behavior) -> SlowWork | None:
        """Slow work to be done before planning.

        Raises:
            Exception: as the engine does, or because it returns something else.
        """
        work = _called(lambda: self.engine.prepare(behavior))
        return None if work is None else expected((Awaitable, AsyncGenerator), work)

    def extend(self, unit: PlanUnit, prepared: object, now: GlobalTime) -> None:
        """Have a unit take a later result of its slow work."""
        self._try(lambda: self.engine.extend(unit, prepared, now), None)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit for the behavior.

        Raises:
            Exception: as the engine does, or because it returns something else.
        """
        return expected(PlanUnit, _called(lambda: self.engine.plan(block, behavior, prepared)))

    @property
    def needs_frames(self) -> bool:
        """Whether frames have an effect on what it plays; False if it raises."""
        return self._try(lambda: bool(self.engine.needs_frames), False)

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push the figure; an exception is logged."""
        self._try(lambda: self.engine.push(joint, force, duration), None)

    def add(self, unit: PlanUnit) -> None:
        """Take a unit into the plan."""
        self._units[unit] = None
        self._try(lambda: self.engine.add(unit), None)

    def remove(self, unit: PlanUnit) -> None:
        """Take a unit out of the plan."""
        self._units.pop(unit, None)
        self._try(lambda: self.engine.remove(unit), None)

    @property
    def next_due(self) -> Time:
        """The time at which it next has something to play; an engine that cannot tell is due at once, and fails."""
        at_once: Time = GlobalTime(0.0)
        return self._try(self._next_due, at_once)

    def listen(self, wake: Callable[[], None]) -> None:
        """Call ``wake()`` whenever something has changed on which its playing depends."""
        self._wake = wake
        self._try(lambda: self.engine.listen(wake), None)

    def play(self, tick: Tick) -> Play:
        """Play what is due."""
        try:
            if self._failure is not None:
                raise self._failure
            return check_play(self.engine.play(tick))
        except FAILURES as failure:
            return self._drop_all(tick.time, failure)

    def show(self, tick: Tick) -> Output:
        """The output for the frame of a tick."""
        try:
            output = expected(Output, self.engine.show(tick))
            check_layers(expected((tuple, list), output.layers))
            check_weights(output.face)
            check_pictures(output.pictures)
            check_play(output.effects)
        except FAILURES as failure:
            return Output(effects=self._drop_all(tick.time, failure))
        if output.eyes is None and output.dynamics is None:
            return output
        return output._replace(eyes=self._guarded_eyes(output.eyes), dynamics=self._guarded_dynamics(output.dynamics))

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        """Drop every unit."""
        try:
            play = check_play(self.engine.fail(time, fault))
        except FAILURES:
            logger.exception("engine %s failed again", self.name)
            play = Play()
        done = {dropped.unit for dropped in play.dropped}
        left = [unit for unit in self._units if unit.live and unit not in done]
        for unit in left:
            unit.drop(time)
        return play._replace(dropped=(*play.dropped, *(Dropped(unit, fault) for unit in left)))

    def reset(self, time: GlobalTime) -> None:
        """Undo the lasting effects of behaviors."""
        self._try(lambda: self.engine.reset(time), None)

    def check_heard(self, heard: AudioHeard) -> bool:
        """As `HearingEngine.check_heard`; False for other engines.

        Raises:
            RealizerError: the report cannot be true.
        """
        try:
            return isinstance(self.engine, HearingEngine) and bool(self.engine.check_heard(heard))
        except RealizerError:
            raise
        except FAILURES as failure:
            self._note(failure)
            return False

    def hear(self, heard: AudioHeard) -> Drift | None:
        """As `HearingEngine.hear`; None for other engines."""
        engine = self.engine
        return self._try(lambda: check_drift(engine.hear(heard)), None) if isinstance(engine, HearingEngine) else None

    def _try(self, call: Callable[[], T], otherwise: T) -> T:
        """The result of a call; if it fails, the engine drops its units when it next plays."""
        try:
            return call()
        except FAILURES as failure:
            self._note(failure)
            return otherwise

    def _note(self, failure: BaseException) -> None:
        self._failure = failure
        self._wake()

    def _drop_all(self, time: GlobalTime, failure: BaseException) -> Play:
        self._failure = None
        if repr(failure) != self._told:  # it may fail in the same way in every frame
            self._told = repr(failure)
            logger.error("engine %s failed at %.2f s", self.name, time, exc_info=failure)
        return self.fail(time, EngineFailed(engine=self.name, reason=str(failure) or type(failure).__name__))

    def _next_due(self) -> Time:
        due = self.engine.next_due
        return None if due is None else GlobalTime(number(due))

    def _guarded_eyes(self, eyes: Eyes | None) -> Eyes | None:
        if eyes is None:
            return None
        return lambda body: self._try(lambda: check_eyes(eyes(body)), EyePose({}, {}))

    def _guarded_dynamics(self, dynamics: Dynamics | None) -> Dynamics | None:
        if dynamics is None:
            return None
        return lambda body, duration: self._try(lambda: check_body(dynamics(body, duration), body), body)


def _called(call: Callable[[], T]) -> T:
    """The result of a call.

    Raises:
        Exception: what the call raises; `SystemExit` and the like as an exception that does not end the program.
    """
    try:
        return call()
    except Exception:
        raise
    except FAILURES as failure:
        raise RuntimeError(type(failure).__name__) from failure
