"""The contract of engines (thesis 8.6): a pytest class to inherit from; needs pytest."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import replace
from math import isfinite
from typing import ClassVar

import numpy as np
import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.vocabulary import InterruptSpeech
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Output
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engine.faults import EngineFailed
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.testing.engine_harness import (
    BLOCK,
    EngineHarness,
    behavior_of,
    minimal_context,
    offsets_of,
    prepared,
)

_START = 0.123
"""A start time between two ticks, s."""

_REST = 3.0
"""Time after which nothing of a behavior is visible, s."""


class EngineContract(ABC):
    """Tests of any engine: it reaches each point once, in order, at the time of its peg, and leaves nothing behind.

    Attributes:
        elements: elements of behaviors that the engine plays, one or more of each kind.
        refused: elements of the same kinds that it cannot play, such as those with an unknown lexeme.
        lacking: parameters that the engine declares and these elements lack, such as the rate of silent speech.
    """

    elements: ClassVar[tuple[str, ...]]
    refused: ClassVar[tuple[str, ...]] = ()
    lacking: ClassVar[frozenset[str]] = frozenset()

    @abstractmethod
    def engine(self, context: EngineContext) -> Engine:
        """A new engine under test; inheriting classes define this."""

    def context(self) -> EngineContext:
        """The context of the engine."""
        return minimal_context()

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Runs each test with an ``element`` argument for each element."""
        if "element" in metafunc.fixturenames:
            metafunc.parametrize("element", self.elements)

    # --- planning

    def test_declarations_are_complete(self) -> None:
        engine = self._harness().engine
        assert engine.name
        assert engine.behaviors
        assert isinstance(engine.leads, bool)
        assert isinstance(engine.reads_parameters, bool)
        assert engine.parameters.keys() <= engine.behaviors
        for namespace, name in engine.extensions:
            assert namespace
            assert name

    def test_it_supports_its_own_behaviors_and_no_others(self, element: str) -> None:
        engine, behavior = self._harness().engine, behavior_of(element)
        assert engine.supports(behavior)
        assert isinstance(behavior, tuple(engine.behaviors))
        assert not engine.supports(_Unknown(id="u", namespace="urn:u", name="u", location=Location(1, 1), order=0))

    def test_a_planned_unit_has_its_points_in_order_with_a_preferred_timing(self, element: str) -> None:
        harness, behavior = self._harness(), behavior_of(element)
        unit = harness.plan(behavior)
        points = unit.timing.points
        assert (unit.block, unit.behavior, unit.points) == (BLOCK, behavior, [])
        assert (points[0], points[-1]) == ("start", "end")
        assert len(set(points)) == len(points)
        assert behavior.syncs.keys() <= set(points)
        assert all(isfinite(phase.duration) and phase.duration >= 0 for phase in unit.timing.phases)

    def test_a_behavior_that_it_cannot_play_is_refused_with_a_reason_and_others_play(self) -> None:
        harness = self._harness()
        for element in self.refused:
            with pytest.raises(RealizerError) as refusal:
                harness.plan(behavior_of(element))
            assert refusal.value.fault.sentence
        self._plays_whole(harness, harness.schedule(behavior_of(self.elements[0]), _START))

    def test_a_check_tells_the_points_or_the_fault_of_the_plan(self, element: str) -> None:
        harness, behavior = self._harness(), behavior_of(element)
        known = harness.engine.check(behavior)
        assert known is None or tuple(known) == harness.plan(behavior).timing.points
        for refused in self.refused:
            faults = [_refusal(make, behavior_of(refused)) for make in (harness.engine.check, harness.plan)]
            assert faults[0] in (None, faults[1])

    def test_a_check_while_another_behavior_plays_changes_nothing(self, element: str) -> None:
        harnesses = self._harness(), self._harness()
        for harness, checked in zip(harnesses, (True, False), strict=True):
            unit = harness.schedule(behavior_of(element), _START)
            harness.advance(_START + _duration(unit) / 2)
            if checked:
                for each in (element, *self.elements, *self.refused):
                    _refusal(harness.engine.check, behavior_of(each))
            harness.schedule(_renamed(element), harness.now)
            harness.advance(_duration(unit) + 1.0)
        assert [each[1:] for each in harnesses[0].reached] == [each[1:] for each in harnesses[1].reached]
        assert harnesses[0].audio == harnesses[1].audio
        _assert_same_frames(*harnesses, 0)

    def test_one_preparation_serves_two_plans(self, element: str) -> None:
        harness, behavior = self._harness(), behavior_of(element)
        work = prepared(harness.engine, behavior)
        units = [harness.engine.plan(BLOCK, behavior, work) for _ in range(2)]
        assert units[0] is not units[1]
        assert units[0].timing == units[1].timing
        harness.place(units[1], _START)
        harness.engine.add(units[1])
        self._plays_whole(harness, units[1])

    def test_declared_parameters_exist_and_can_be_changed_while_it_plays(self, element: str) -> None:
        harness, behavior = self._harness(), behavior_of(element)
        unit = harness.schedule(behavior, _START)
        declared = harness.engine.parameters.get(type(behavior), {})
        declared = {name: range_ for name, range_ in declared.items() if name not in self.lacking}
        assert declared.keys() <= unit.parameters.keys(), "a unit may have further parameters, from its file"
        assert self.lacking.isdisjoint(unit.parameters)
        for parameter in unit.parameters.values():
            assert parameter.value in parameter.range
        for share in (0.0, 1.0):
            harness.advance(_START + 0.3 * _duration(unit))
            for name, (low, high) in declared.items():
                assert unit.parameters[name].range == (low, high)
                unit.parameters[name].set(low + share * (high - low))
        self._plays_whole(harness, unit, frames=True)

    # --- playing

    def test_every_point_is_reached_once_in_order_at_the_time_of_its_peg(self, element: str) -> None:
        for ticks in (1, 37, 100_000):  # however late a tick is
            harness = self._harness()
            unit = harness.schedule(behavior_of(element), _START)
            while (before := harness.now) < harness.end(unit):
                harness.tick(ticks, frames=ticks == 37)
                new = [time for _, _, time, at in harness.reached if at == harness.now]
                assert all(before < time <= harness.now + RESOLUTION for time in new), f"{ticks} ticks at once"
            self._plays_whole(harness, unit)

    def test_times_do_not_depend_on_frames(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START)
        harness.advance(_START + _duration(unit) + 0.1, frames=False)
        assert harness.points(unit) == harness.planned(unit)

    def test_a_unit_outside_its_plan_is_not_played(self, element: str) -> None:
        harness = self._harness()
        unit = harness.plan(behavior_of(element))
        harness.place(unit, _START)
        harness.advance(1.0)
        assert harness.reached == []
        assert unit.live

    def test_a_behavior_waits_for_the_start_of_its_block(self, element: str) -> None:
        harness = self._harness()
        unit, pending = harness.schedule(behavior_of(element), _START), harness.plan(behavior_of(element)).state
        unit.state = pending
        harness.advance(1.0)
        assert harness.reached == []
        unit.release()
        self._plays_whole(harness, unit)

    def test_a_behavior_with_an_unknown_time_waits(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), None)
        harness.advance(1.0)
        assert (harness.reached, harness.dropped, harness.requests) == ([], [], [])
        assert unit.live

    def test_it_is_not_asked_to_play_while_its_behaviors_wait(self, element: str) -> None:
        harness = self._harness()
        harness.schedule(behavior_of(element), None)
        harness.schedule(_renamed(element), 100.0)
        harness.tick()
        plays = harness.plays
        harness.advance(10.0)
        assert harness.plays == plays

    def test_moved_points_are_reached_at_their_new_times(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START)
        harness.advance(0.1)
        harness.shift(unit, 0.5)
        while harness.now < _START + 0.5:
            harness.tick(frames=False)
        if unit.live:
            harness.shift(unit, 1.0, "end")
        self._plays_whole(harness, unit)

    def test_a_behavior_that_is_moved_ahead_begins_then(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START + 1.0)
        harness.advance(0.3)
        harness.shift(unit, -0.5)
        harness.advance(_START + 0.25)
        assert unit.begun
        self._plays_whole(harness, unit)

    def test_playing_a_tick_again_changes_nothing(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START)
        for _ in range(5):
            harness.advance(0.2 + _duration(unit) / 4)
            (before, shown), (again, shown_again) = harness.repeat_tick(), harness.repeat_tick()
            assert (again.reached, again.dropped, again.audio) == ((), (), ())
            assert _shown(shown_again) == _shown(shown)
            assert again.requests == before.requests
        self._plays_whole(harness, unit)

    def test_playing_writes_nothing(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START)
        self._plays_whole(harness, unit, frames=True)
        assert harness.commits == []

    def test_layers_weights_and_frames_are_valid(self, element: str) -> None:
        harness = self._harness()
        unit = harness.schedule(behavior_of(element), _START)
        while harness.now < harness.end(unit):
            harness.tick(2)
            assert all(_is_rotation(each) for layer in harness.output.layers for each in layer.rotations.values())
            assert all(0.0 <= layer.weight <= 1.0 for layer in harness.output.layers)
            assert all(isfinite(weight) for weight in harness.output.face.values())
            assert np.abs(np.linalg.norm(harness.frames[-1].rotations, axis=1) - 1.0).max() < 1e-6
            if harness.engine.leads:  # the output of leading engines is not used
                assert _shown(harness.output) == ((), {}, False)

    def test_the_same_behaviors_give_the_same_results(self, element: str) -> None:
        harnesses = self._harness(), self._harness()
        for harness in harnesses:
            unit = harness.schedule(behavior_of(element), _START)
            harness.advance(_START + _duration(unit) / 2)
            harness.schedule(_renamed(element), harness.now)
            harness.advance(_duration(unit) + 1.0)
        one, two = ([(u.behavior.id, *rest) for u, *rest in harness.reached] for harness in harnesses)
        assert one == two
        assert [str(each.fault) for each in harnesses[0].dropped] == [str(each.fault) for each in harnesses[1].dropped]
        assert harnesses[0].audio == harnesses[1].audio
        _assert_same_frames(*harnesses, 0)

    # --- ending and failing

    def test_a_behavior_removed_before_its_start_leaves_nothing(self, element: str) -> None:
        harness, other = self._harness(), self._harness()
        unit = harness.schedule(behavior_of(element), 1.0)
        for each in (harness, other):
            each.advance(0.5)
        harness.remove(unit)
        for each in (harness, other):
            each.advance(1.0 + _duration(unit), every=5)
        assert (harness.reached, harness.dropped, harness.requests) == ([], [], [])
        assert harness.audible_clips() == set()
        _assert_same_frames(harness, other, 0)

    def test_an_interrupted_behavior_reports_nothing_more_and_returns_to_rest(self, element: str) -> None:
        for share in (0.0, 0.3, 0.9, 1.5):
            harness, other = self._harness(), self._harness()
            unit = harness.schedule(behavior_of(element), _START)
            for each in (harness, other):
                each.advance(0.13 + share * _duration(unit))
            if unit.live:
                assert unit.gentle_end(harness.now, InterruptSpeech.WORD) >= harness.now
                assert all(isinstance(text, str) for pair in unit.details("end", harness.now).items() for text in pair)
            harness.interrupt(unit)
            reached = list(harness.reached)
            for each in (harness, other):
                each.advance(_duration(unit) + _REST, every=5)
            assert (harness.reached, harness.dropped) == (reached, []), f"interrupted after {share:.0%}"
            assert harness.audible_clips() == set(), f"interrupted after {share:.0%}"
            _assert_same_frames(harness, other, -1)

    def test_two_consecutive_behaviors_play_completely(self, element: str) -> None:
        harness = self._harness()
        first = harness.schedule(behavior_of(element), _START)
        second = harness.schedule(_renamed(element), _START + _duration(first) + 0.5)
        self._plays_whole(harness, first)
        self._plays_whole(harness, second)

    def test_of_two_simultaneous_behaviors_at_most_one_is_dropped_with_a_reason(self, element: str) -> None:
        harness = self._harness()
        units = [harness.schedule(behavior, _START) for behavior in (behavior_of(element), _renamed(element))]
        harness.advance(_START + _duration(units[0]) + 0.1, frames=False)
        gone = [each.unit for each in harness.dropped]
        assert len(gone) <= 1
        assert all(each.fault.sentence for each in harness.dropped)
        for unit in units:
            assert harness.points(unit) == ([] if unit in gone else harness.planned(unit))

    def test_a_behavior_that_fails_at_any_point_drops_only_itself(self, element: str) -> None:
        for sync in self._harness().plan(behavior_of(element)).timing.points:
            harness = self._harness()
            bad = harness.schedule(behavior_of(element), _START)
            good = harness.schedule(_renamed(element), _START + _duration(bad) + 0.5)
            _fail_at(bad, sync)
            self._plays_alone(harness, good)
            ((unit, reason),) = [(each.unit, each.fault.sentence) for each in harness.dropped]
            assert unit is bad
            assert not bad.live
            assert f"no {sync}" in reason
            assert harness.audible_clips() == set()

    def test_an_engine_that_fails_drops_its_behaviors_and_plays_later_ones(self, element: str) -> None:
        harness, fault = self._harness(), EngineFailed(engine="it", reason="a test")
        playing, waiting = harness.schedule(behavior_of(element), _START), harness.schedule(_renamed(element), 100.0)
        harness.advance(_START + 0.4 * _duration(playing))
        units = {unit for unit in (playing, waiting) if unit.live}
        dropped = harness.engine.fail(harness.now, fault).dropped
        assert {each.unit for each in dropped} == units
        assert len(dropped) == len(units)
        assert all(each.fault == fault for each in dropped)
        assert not any(unit.live for unit in units)
        reached = len(harness.reached)
        harness.advance(_duration(playing) + 0.5)
        assert len(harness.reached) == reached
        assert harness.audible_clips() == set()
        self._plays_whole(harness, harness.schedule(behavior_of(element), harness.now + _START))

    def _harness(self) -> EngineHarness:
        context = self.context()
        return EngineHarness(self.engine(context), context)

    def _plays_whole(self, harness: EngineHarness, unit: PlanUnit, *, frames: bool = False) -> None:
        """A unit reaches all its points, and no unit is dropped; without frames, in a third of the time."""
        self._plays_alone(harness, unit, frames=frames)
        assert harness.dropped == []

    def _plays_alone(self, harness: EngineHarness, unit: PlanUnit, *, frames: bool = False) -> None:
        harness.advance(max(0.0, harness.end(unit) - harness.now) + 0.05, frames=frames)
        if (late := harness.end(unit) - harness.now) > 0.0:  # a changed parameter moved the end
            harness.advance(late + 0.05, frames=frames)
        assert harness.points(unit) == harness.planned(unit)
        assert not unit.live


