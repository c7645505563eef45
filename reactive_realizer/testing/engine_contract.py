"""What every engine has to keep to (thesis 8.6), as a pytest class to inherit from; needs pytest."""

from dataclasses import replace
from math import isfinite
from typing import ClassVar

import numpy as np
import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.names import Location
from reactive_realizer.clock.units import RESOLUTION, GlobalTime
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import Engine
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.testing.engine_stand import BLOCK, EngineStand, behavior_of, offsets_of, prepared
from reactive_realizer.testing.lone_context import lone_context

_START = 0.123
"""s; between two ticks."""

_REST = 3.0
"""s in which what was shown of a behavior has gone."""


class EngineContract:
    """For any engine: points are reached in order, each once, at the times of their pegs, and nothing is left behind.

    Attributes:
        elements: behaviors that the engine plays, as they are written in a block, one or more of each kind.
        refused: such as it plays none of, though they are of its kinds: a word that it does not know.
    """

    elements: ClassVar[tuple[str, ...]]
    refused: ClassVar[tuple[str, ...]] = ()

    def engine(self, context: EngineContext) -> Engine:
        """The engine under test, a new one with each call; the inheriting class makes it."""
        raise NotImplementedError

    def context(self) -> EngineContext:
        """What it is made from."""
        return lone_context()

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Each test that takes an element is run with each of them."""
        if "element" in metafunc.fixturenames:
            metafunc.parametrize("element", self.elements)

    # --- what it plays

    def test_it_says_what_it_plays(self) -> None:
        engine = self._stand().engine
        assert engine.name
        assert engine.behaviors
        assert isinstance(engine.leads, bool)
        assert isinstance(engine.reads_parameters, bool)
        assert engine.parameters.keys() <= engine.behaviors
        for namespace, name in engine.extensions:
            assert namespace
            assert name

    def test_it_knows_its_own_behaviors_and_no_others(self, element: str) -> None:
        engine, behavior = self._stand().engine, behavior_of(element)
        assert engine.supports(behavior)
        assert isinstance(behavior, tuple(engine.behaviors))
        assert not engine.supports(_UnheardOf(id="u", namespace="urn:u", name="u", location=Location(1, 1), order=0))

    def test_a_plan_has_points_in_order_and_the_time_they_would_like(self, element: str) -> None:
        stand, behavior = self._stand(), behavior_of(element)
        unit = stand.plan(behavior)
        points = unit.timing.points
        assert (unit.block, unit.behavior, unit.points) == (BLOCK, behavior, [])
        assert (points[0], points[-1]) == ("start", "end")
        assert len(set(points)) == len(points)
        assert behavior.syncs.keys() <= set(points)
        assert all(isfinite(phase.duration) and phase.duration >= 0 for phase in unit.timing.phases)

    def test_what_it_cannot_play_is_refused_with_a_reason_and_others_are_played(self) -> None:
        stand = self._stand()
        for element in self.refused:
            with pytest.raises(RealizerError) as refusal:
                stand.plan(behavior_of(element))
            assert refusal.value.fault.sentence
        self._plays_whole(stand, stand.enter(behavior_of(self.elements[0]), _START))

    def test_one_preparation_is_good_for_two_plans(self, element: str) -> None:
        stand, behavior = self._stand(), behavior_of(element)
        work = prepared(stand.engine, behavior)
        units = [stand.engine.plan(BLOCK, behavior, work) for _ in range(2)]
        assert units[0] is not units[1]
        assert units[0].timing == units[1].timing
        stand.place(units[1], _START)
        stand.engine.add(units[1])
        self._plays_whole(stand, units[1])

    def test_what_may_be_changed_while_it_plays_is_declared_and_may_be_changed(self, element: str) -> None:
        stand, behavior = self._stand(), behavior_of(element)
        unit = stand.enter(behavior, _START)
        declared = stand.engine.parameters.get(type(behavior), {})
        assert declared.keys() <= unit.parameters.keys(), "a unit may have more: those of its file"
        for parameter in unit.parameters.values():
            assert parameter.unit is unit
            assert parameter.value in parameter.range
        for share in (0.0, 1.0):
            stand.advance(_START + 0.3 * _duration(unit))
            for name, (low, high) in declared.items():
                assert unit.parameters[name].range == (low, high)
                unit.parameters[name].set(low + share * (high - low))
        self._plays_whole(stand, unit)

    # --- how it plays

    @pytest.mark.parametrize("every", [1, 37, 100_000])
    def test_every_point_is_reached_once_in_order_with_the_time_of_its_peg(self, element: str, every: int) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        while (before := stand.now) < stand.end(unit):
            stand.tick(every)
            assert all(before < time <= stand.now + RESOLUTION for _, _, time, at in stand.told if at == stand.now)
        self._plays_whole(stand, unit)

    def test_whether_anybody_looks_changes_no_time(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        stand.advance(_START + _duration(unit) + 0.1, frames=False)
        assert stand.points(unit) == stand.planned(unit)

    def test_what_is_not_in_its_plan_is_not_played(self, element: str) -> None:
        stand = self._stand()
        unit = stand.plan(behavior_of(element))
        stand.place(unit, _START)
        stand.advance(1.0)
        assert stand.told == []
        assert unit.live

    def test_a_behavior_whose_block_has_not_started_waits_for_it(self, element: str) -> None:
        stand = self._stand()
        unit, pending = stand.enter(behavior_of(element), _START), stand.plan(behavior_of(element)).state
        unit.state = pending
        stand.advance(1.0)
        assert stand.told == []
        unit.release()
        self._plays_whole(stand, unit)

    def test_a_behavior_whose_time_is_unknown_waits_for_it(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), None)
        stand.advance(1.0)
        assert (stand.told, stand.dropped, stand.asked) == ([], [], [])
        assert unit.live

    def test_points_that_are_moved_are_reached_where_they_are_then(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        stand.advance(0.1)
        stand.shift(unit, 0.5)
        while stand.now < _START + 0.5:
            stand.tick()
        if unit.live:
            stand.shift(unit, 1.0, "end")
        self._plays_whole(stand, unit)

    def test_playing_a_tick_again_changes_nothing(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        for _ in range(5):
            stand.advance(0.2 + _duration(unit) / 4)
            before, again = stand.again(), stand.again()
            assert (again.reached, again.dropped, again.audio) == ((), (), ())
            assert _shown(again) == _shown(before)
            assert again.requests == before.requests
        self._plays_whole(stand, unit)

    def test_playing_writes_nothing(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        self._plays_whole(stand, unit)
        assert stand.written == []

    def test_what_it_shows_can_be_shown(self, element: str) -> None:
        stand = self._stand()
        unit = stand.enter(behavior_of(element), _START)
        while stand.now < stand.end(unit):
            stand.tick(2)
            assert all(_is_rotation(each) for layer in stand.played.layers for each in layer.rotations.values())
            assert all(0.0 <= layer.weight <= 1.0 for layer in stand.played.layers)
            assert all(isfinite(weight) for weight in stand.played.face.values())
            assert np.linalg.norm(stand.frames[-1].rotations, axis=1) == pytest.approx(1.0)
            if stand.engine.leads:  # nobody looks at those that play first
                assert _shown(stand.played) == ((), {}, False)

    def test_the_same_again_is_the_same(self, element: str) -> None:
        stands = self._stand(), self._stand()
        for stand in stands:
            unit = stand.enter(behavior_of(element), _START)
            stand.advance(_START + _duration(unit) / 2)
            stand.enter(_renamed(element), stand.now)
            stand.advance(_duration(unit) + 1.0)
        one, two = ([(u.behavior.id, *rest) for u, *rest in stand.told] for stand in stands)
        assert one == two
        assert [str(each.fault) for each in stands[0].dropped] == [str(each.fault) for each in stands[1].dropped]
        assert stands[0].audio == stands[1].audio
        _assert_seen_alike(*stands, 0)

    # --- how it stops

    def test_what_is_removed_before_it_starts_leaves_nothing(self, element: str) -> None:
        stand, other = self._stand(), self._stand()
        unit = stand.enter(behavior_of(element), 1.0)
        for each in (stand, other):
            each.advance(0.5)
        stand.remove(unit)
        for each in (stand, other):
            each.advance(1.0 + _duration(unit))
        assert (stand.told, stand.dropped, stand.asked) == ([], [], [])
        assert stand.sounding() == set()
        _assert_seen_alike(stand, other, 0)

    @pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 1.5])
    def test_what_is_interrupted_is_not_heard_of_again_and_goes_back_to_rest(self, element: str, share: float) -> None:
        stand, other = self._stand(), self._stand()
        unit = stand.enter(behavior_of(element), _START)
        for each in (stand, other):
            each.advance(0.13 + share * _duration(unit))
        if unit.live:
            assert unit.gentle_end(stand.now) >= stand.now
            assert all(isinstance(text, str) for pair in unit.end_details(stand.now).items() for text in pair)
        stand.interrupt(unit)
        told = list(stand.told)
        for each in (stand, other):
            each.advance(_duration(unit) + _REST)
        assert (stand.told, stand.dropped) == (told, [])
        assert stand.sounding() == set()
        _assert_seen_alike(stand, other, -1)

    def test_one_after_the_other_is_played_whole(self, element: str) -> None:
        stand = self._stand()
        first = stand.enter(behavior_of(element), _START)
        second = stand.enter(_renamed(element), _START + _duration(first) + 0.5)
        self._plays_whole(stand, first)
        self._plays_whole(stand, second)

    def test_of_two_at_once_one_is_played_and_the_other_too_or_is_dropped_with_a_reason(self, element: str) -> None:
        stand = self._stand()
        units = [stand.enter(behavior, _START) for behavior in (behavior_of(element), _renamed(element))]
        stand.advance(_START + _duration(units[0]) + 0.1)
        gone = [each.unit for each in stand.dropped]
        assert len(gone) <= 1
        assert all(each.fault.sentence for each in stand.dropped)
        for unit in units:
            assert stand.points(unit) == ([] if unit in gone else stand.planned(unit))

    def test_a_behavior_that_fails_drops_itself_alone_whatever_the_point(self, element: str) -> None:
        for sync in self._stand().plan(behavior_of(element)).timing.points:
            stand = self._stand()
            bad = stand.enter(behavior_of(element), _START)
            good = stand.enter(_renamed(element), _START + _duration(bad) + 0.5)
            _fail_at(bad, sync)
            self._plays_alone(stand, good)
            ((unit, reason),) = [(each.unit, each.fault.sentence) for each in stand.dropped]
            assert unit is bad
            assert not bad.live
            assert f"no {sync}" in reason
            assert stand.sounding() == set()

    def test_when_it_fails_as_a_whole_its_behaviors_are_dropped_and_it_plays_on(self, element: str) -> None:
        stand, fault = self._stand(), Fault("engine-failed", {"engine": "it", "reason": "a test"})
        playing, waiting = stand.enter(behavior_of(element), _START), stand.enter(_renamed(element), 100.0)
        stand.advance(_START + 0.4 * _duration(playing))
        units = {unit for unit in (playing, waiting) if unit.live}
        dropped = stand.engine.fail(stand.now, fault).dropped
        assert {each.unit for each in dropped} == units
        assert len(dropped) == len(units)
        assert all(each.fault == fault for each in dropped)
        assert not any(unit.live for unit in units)
        told = len(stand.told)
        stand.advance(_duration(playing) + 0.5)
        assert len(stand.told) == told
        assert stand.sounding() == set()
        self._plays_whole(stand, stand.enter(behavior_of(element), stand.now + _START))

    def _stand(self) -> EngineStand:
        context = self.context()
        return EngineStand(self.engine(context), context)

    def _plays_whole(self, stand: EngineStand, unit: PlanUnit) -> None:
        """A unit, and no other one, leaves with all its points."""
        self._plays_alone(stand, unit)
        assert stand.dropped == []

    def _plays_alone(self, stand: EngineStand, unit: PlanUnit) -> None:
        stand.advance(max(0.0, stand.end(unit) - stand.now) + 0.05)
        assert stand.points(unit) == stand.planned(unit)
        assert not unit.live


class _UnheardOf(Behavior):
    """No engine plays it."""


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


def _shown(play: Play) -> tuple[object, ...]:
    return play.layers, play.face, play.eyes is not None


def _is_rotation(quaternion: Quat) -> bool:
    return abs(sum(each * each for each in quaternion) - 1.0) < 1e-6


def _assert_seen_alike(one: EngineStand, two: EngineStand, first: int) -> None:
    """The frames of both, from one on, are the same."""
    assert len(one.frames) == len(two.frames)
    for left, right in zip(one.frames[first:], two.frames[first:], strict=True):
        assert left.weights == pytest.approx(right.weights, abs=1e-9)
        assert np.abs(left.rotations - right.rotations).max() < 1e-6
