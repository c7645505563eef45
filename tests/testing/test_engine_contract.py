"""Each of these engines breaks its contract in one way, and the test for that fails."""

from collections.abc import Callable, Collection
from itertools import count
from types import MappingProxyType

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.player import Player
from reactive_realizer.engines.wait_engine import WaitEngine
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.testing.engine_contract import EngineContract

from .conftest import broken

ELEMENT = '<wait id="w" duration="1"/>'


class TickTimed(WaitEngine):
    """Reports the time of the tick instead of the time of the peg."""

    def play(self, tick: Tick) -> Play:
        play = super().play(tick)
        return play._replace(reached=tuple(each._replace(time=tick.time) for each in play.reached))


class Repeating(WaitEngine):
    """Reports every point twice."""

    def play(self, tick: Tick) -> Play:
        play = super().play(tick)
        return play._replace(reached=play.reached * 2)


class Hasty(WaitEngine):
    """Plays units that were only planned."""

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        unit = super().plan(block, behavior, prepared)
        self.player.add(unit)
        return unit


class Mistaken(WaitEngine):
    """Says before planning that a behavior has points that it will not have."""

    def check(self, behavior: Behavior) -> Collection[str]:
        return ("start", "stroke", "end")


class Intrusive(WaitEngine):
    """Stops what plays when it is asked about another behavior."""

    def check(self, behavior: Behavior) -> Collection[str] | None:
        for unit in self.player.units:
            self.player.remove(unit)
        return None


class OneOff(WaitEngine):
    """Makes one unit for all plans of a behavior."""

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        self.made = getattr(self, "made", None) or super().plan(block, behavior, prepared)
        return self.made


class Greedy(WaitEngine):
    """Supports every behavior."""

    def supports(self, behavior: Behavior) -> bool:
        return True


class Boastful(WaitEngine):
    """Declares a parameter that its units do not have."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})


class Resizable(WaitEngine):
    """Has units with a parameter."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(context)
        self.graph = context.graph

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        unit = super().plan(block, behavior, prepared)
        unit.parameters["size"] = Parameter(self.graph, "size", 1.0, Range(0.0, 1.0))
        return unit


class Meddling(Resizable):
    """Writes a cell while it plays."""

    def play(self, tick: Tick) -> Play:
        for unit in self.player.playing:
            unit.parameters["size"].set(tick.time % 1.0)
        return super().play(tick)


class Sticky(WaitEngine):
    """Keeps showing a face after the behavior."""

    weight = 0.0

    def face(self, tick: Tick) -> dict[str, float]:
        self.weight = 1.0 if self.player.playing else self.weight
        return {"jawOpen": self.weight}


class Moody(WaitEngine):
    """Shows another face in every call."""

    moods = count()

    def face(self, tick: Tick) -> dict[str, float]:
        return {"jawOpen": next(self.moods) / 1e6}


class Invisible(WaitEngine):
    """Shows weights that are not numbers."""

    def face(self, tick: Tick) -> dict[str, float]:
        return {"jawOpen": float("nan")}


class Silent(WaitEngine):
    """Drops units without reporting it."""

    def add(self, unit: PlanUnit) -> None:
        if not self.player.units:
            super().add(unit)


class Fragile(WaitEngine):
    """Fails when one of its units fails."""

    def __init__(self, context: EngineContext) -> None:
        super().__init__(context)
        self.player = Player()
        self.player._fail = self.fall  # type: ignore[method-assign]

    def fall(self, unit: PlanUnit, failure: Exception, now: GlobalTime) -> None:
        raise failure


class Forgetful(WaitEngine):
    """Does not report the units that it drops."""

    def fail(self, time: GlobalTime, fault: Fault) -> Play:
        super().fail(time, fault)
        return Play()


class Deaf(WaitEngine):
    """Does not remove units, and plays all in its list."""

    def remove(self, unit: PlanUnit) -> None:
        pass

    def play(self, tick: Tick) -> Play:
        for unit in self.player.units:
            unit.state = type(unit.state).LURKING if not unit.begun else unit.state
        return super().play(tick)


class Impatient(Deaf):
    """Does not wait for the start of blocks."""

    remove = DefaultEngine.remove


class Drowsy(WaitEngine):
    """Does not wake when something changes."""

    def listen(self, wake: Callable[[], None]) -> None:
        pass


class Inattentive(WaitEngine):
    """Wakes for new behaviors, but not when their times move."""

    def add(self, unit: PlanUnit) -> None:
        super().add(unit)
        self.player._agenda.note_move = lambda entry, change: None  # type: ignore[method-assign]


class Nervous(WaitEngine):
    """Plays in each tick."""

    @property
    def next_due(self) -> GlobalTime:
        return GlobalTime(0.0)


def engine_contract(engine: Callable[[EngineContext], WaitEngine]) -> type[EngineContract]:
    class Contract(EngineContract):
        elements = (ELEMENT,)

        def engine(self, context: EngineContext) -> WaitEngine:
            return engine(context)

    return Contract


@pytest.mark.parametrize(
    ("engine", "test"),
    [
        (TickTimed, "test_every_point_is_reached_once_in_order_at_the_time_of_its_peg"),
        (Repeating, "test_every_point_is_reached_once_in_order_at_the_time_of_its_peg"),
        (Hasty, "test_a_unit_outside_its_plan_is_not_played"),
        (Mistaken, "test_a_check_tells_the_points_or_the_fault_of_the_plan"),
        (Intrusive, "test_a_check_while_another_behavior_plays_changes_nothing"),
        (OneOff, "test_one_preparation_serves_two_plans"),
        (Greedy, "test_it_supports_its_own_behaviors_and_no_others"),
        (Boastful, "test_declared_parameters_exist_and_can_be_changed_while_it_plays"),
        (Meddling, "test_playing_writes_nothing"),
        (Sticky, "test_an_interrupted_behavior_reports_nothing_more_and_returns_to_rest"),
        (Moody, "test_playing_a_tick_again_changes_nothing"),
        (Moody, "test_the_same_behaviors_give_the_same_results"),
        (Moody, "test_a_behavior_removed_before_its_start_leaves_nothing"),
        (Invisible, "test_layers_weights_and_frames_are_valid"),
        (Silent, "test_of_two_simultaneous_behaviors_at_most_one_is_dropped_with_a_reason"),
        (Fragile, "test_a_behavior_that_fails_at_any_point_drops_only_itself"),
        (Forgetful, "test_an_engine_that_fails_drops_its_behaviors_and_plays_later_ones"),
        (Deaf, "test_a_behavior_removed_before_its_start_leaves_nothing"),
        (Drowsy, "test_every_point_is_reached_once_in_order_at_the_time_of_its_peg"),
        (Inattentive, "test_a_behavior_that_is_moved_ahead_begins_then"),
        (Nervous, "test_it_is_not_asked_to_play_while_its_behaviors_wait"),
        (Impatient, "test_a_behavior_waits_for_the_start_of_its_block"),
    ],
)
def test_an_engine_that_breaks_its_contract_is_found(engine: type[WaitEngine], test: str) -> None:
    broken(engine_contract(engine), test, ELEMENT)