class _Unknown(Behavior):
    """A behavior that no engine plays."""


def _refusal(make: Callable[[Behavior], object], behavior: Behavior) -> Fault | None:
    """The fault with which a check or a plan refuses a behavior, None if it does not."""
    try:
        make(behavior)
    except RealizerError as refused:
        return refused.fault
    return None


def _renamed(element: str) -> Behavior:
    behavior = behavior_of(element)
    return replace(behavior, id=f"{behavior.id}-too", order=1)


def _duration(unit: PlanUnit) -> float:
    return offsets_of(unit.timing)[-1]


def _fail_at(unit: PlanUnit, wrong: str) -> None:
    whole = unit.on_sync

    def on_sync(sync: str, time: GlobalTime) -> None:
        if sync == wrong:
            raise ArithmeticError(f"no {sync}")
        whole(sync, time)

    unit.on_sync = on_sync  # type: ignore[method-assign]


def _shown(output: Output) -> tuple[object, ...]:
    return output.layers, output.face, output.eyes is not None


def _is_rotation(quaternion: Quat) -> bool:
    return abs(sum(each * each for each in quaternion) - 1.0) < 1e-6


def _assert_same_frames(one: EngineHarness, two: EngineHarness, first: int) -> None:
    """Both harnesses have the same frames from an index on."""
    assert len(one.frames) == len(two.frames)
    for left, right in zip(one.frames[first:], two.frames[first:], strict=True):
        assert np.abs(left.weights - right.weights).max(initial=0.0) < 1e-9
        assert np.abs(left.rotations - right.rotations).max() < 1e-6
