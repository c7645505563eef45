"""The engine of ``parametervaluechange`` (thesis 6.6.6, 8.15)."""

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.engine.context import EngineContext, Trajectory
from reactive_realizer.engine.effects import BindParameter, Request
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engines.parameter_value_change.parameter_value_change_unit import ParameterValueChangeUnit
from reactive_realizer.errors import error
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit


class ParameterValueChangeEngine(DefaultEngine):
    """Asks for a parameter when a change is to start, and for its values while the change goes on.

    What it asks for is done before the others play.
    """

    leads = True
    behaviors = frozenset({ParameterValueChange})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/parameter_value_change")
        self._trajectories = context.trajectories
        self._asked: list[Request] = []

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit that changes its target.

        Raises:
            RealizerError: there is no trajectory of that type.
        """
        if not isinstance(behavior, ParameterValueChange):
            raise TypeError(behavior)
        return ParameterValueChangeUnit(block, behavior, self._trajectory(behavior.trajectory.type), self._ask)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """Parameters to be bound, and values."""
        for unit in sorted(self._due(tick), key=lambda each: (each.points[0].peg.value or 0.0, each.behavior.id)):
            behavior = unit.change
            self._ask(
                BindParameter(
                    unit, behavior.target_block or unit.block.block, behavior.target_behavior, behavior.parameter
                )
            )
        self.player.show(ParameterValueChangeUnit, lambda unit: unit.follow(tick.time), tick.time)
        asked, self._asked = tuple(self._asked), []
        return asked

    def _ask(self, request: Request) -> None:
        self._asked.append(request)

    def _due(self, tick: Tick) -> list[ParameterValueChangeUnit]:
        """What would start now if it had its parameter."""
        units = (unit for unit in self.player.units if isinstance(unit, ParameterValueChangeUnit))
        return [unit for unit in units if unit.wants_parameter(tick.time)]

    def _trajectory(self, name: str) -> Trajectory:
        found = self._trajectories.get(name.strip().lower().replace("_", "-"))
        if found is None:
            raise error("no-trajectory", trajectory=name, known=", ".join(sorted(self._trajectories)))
        return found
