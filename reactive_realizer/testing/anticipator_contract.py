"""The contract of anticipators (thesis 8.5.1): a pytest class to inherit from; needs pytest and Hypothesis."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from inspect import Parameter, signature
from math import isfinite
from typing import ClassVar, Self

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.clock.ticker import tick_time
from reactive_realizer.clock.units import Time
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent, Remote
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.reactive.graph import Change, Commit
from reactive_realizer.realizer.inputs import StreamFailure
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness
from reactive_realizer.testing.contract_settings import inherited

_ID = "it"


class AnticipatorContract(ABC):
    """Tests of any anticipator, for any sequence of events: its stream goes on, and predicts only what was declared.

    Attributes:
        points: names of points that it predicts.
        events: events that it takes; several of each kind with a value or a text, so that they have an effect.
        refused: events that it refuses.
    """

    points: ClassVar[tuple[str, ...]]
    events: ClassVar[tuple[AnticipatorEvent, ...]]
    refused: ClassVar[tuple[AnticipatorEvent, ...]] = ()

    @abstractmethod
    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        """A new anticipator under test; inheriting classes define this."""

    @inherited
    @given(st.data())
    def test_its_stream_goes_on_and_predicts_only_its_own_points(self, data: st.DataObject) -> None:
        with _Watched(self) as watched:
            for now, event in self._story(data):
                watched.enter(now, event)
                assert not [each for each in watched.harness.predicted if isinstance(each, StreamFailure)]

    @inherited
    @given(st.data())
    def test_the_same_event_twice_at_one_time_moves_nothing_the_second_time(self, data: st.DataObject) -> None:
        with _Watched(self) as watched:
            for now, event in self._story(data):
                named = watched.times()
                watched.enter(now, event)
                watched.changes.clear()
                watched.enter(now, event)
                assert [change for change in watched.changes if change.cell in named] == []

    @inherited
    @given(st.data())
    def test_the_same_events_make_the_same_predictions(self, data: st.DataObject) -> None:
        with _Watched(self) as one, _Watched(self) as two:
            for now, event in self._story(data):
                one.enter(now, event)
                two.enter(now, event)
                assert one.named() == two.named()

    def test_without_events_nothing_changes(self) -> None:
        with _Watched(self) as watched:
            for number in range(1000):
                watched.harness.tick(tick_time(number))
            assert watched.changes == []

    def test_a_point_with_an_unknown_name_is_refused_unless_none_is_declared(self) -> None:
        with _Watched(self) as watched:
            for sync in self.points:
                watched.anticipator.check_point(sync, sync)
            if watched.anticipator.points:
                with pytest.raises(RealizerError, match="unheardOf"):
                    watched.anticipator.check_point("unheardOf", "unheardOf")

    def test_unknown_events_are_refused(self) -> None:
        with self._after_all_events() as watched:
            for event in (
                AnticipatorEvent("unheardOf"),
                AnticipatorEvent("unheardOf", 1.0),
                AnticipatorEvent("unheardOf", text="words"),
            ):
                with pytest.raises(RealizerError) as refusal:
                    watched.harness.check(watched.anticipator, event)
                assert refusal.value.fault.code == "unknown-event"

    def test_a_refused_event_has_a_reason_and_no_effect(self) -> None:
        with self._after_all_events() as watched, self._after_all_events() as other:
            for event in self.refused:
                with pytest.raises(RealizerError) as refusal:
                    watched.harness.check(watched.anticipator, event)
                assert refusal.value.fault.sentence
            for now, event in self._each_event(watched.harness.now + 0.5):
                watched.enter(now, event)
                other.enter(now, event)
                assert watched.named() == other.named()

    def test_a_thousand_events_a_second_leave_no_points_on_the_board(self) -> None:
        with _Watched(self) as watched:
            named = [view.key for view in watched.harness.board.snapshot()]
            for number in range(2000):
                watched.enter(number / 1000, self.events[number % len(self.events)])
            assert all(time is None or isfinite(time) for time in watched.named().values())
            assert {view.key for view in watched.harness.board.snapshot()} == set(named)

    def test_only_a_remote_anticipator_takes_predictions_of_others(self) -> None:
        with _Watched(self) as watched:
            if isinstance(watched.anticipator, Remote):
                watched.anticipator.check_prediction("hit")
            else:
                with pytest.raises(RealizerError, match=watched.anticipator.kind):
                    watched.anticipator.check_prediction("hit")

    def test_its_options_are_numbers_and_names_with_defaults(self) -> None:
        with _Watched(self) as watched:
            context, *own = signature(type(watched.anticipator)).parameters.values()
        assert context.name == "context"
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
            watched.enter(now, event)
        return watched


class _Watched:
    """An anticipator with a reference to each of its points, and the changes of these."""

    def __init__(self, contract: AnticipatorContract) -> None:
        self.harness = AnticipatorHarness()
        self.anticipator = self.harness.add(contract.anticipator(self.harness.context(_ID)))
        self.changes: list[Change] = []
        self._points = contract.points
        self._pegs: dict[AnticipatorPeg, None] = {}
        self.times()
        self.harness.board.graph.listen(self._note)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        self.harness.close()

    def enter(self, now: float, event: AnticipatorEvent) -> None:
        """Plays a tick with an event."""
        self.harness.tick(now, (self.anticipator, event))

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
