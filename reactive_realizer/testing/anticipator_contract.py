"""The contract of anticipators (thesis 8.5.1): a pytest class to inherit from; needs pytest and Hypothesis."""

import re
from abc import ABC, abstractmethod
from collections.abc import Iterator
from inspect import Parameter, signature
from math import isfinite
from typing import ClassVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.clock.ticker import tick_time
from reactive_realizer.clock.units import RESOLUTION, Time
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.reactive.graph import Change, Commit
from reactive_realizer.testing.anticipator_harness import AnticipatorEvent, AnticipatorHarness
from reactive_realizer.testing.contract_settings import inherited

_ID = "it"


class AnticipatorContract(ABC):
    """Tests of any anticipator, for any sequence of events: it writes its own points only, and never into the past.

    Attributes:
        points: names of points that it predicts.
        events: events that it takes; several of each kind with a value or a text, so that they have an effect.
        refused: events that it refuses.
    """

    points: ClassVar[tuple[str, ...]]
    events: ClassVar[tuple[AnticipatorEvent, ...]]
    refused: ClassVar[tuple[AnticipatorEvent, ...]] = ()

    @abstractmethod
    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002 - the standard's word
        """A new anticipator under test; inheriting classes define this."""

    @inherited
    @given(st.data())
    def test_no_point_is_set_before_now_and_an_unknown_time_is_none(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        for now, event in self._story(data):
            before = watched.times()
            watched.harness.event(now, watched.anticipator, *event)
            for peg, time in watched.times().items():
                assert time is None or isfinite(time)
                # A new reference to a point names its next time.
                if peg not in before or time != before[peg]:
                    assert time is None or time >= now - RESOLUTION

    @inherited
    @given(st.data())
    def test_it_writes_only_its_own_points(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        other = Anticipator("other", watched.harness.board)
        for sync in self.points:
            watched.harness.at(0.0, other.predict, sync, 1.5)
        watched.changes.clear()
        for now, event in self._story(data):
            watched.harness.event(now, watched.anticipator, *event)
        assert all(change.cell.name.startswith(f"anticipators:{_ID}:") for change in watched.changes)
        assert [watched.harness.time(other, sync) for sync in self.points] == [1.5] * len(self.points)

    @inherited
    @given(st.data())
    def test_the_same_event_twice_at_one_time_moves_nothing_the_second_time(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        for now, event in self._story(data):
            named = watched.times()
            watched.harness.event(now, watched.anticipator, *event)
            watched.changes.clear()
            watched.harness.event(now, watched.anticipator, *event)
            assert [change for change in watched.changes if change.cell in named] == []

    @inherited
    @given(st.data())
    def test_the_same_events_make_the_same_predictions(self, data: st.DataObject) -> None:
        one, two = _Watched(self), _Watched(self)
        for now, event in self._story(data):
            for watched in (one, two):
                watched.harness.event(now, watched.anticipator, *event)
            assert one.named() == two.named()

    def test_without_events_nothing_changes(self) -> None:
        watched = _Watched(self)
        for number in range(1000):
            watched.harness.at(tick_time(number), watched.anticipator.advance)
        assert watched.changes == []

    def test_a_point_with_an_unknown_name_has_no_time(self) -> None:
        watched = _Watched(self)
        for now, event in self._each_event():
            assert watched.harness.time(watched.anticipator, "unheardOf") is None
            watched.harness.event(now, watched.anticipator, *event)
        assert watched.harness.time(watched.anticipator, "unheardOf") is None

    def test_unknown_events_are_refused(self) -> None:
        watched = self._after_all_events()
        for event in (
            AnticipatorEvent("unheardOf"),
            AnticipatorEvent("unheardOf", 1.0),
            AnticipatorEvent("unheardOf", text="words"),
        ):
            with pytest.raises(RealizerError) as refusal:
                watched.harness.event(watched.harness.now, watched.anticipator, *event)
            assert refusal.value.fault.code == "unknown-event"
        assert watched.changes == []

    def test_a_refused_event_has_a_reason_and_no_effect(self) -> None:
        watched, other = self._after_all_events(), self._after_all_events()
        for event in self.refused:
            with pytest.raises(RealizerError) as refusal:
                watched.harness.check(watched.anticipator, event)
            assert refusal.value.fault.sentence
        assert watched.changes == []
        for now, event in self._each_event(watched.harness.now + 0.5):
            for each in (watched, other):
                each.harness.event(now, each.anticipator, *event)
            assert watched.named() == other.named()

    def test_a_thousand_events_a_second_leave_no_points_on_the_board(self) -> None:
        watched = _Watched(self)
        named = [view.key for view in watched.harness.board.snapshot()]
        for number in range(2000):
            event = self.events[number % len(self.events)]
            watched.harness.event(number / 1000, watched.anticipator, *event)
        assert all(time is None or isfinite(time) for time in watched.named().values())
        assert [view.key for view in watched.harness.board.snapshot()] == named

    def test_its_declared_points_are_those_that_it_predicts(self) -> None:
        event = _Watched(self).anticipator.points
        forms = [re.sub("N$", "[0-9]+", re.escape(name)) for name in event]
        assert not event or all(any(re.fullmatch(form, sync) for form in forms) for sync in self.points)

    def test_only_a_remote_anticipator_takes_predictions_of_others(self) -> None:
        anticipator = _Watched(self).anticipator
        if anticipator.kind == Anticipator.kind:
            anticipator.check_prediction()
        else:
            with pytest.raises(RealizerError, match=anticipator.kind):
                anticipator.check_prediction()

    def test_its_options_are_numbers_and_names_with_defaults(self) -> None:
        id_, board, *own = signature(type(_Watched(self).anticipator)).parameters.values()
        assert (id_.name, board.name) == ("id", "board")
        for parameter in own:
            assert parameter.default is not Parameter.empty
            if parameter.kind is not Parameter.KEYWORD_ONLY:
                assert isinstance(parameter.default, int | float | tuple)

    def _story(self, data: st.DataObject) -> Iterator[tuple[float, AnticipatorEvent]]:
        """Random events, each with its time, s."""
        steps = st.tuples(st.sampled_from([0.0, 0.01, 0.2, 0.5, 0.5, 1.0, 3.0]), st.sampled_from(self.events))
        now = 0.0
        for wait, event in data.draw(st.lists(steps, max_size=20)):
            now += wait
            yield now, event

    def _each_event(self, start: float = 0.0) -> Iterator[tuple[float, AnticipatorEvent]]:
        return ((start + number / 2, event) for number, event in enumerate(self.events))

    def _after_all_events(self) -> "_Watched":
        watched = _Watched(self)
        for now, event in self._each_event():
            watched.harness.event(now, watched.anticipator, *event)
        watched.changes.clear()
        return watched


class _Watched:
    """An anticipator with a reference to each of its points, and the changes of these."""

    def __init__(self, contract: AnticipatorContract) -> None:
        self.harness = AnticipatorHarness()
        self.anticipator = contract.anticipator(_ID, self.harness.board)
        self.changes: list[Change] = []
        self._points = contract.points
        self._pegs: dict[AnticipatorPeg, None] = {}
        self.times()
        self.harness.board.graph.listen(self._note)

    def times(self) -> dict[AnticipatorPeg, Time]:
        """The times of all points, including those that a new reference would not name."""
        for sync in self._points:
            self._pegs[self.harness.board.predicted(_ID, sync)] = None
        return {peg: peg.value for peg in self._pegs}

    def named(self) -> dict[str, Time]:
        """The times of all points, for a reference made now."""
        return {sync: self.harness.time(self.anticipator, sync) for sync in self._points}

    def _note(self, commit: Commit) -> None:
        self.changes += commit.changes
