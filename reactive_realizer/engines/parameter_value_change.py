"""The engine of ``parametervaluechange`` (thesis 6.6.6, 8.15): changes a parameter of a behavior along a trajectory."""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.names import BMLT
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.engine.context import EngineContext, TrajectoryFunction
from reactive_realizer.engine.effects import BindParameter, EndUnit, ParameterUser, Request, SetParameter
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.errors import CreationFault, PlayingFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

_DURATION = 0.5
"""Duration of a change without a constraint on its end, s."""

# --- trajectories (thesis, equations 8.2 and 8.3): the share of the change after a share of the time


def instant(share: float) -> float:
    """Changes at once."""
    return 1.0


def linear(share: float) -> float:
    """Changes at constant speed."""
    return share


def ease_in_ease_out(share: float) -> float:
    """Changes slowly at both ends: the cubic Hermite polynomial with slope 0 there."""
    return share * share * (3.0 - 2.0 * share)


class NoTrajectory(CreationFault):
    """No trajectory has the name."""

    code = "no-trajectory"
    template = "there is no trajectory '{trajectory}'; available: {known}"
    trajectory: str
    known: tuple[str, ...]


class ParameterRange(PlayingFault):
    """A value outside of the range of its parameter."""

    code = "parameter-range"
    template = "the {parameter} of '{behavior}' must be between {low:g} and {high:g}, not {value:g}"
    parameter: str
    behavior: str
    low: float
    high: float
    value: float


class ParameterValueChangeUnit(ParameterUser):
    """Sets a parameter along a trajectory between its start and its end, whose times may move meanwhile.

    It starts once its parameter is bound. It ends at its end or, if that is earlier, with its target; the parameter
    keeps its value.

    Attributes:
        change: the behavior.
    """

    def __init__(
        self,
        block: BlockKey,
        change: ParameterValueChange,
        trajectory: TrajectoryFunction,
        request: Callable[[Request], None],
    ) -> None:
        super().__init__(block, change, _timing(change, trajectory))
        self.change = change
        self._trajectory = trajectory
        self._request = request
        self._clock = PhaseClock({sync: float(sync != "start") for sync in self.timing.points})
        self._target: PlanUnit | None = None
        self._parameter: Parameter | None = None
        self._initial = 0.0

    def bind(self, target: PlanUnit, parameter: Parameter) -> None:
        """Binds the parameter to change.

        Raises:
            RealizerError: ``parameter-range``.
        """
        for value in (self.change.trajectory.target_value, self.change.trajectory.initial_value):
            if value is not None and value not in parameter.range:
                fault = ParameterRange(
                    parameter=self.change.parameter,
                    behavior=self.change.target_behavior,
                    value=value,
                    low=parameter.range.low,
                    high=parameter.range.high,
                )
                raise RealizerError(fault)
        self._target, self._parameter = target, parameter

    def wants_parameter(self, now: GlobalTime) -> bool:
        """Whether it would start if its parameter were bound."""
        return self._parameter is None and super().due(now)

    def due(self, now: GlobalTime) -> bool:
        """Whether it starts: its time has come and its parameter is bound."""
        return self._parameter is not None and super().due(now)

    def next_due(self) -> Time:
        """While it plays, each tick."""
        return self.time("start") if self.begun and self.live else super().next_due()

    def on_start(self, time: GlobalTime) -> None:
        """Starts the trajectory at its initial value or, without one, at the value of the parameter."""
        if self._parameter is not None:
            initial = self.change.trajectory.initial_value
            self._initial = self._parameter.value if initial is None else initial

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """Sets the target value exactly."""
        if sync != "start":
            self._set(self.change.trajectory.target_value)

    def on_finish(self, time: GlobalTime) -> None:
        """Unbinds the parameter."""
        self._target = self._parameter = None

    def follow(self, now: GlobalTime) -> None:
        """Sets the parameter to its value of now, or ends with the target."""
        if self._target is None:
            return
        if not self._target.live:
            self._request(EndUnit(self, self._end_of(self._target, now)))
            return
        share = self._trajectory(self._clock.advance(self, now))
        self._set((1.0 - share) * self._initial + share * self.change.trajectory.target_value)

    def _set(self, value: float) -> None:
        if self._parameter is not None:
            low, high = self._parameter.range
            self._request(SetParameter(self, self._parameter, min(high, max(low, value))))

    def _end_of(self, target: PlanUnit, now: GlobalTime) -> GlobalTime:
        """The time at which the target ended, but not before the start of this unit."""
        end, start = target.points[-1], self.points[0]
        ended = end.peg.value if end.fired else now
        return max(time for time in (ended, start.peg.value) if time is not None)


class ParameterValueChangeEngine(DefaultEngine):
    """Requests the parameter when a change is due, and then its values.

    The requests are carried out before the other engines play.
    """

    leads = True
    behaviors = frozenset({ParameterValueChange})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/parameter_value_change")
        self._trajectories = context.trajectories
        self._requested: list[Request] = []

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that changes its target.

        Raises:
            RealizerError: there is no trajectory of that type.
        """
        if not isinstance(behavior, ParameterValueChange):
            raise TypeError(behavior)
        trajectory = self._trajectory(behavior.trajectory.type)
        return ParameterValueChangeUnit(block, behavior, trajectory, self._requested.append)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """Parameters to bind, and values to set."""
        for unit in sorted(self._due(tick), key=lambda each: (each.points[0].peg.value or 0.0, each.behavior.id)):
            change = unit.change
            block = change.target_block or unit.block.block
            self._requested.append(BindParameter(unit, block, change.target_behavior, change.parameter))
        self.player.show(ParameterValueChangeUnit, lambda unit: unit.follow(tick.time), tick.time)
        requested = tuple(self._requested)
        self._requested.clear()  # units hold the list itself
        return requested

    def _due(self, tick: Tick) -> list[ParameterValueChangeUnit]:
        units = (unit for unit in self.player.units if isinstance(unit, ParameterValueChangeUnit))
        return [unit for unit in units if unit.wants_parameter(tick.time)]

    def _trajectory(self, name: str) -> TrajectoryFunction:
        found = self._trajectories.get(name.strip().lower().replace("_", "-"))
        if found is None:
            raise RealizerError(NoTrajectory(trajectory=name, known=tuple(sorted(self._trajectories))))
        return found


def _timing(change: ParameterValueChange, trajectory: TrajectoryFunction) -> Timing:
    """BMLT's stroke is the same point as the end; a change that is instantaneous has no duration."""
    at_once = trajectory(0.0) >= 1.0
    phase = Phase(0.0 if at_once else _DURATION, PhaseKind.FREE)
    if change.namespace == BMLT or "stroke" in change.syncs:
        return Timing(("start", "stroke", "end"), (phase, Phase(0.0, PhaseKind.FREE)), at_once)
    return Timing(("start", "end"), (phase,), at_once)
