"""The contract of engines finds what breaks it: each of these is wrong in one way, and the test that says so fails."""

from collections.abc import Callable
from dataclasses import replace
from itertools import count
from types import MappingProxyType

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.player import Player
from reactive_realizer.engines.wait.wait_engine import WaitEngine
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.reactive.cell import Source
from reactive_realizer.testing.engine_contract import EngineContract

from .conftest import broken

ELEMENT = '<wait id="w" duration="1"/>'


class TickTimed(WaitEngine):
    """Says when it looked, not when it was."""

    def play(self, tick):
        play = super().play(tick)
        return replace(play, reached=tuple(replace(each, time=tick.time) for each in play.reached))


class Repeating(WaitEngine):
    """Says everything twice."""

    def play(self, tick):
        play = super().play(tick)
        return replace(play, reached=play.reached * 2)


class Hasty(WaitEngine):
    """Plays what it was asked to plan."""

    def plan(self, block, behavior, prepared):
        unit = super().plan(block, behavior, prepared)
        self.player.add(unit)
        return unit


class OneOff(WaitEngine):
    """Has one unit a behavior, for all plans of it."""

    def plan(self, block, behavior, prepared):
        self.made = getattr(self, "made", None) or super().plan(block, behavior, prepared)
        return self.made


class Greedy(WaitEngine):
    """Takes every behavior for its own."""

    def supports(self, behavior):
        return True


class Boastful(WaitEngine):
    """Says that something may be changed that is not there."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})


class Resizable(WaitEngine):
    """Lets something be changed."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})

    def __init__(self, context):
        super().__init__(context)
        self.graph = context.graph

    def plan(self, block, behavior, prepared):
        unit = super().plan(block, behavior, prepared)
        unit.parameters["size"] = Parameter(unit, Source(self.graph, "size", 1.0), Range(0.0, 1.0))
        return unit


class Meddling(Resizable):
    """Writes while it plays."""

    def play(self, tick):
        for unit in self.player.playing:
            unit.parameters["size"].set(tick.time % 1.0)
        return super().play(tick)


class Sticky(WaitEngine):
    """Keeps the face that it made."""

    weight = 0.0

    def face(self, tick):
        self.weight = 1.0 if self.player.playing else self.weight
        return {"jawOpen": self.weight}


class Moody(WaitEngine):
    """Is never the same."""

    moods = count()

    def face(self, tick):
        return {"jawOpen": next(self.moods) / 1e6}


class Invisible(WaitEngine):
    """Shows what is no number."""

    def face(self, tick):
        return {"jawOpen": float("nan")}


class Silent(WaitEngine):
    """Drops what is too much for it, and does not say so."""

    def add(self, unit):
        if not self.player.units:
            super().add(unit)


class Fragile(WaitEngine):
    """Fails with its units."""

    def __init__(self, context):
        super().__init__(context)
        self.player = Player()
        self.player._fail = self.fall

    def fall(self, unit, failure, now):
        raise failure


class Forgetful(WaitEngine):
    """Does not say whom it lost."""

    def fail(self, time, fault):
        super().fail(time, fault)
        return Play()


class Deaf(WaitEngine):
    """Does not let go, and plays whatever is in its list."""

    def remove(self, unit):
        pass

    def play(self, tick):
        for unit in self.player.units:
            unit.state = type(unit.state).LURKING if not unit.begun else unit.state
        return super().play(tick)


class Impatient(Deaf):
    """Does not wait for blocks."""

    remove = DefaultEngine.remove


def engine_contract(engine: Callable) -> type[EngineContract]:
    class Contract(EngineContract):
        elements = (ELEMENT,)

        def engine(self, context):
            return engine(context)

    return Contract


@pytest.mark.parametrize(
    ("engine", "test", "arguments"),
    [
        (TickTimed, "test_every_point_is_reached_once_in_order_with_the_time_of_its_peg", (1,)),
        (Repeating, "test_every_point_is_reached_once_in_order_with_the_time_of_its_peg", (37,)),
        (Hasty, "test_what_is_not_in_its_plan_is_not_played", ()),
        (OneOff, "test_one_preparation_is_good_for_two_plans", ()),
        (Greedy, "test_it_knows_its_own_behaviors_and_no_others", ()),
        (Boastful, "test_what_may_be_changed_while_it_plays_is_declared_and_may_be_changed", ()),
        (Meddling, "test_playing_writes_nothing", ()),
        (Sticky, "test_what_is_interrupted_is_not_heard_of_again_and_goes_back_to_rest", (0.3,)),
        (Moody, "test_playing_a_tick_again_changes_nothing", ()),
        (Moody, "test_the_same_again_is_the_same", ()),
        (Moody, "test_what_is_removed_before_it_starts_leaves_nothing", ()),
        (Invisible, "test_what_it_shows_can_be_shown", ()),
        (Silent, "test_of_two_at_once_one_is_played_and_the_other_too_or_is_dropped_with_a_reason", ()),
        (Fragile, "test_a_behavior_that_fails_drops_itself_alone_whatever_the_point", ()),
        (Forgetful, "test_when_it_fails_as_a_whole_its_behaviors_are_dropped_and_it_plays_on", ()),
        (Deaf, "test_what_is_removed_before_it_starts_leaves_nothing", ()),
        (Impatient, "test_a_behavior_whose_block_has_not_started_waits_for_it", ()),
    ],
)
def test_an_engine_that_breaks_its_contract_is_found(engine, test, arguments) -> None:
    broken(engine_contract(engine), test, ELEMENT, *arguments)
