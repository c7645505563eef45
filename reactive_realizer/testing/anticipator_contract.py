"""What every anticipator has to keep to (thesis 8.5.1), as a pytest class to inherit from; needs pytest, Hypothesis."""

import re
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
from reactive_realizer.reactive.commit import Change, Commit
from reactive_realizer.testing.anticipator_stand import AnticipatorStand, Told
from reactive_realizer.testing.inherited import inherited

_ID = "it"


class AnticipatorContract:
    """For any anticipator, whatever it is told and when: it writes its own points, never into the past, and repeats.

    Attributes:
        points: names of points that it predicts.
        events: what it may be told; of events with a value or a text several, so that something comes of them.
        refused: what it may not be told.
    """

    points: ClassVar[tuple[str, ...]]
    events: ClassVar[tuple[Told, ...]]
    refused: ClassVar[tuple[Told, ...]] = ()

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002 - the standard's word
        """The anticipator under test, a new one with each call; the inheriting class makes it."""
        raise NotImplementedError

    @inherited
    @given(st.data())
    def test_no_point_is_ever_set_before_now_and_unknown_is_none(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        for now, told in self._story(data):
            before = watched.times()
            watched.stand.event(now, watched.anticipator, *told)
            for peg, time in watched.times().items():
                assert time is None or isfinite(time)
                # A point that is named anew means its next time.
                if peg not in before or time != before[peg]:
                    assert time is None or time >= now - RESOLUTION

    @inherited
    @given(st.data())
    def test_it_writes_no_points_but_its_own(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        other = Anticipator("other", watched.stand.board)
        for sync in self.points:
            watched.stand.at(0.0, other.predict, sync, 1.5)
        watched.changes.clear()
        for now, told in self._story(data):
            watched.stand.event(now, watched.anticipator, *told)
        assert all(change.cell.name.startswith(f"anticipators:{_ID}:") for change in watched.changes)
        assert [watched.stand.time(other, sync) for sync in self.points] == [1.5] * len(self.points)

    @inherited
    @given(st.data())
    def test_an_event_that_is_told_twice_at_once_moves_nothing_the_second_time(self, data: st.DataObject) -> None:
        watched = _Watched(self)
        for now, told in self._story(data):
            hung_on = watched.times()
            watched.stand.event(now, watched.anticipator, *told)
            watched.changes.clear()
            watched.stand.event(now, watched.anticipator, *told)
            assert [change for change in watched.changes if change.cell in hung_on] == []

    @inherited
    @given(st.data())
    def test_the_same_events_make_the_same_predictions(self, data: st.DataObject) -> None:
        one, two = _Watched(self), _Watched(self)
        for now, told in self._story(data):
            for watched in (one, two):
                watched.stand.event(now, watched.anticipator, *told)
            assert one.named() == two.named()

    def test_what_is_never_told_anything_changes_nothing_as_time_goes_by(self) -> None:
        watched = _Watched(self)
        for number in range(1000):
            watched.stand.at(tick_time(number), watched.anticipator.advance)
        assert watched.changes == []

    def test_a_name_that_it_does_not_know_is_never_known(self) -> None:
        watched = _Watched(self)
        for now, told in self._each_event():
            assert watched.stand.time(watched.anticipator, "unheardOf") is None
            watched.stand.event(now, watched.anticipator, *told)
        assert watched.stand.time(watched.anticipator, "unheardOf") is None

    def test_events_that_it_does_not_know_are_refused(self) -> None:
        watched = self._told_everything()
        for told in (Told("unheardOf"), Told("unheardOf", 1.0), Told("unheardOf", text="words")):
            with pytest.raises(RealizerError) as refusal:
                watched.stand.event(watched.stand.now, watched.anticipator, *told)
            assert refusal.value.fault.code == "unknown-event"
        assert watched.changes == []

    def test_what_it_refuses_is_refused_with_a_reason_and_leaves_it_as_it_was(self) -> None:
        watched, other = self._told_everything(), self._told_everything()
        for told in self.refused:
            with pytest.raises(RealizerError) as refusal:
                watched.stand.check(watched.anticipator, told)
            assert refusal.value.fault.sentence
        assert watched.changes == []
        for now, told in self._each_event(watched.stand.now + 0.5):
            for each in (watched, other):
                each.stand.event(now, each.anticipator, *told)
            assert watched.named() == other.named()

    def test_a_thousand_events_a_second_are_taken_and_leave_nothing_lying_about(self) -> None:
        watched = _Watched(self)
        named = [view.key for view in watched.stand.board.snapshot()]
        for number in range(2000):
            told = self.events[number % len(self.events)]
            watched.stand.event(number / 1000, watched.anticipator, *told)
        assert all(time is None or isfinite(time) for time in watched.named().values())
        assert [view.key for view in watched.stand.board.snapshot()] == named

    def test_the_points_that_it_tells_of_itself_are_those_that_it_predicts(self) -> None:
        told = _Watched(self).anticipator.points
        forms = [re.sub("N$", "[0-9]+", re.escape(name)) for name in told]
        assert not told or all(any(re.fullmatch(form, sync) for form in forms) for sync in self.points)

    def test_others_may_say_when_its_points_are_only_if_it_is_of_the_kind_that_is_told(self) -> None:
        anticipator = _Watched(self).anticipator
        if anticipator.kind == Anticipator.kind:
            anticipator.check_prediction()
        else:
            with pytest.raises(RealizerError, match=anticipator.kind):
                anticipator.check_prediction()

    def test_what_the_human_file_may_say_of_it_are_numbers_and_names_with_defaults(self) -> None:
        id_, board, *own = signature(type(_Watched(self).anticipator)).parameters.values()
        assert (id_.name, board.name) == ("id", "board")
        for parameter in own:
            assert parameter.default is not Parameter.empty
            if parameter.kind is not Parameter.KEYWORD_ONLY:
                assert isinstance(parameter.default, int | float | tuple)

    def _story(self, data: st.DataObject) -> Iterator[tuple[float, Told]]:
        """What may happen, and when."""
        steps = st.tuples(st.sampled_from([0.0, 0.01, 0.2, 0.5, 0.5, 1.0, 3.0]), st.sampled_from(self.events))
        now = 0.0
        for wait, told in data.draw(st.lists(steps, max_size=20)):
            now += wait
            yield now, told

    def _each_event(self, start: float = 0.0) -> Iterator[tuple[float, Told]]:
        return ((start + number / 2, told) for number, told in enumerate(self.events))

    def _told_everything(self) -> "_Watched":
        watched = _Watched(self)
        for now, told in self._each_event():
            watched.stand.event(now, watched.anticipator, *told)
        watched.changes.clear()
        return watched


class _Watched:
    """An anticipator whose points are all named, and what happens to them."""

    def __init__(self, contract: AnticipatorContract) -> None:
        self.stand = AnticipatorStand()
        self.anticipator = contract.anticipator(_ID, self.stand.board)
        self.changes: list[Change] = []
        self._points = contract.points
        self._pegs: dict[AnticipatorPeg, None] = {}
        self.times()
        self.stand.board.graph.listen(self._note)

    def times(self) -> dict[AnticipatorPeg, Time]:
        """The points of all names, also as they were before they got to mean the next time."""
        for sync in self._points:
            self._pegs[self.stand.board.predicted(_ID, sync)] = None
        return {peg: peg.value for peg in self._pegs}

    def named(self) -> dict[str, Time]:
        """What the names mean now."""
        return {sync: self.stand.time(self.anticipator, sync) for sync in self._points}

    def _note(self, commit: Commit) -> None:
        self.changes += commit.changes
