"""A change of a parameter in a plan."""

from collections.abc import Callable

from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.bml.names import BMLT
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import Trajectory
from reactive_realizer.engine.effects import EndUnit, ParameterUser, Request, SetParameter
from reactive_realizer.errors import error
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing

_DURATION = 0.5
"""s of a change whose end nothing says."""


class ParameterValueChangeUnit(ParameterUser):
    """Gives a parameter values along a trajectory between the times of its points, which may move meanwhile.

    It starts as soon as it has its parameter. It ends with its time or, if that comes first, with its target; the value
    stays.

    Attributes:
        change: what was asked for.
    """

    def __init__(
        self, block: BlockKey, change: ParameterValueChange, trajectory: Trajectory, ask: Callable[[Request], None]
    ) -> None:
        super().__init__(block, change, _timing(change, trajectory))
        self.change = change
        self._trajectory = trajectory
        self._ask = ask
        self._clock = PhaseClock({sync: float(sync != "start") for sync in self.timing.points})
        self._parameter: Parameter | None = None
        self._initial = 0.0

    def bind(self, parameter: Parameter) -> None:
        """Change this one, if its range allows it."""
        for value in (self.change.trajectory.target_value, self.change.trajectory.initial_value):
            if value is not None and value not in parameter.range:
                raise error(
                    "parameter-range",
                    parameter=self.change.parameter,
                    behavior=self.change.target_behavior,
                    value=value,
                    **parameter.range._asdict(),
                )
        self._parameter = parameter

    def wants_parameter(self, now: GlobalTime) -> bool:
        """Whether nothing but its parameter keeps it from starting."""
        return self._parameter is None and super().due(now)

    def due(self, now: GlobalTime) -> bool:
        """Without its parameter it does not start."""
        return self._parameter is not None and super().due(now)

    def on_start(self, time: GlobalTime) -> None:
        """The trajectory begins where it says or, if it does not, at the value that is there."""
        if self._parameter is not None:
            initial = self.change.trajectory.initial_value
            self._initial = self._parameter.value if initial is None else initial

    def on_sync(self, sync: str, time: GlobalTime) -> None:
        """The target value is reached exactly."""
        if sync != "start":
            self._give(self.change.trajectory.target_value)

    def on_finish(self, time: GlobalTime) -> None:
        """Let go of the parameter."""
        self._parameter = None

    def follow(self, now: GlobalTime) -> None:
        """Give the parameter its value of now, or end with the target."""
        if self._parameter is None:
            return
        if not self._parameter.unit.live:
            self._ask(EndUnit(self, self._end_of(self._parameter, now)))
            return
        way = self._trajectory(self._clock.advance(self, now))
        self._give((1.0 - way) * self._initial + way * self.change.trajectory.target_value)

    def _give(self, value: float) -> None:
        if self._parameter is not None:
            low, high = self._parameter.range
            self._ask(SetParameter(self, self._parameter, min(high, max(low, value))))

    def _end_of(self, parameter: Parameter, now: GlobalTime) -> GlobalTime:
        """When the target ended; not before this one started."""
        ended = parameter.unit.points[-1].fired
        started = self.points[0].fired
        return max(now if ended is None else ended, now if started is None else started)


def _timing(change: ParameterValueChange, trajectory: Trajectory) -> Timing:
    """BMLT says stroke where BMLA says end; what is there at once takes no time."""
    at_once = trajectory(0.0) >= 1.0
    way = Phase(0.0 if at_once else _DURATION, PhaseKind.FREE)
    if change.namespace == BMLT or "stroke" in change.syncs:
        return Timing(("start", "stroke", "end"), (way, Phase(0.0, PhaseKind.FREE)), at_once)
    return Timing(("start", "end"), (way,), at_once)
