"""The engine of ``parametervaluechange`` (thesis 6.6.6, 8.15): changes a parameter of a behavior along a trajectory."""

from collections.abc import Callable, Collection
from typing import Any

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.names import BMLT
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext, TrajectoryFunction
from reactive_realizer.engine.effects import BindParameter, EndUnit, FollowCell, ParameterUser, Request, SetParameter
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.errors import CreationFault, PlayingFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.phase_clock import Progress, progress_cell
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing
from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.errors import Failure
from reactive_realizer.reactive.graph import Change, Subscription

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
    unknown = "trajectory"
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
    """Has a parameter follow a trajectory between its start and its end, whose times may move meanwhile.

    While it plays, the parameter is computed from the trajectory, the pegs of the unit and the time. It starts once its
    parameter is bound. It ends at its end or, if that is earlier, with its target; the parameter keeps its value.

    Attributes:
        change: the behavior.
    """

    def __init__(
        self,
        block: BlockKey,
        change: ParameterValueChange,
        trajectory: TrajectoryFunction,
        time: Source[GlobalTime],
        request: Callable[[Request], None],
    ) -> None:
        super().__init__(block, change, _timing(change, trajectory))
        self.change = change
        self._trajectory = trajectory
        self._time = time
        self._request = request
        self._target: PlanUnit | None = None
        self._parameter: Parameter | None = None
        self._bound: Subscription | None = None
        self._cells: tuple[Derived[Any], ...] = ()
        self._value = 0.0

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
        self._bound = parameter.cell.observe(lambda change: None, ended=lambda: self.wake())

    def wants_parameter(self, now: GlobalTime) -> bool:
        """Whether it would start if its parameter were bound."""
        return self._parameter is None and super().due(now)

    def due(self, now: GlobalTime) -> bool:
        """Whether it starts: its time has come and its parameter is bound."""
        return self._parameter is not None and super().due(now)

    def on_start(self, time: GlobalTime) -> None:
        """Starts the trajectory at its initial value or, without one, at the value of the parameter."""
        if self._parameter is None:
            return
        initial = self.change.trajectory.initial_value
        self._value = self._parameter.value if initial is None else initial
        progress = progress_cell(self, [float(point.id != "start") for point in self.points], self._time)
        formula = _value(self._trajectory, self._value, self.change.trajectory.target_value, self._parameter.range)
        value = Derived(self._time.graph, str(self.key("value")), (progress,), formula)
        value.observe(self._note)
        self._cells = (value, progress)
        self._request(FollowCell(self, self._parameter, value))

    def on_finish(self, time: GlobalTime) -> None:
        """Has the parameter keep the target value, or its present one if the change was cut short; unbinds it."""
        parameter, bound = self._parameter, self._bound
        if parameter is None or bound is None:
            return
        complete = self.state is UnitState.DONE and not self.was_cut("end")
        value = self.change.trajectory.target_value if complete else self._present(parameter)
        self._request(SetParameter(self, parameter, value))
        bound.dispose()
        for cell in self._cells:
            cell.dispose()
        self._target = self._parameter = self._bound = None
        self._cells = ()

    def check(self, now: GlobalTime) -> None:
        """Requests its end if its target has ended.

        Raises:
            Exception: of the trajectory, if that has failed.
        """
        for cell in self._cells:
            if isinstance(failure := cell.result, Failure):
                raise failure.error
        if self._target is not None and not self._target.live:
            self._request(EndUnit(self, self._end_of(self._target, now)))

    def _note(self, change: Change) -> None:
        """Note a failure of the trajectory, and the last value before it."""
        if isinstance(change.new, Failure) and not isinstance(change.old, Failure):
            self._value = change.old
            self.wake()

    def _present(self, parameter: Parameter) -> float:
        value = parameter.cell.result
        return self._value if isinstance(value, Failure) else value

    def _end_of(self, target: PlanUnit, now: GlobalTime) -> GlobalTime:
        """The time at which the target ended, but not before the start of this unit."""
        end, start = target.points[-1], self.points[0]
        ended = end.peg.value if end.fired else now
        return max(time for time in (ended, start.peg.value) if time is not None)


class ParameterValueChangeEngine(DefaultEngine):
    """Requests the parameter when a change is due, and then that it follow the trajectory.

    The requests are carried out before the other engines play.
    """

    leads = True
    behaviors = frozenset({ParameterValueChange})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/parameter_value_change")
        self._trajectories = context.trajectories
        self._time = context.time
        self._requested: list[Request] = []

    def check(self, behavior: Behavior) -> Collection[str]:
        """The points of a change.

        Raises:
            RealizerError: there is no trajectory of that type.
        """
        if not isinstance(behavior, ParameterValueChange):
            raise TypeError(behavior)
        return _timing(behavior, self._trajectory(behavior.trajectory.type)).points

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that changes its target.

        Raises:
            RealizerError: there is no trajectory of that type.
        """
        if not isinstance(behavior, ParameterValueChange):
            raise TypeError(behavior)
        trajectory = self._trajectory(behavior.trajectory.type)
        return ParameterValueChangeUnit(block, behavior, trajectory, self._time, self._requested.append)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """Parameters to bind, and cells and values that they are to have."""
        for unit in sorted(self._due(tick), key=lambda each: (each.points[0].peg.value or 0.0, each.behavior.id)):
            change = unit.change
            block = change.target_block or unit.block.block
            self._requested.append(BindParameter(unit, block, change.target_behavior, change.parameter))
        self.player.show(ParameterValueChangeUnit, lambda unit: unit.check(tick.time), tick.time)
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


def _value(trajectory: TrajectoryFunction, initial: float, target: float, bounds: Range) -> Callable[[Progress], float]:
    """The value of a parameter from the progress of its change."""
    low, high = bounds

    def formula(progress: Progress) -> float:
        share = trajectory(progress.phase)
        return min(high, max(low, (1.0 - share) * initial + share * target))

    return formula


def _timing(change: ParameterValueChange, trajectory: TrajectoryFunction) -> Timing:
    """BMLT's stroke is the same point as the end; a change that is instantaneous has no duration."""
    at_once = trajectory(0.0) >= 1.0
    phase = Phase(0.0 if at_once else _DURATION, PhaseKind.FREE)
    if change.namespace == BMLT or "stroke" in change.syncs:
        return Timing(("start", "stroke", "end"), (phase, Phase(0.0, PhaseKind.FREE)), at_once)
    return Timing(("start", "end"), (phase,), at_once)
