"""The contract of anticipators finds what breaks it: each of these is wrong in one way."""

from collections.abc import Callable
from itertools import count

import pytest

from reactive_realizer.errors import error
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_stand import Told

from .conftest import broken


class Clock(Anticipator):
    """Predicts a hit in a second when it is told of a throw."""

    kind = "clock"
    events = ("throw",)

    def event(self, name, value, now):
        if name == "throw":
            self.predict("hit", now + 1.0, now)


class Late(Clock):
    """Says when it was, around the base."""

    def event(self, name, value, now):
        if name == "throw":
            self._board.predicted(self.id, "hit").set(now - 0.1)


class Magic(Clock):
    """Has a number for what it does not know."""

    def forecast(self, sync):
        return -1.0

    def event(self, name, value, now):
        self.predict("hit", None, now)


class Intruder(Clock):
    """Knows when others' points are."""

    def event(self, name, value, now):
        self._board.predicted("other", "hit").set(now + 1.0)


class Trembling(Clock):
    """Predicts anew what it has predicted."""

    def event(self, name, value, now):
        self.calls = getattr(self, "calls", 0) + 1
        self.predict("hit", now + 1.0 + self.calls / 1e6, now)


class Restless(Clock):
    """Predicts as time goes by."""

    def advance(self, now):
        self.predict("hit", now + 1.0, now)


class Excitable(Clock):
    """Takes any event for its own."""

    def check(self, name, value):
        pass


class Lenient(Clock):
    """Refuses nothing."""


class Resentful(Clock):
    """Is another one after it has refused."""

    patience = 1.0

    def check(self, name, value):
        super().check(name, value)
        if value is not None and value < 0:
            self.patience = 2.0
            raise error("not-a-number")

    def event(self, name, value, now):
        self.predict("hit", now + self.patience, now)


class Littering(Clock):
    """Has a name for each event."""

    def event(self, name, value, now):
        self.predict(f"hit{now}", now + 1.0, now)


class Gullible(Clock):
    """Takes predictions from others though it makes its own."""

    def check_prediction(self):
        pass


class Demanding(Clock):
    """Cannot be made without a word."""

    def __init__(self, id, board, word):  # noqa: A002
        super().__init__(id, board)


class Chancy(Clock):
    """Is never the same."""

    chances = count()

    def event(self, name, value, now):
        self.predict("hit", now + 1.0 + next(self.chances) / 1e6, now)


def anticipator_contract(kind: Callable) -> type[AnticipatorContract]:
    class Contract(AnticipatorContract):
        points = ("hit",)
        events = (Told("throw"), Told("throw", 1.0))
        refused = (Told("throw", -1.0),)

        def anticipator(self, id, board):  # noqa: A002
            return kind(id, board, "word") if kind is Demanding else kind(id, board)

    return Contract


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Late, "test_no_point_is_ever_set_before_now_and_unknown_is_none"),
        (Magic, "test_a_name_that_it_does_not_know_is_never_known"),
        (Intruder, "test_it_writes_no_points_but_its_own"),
        (Trembling, "test_an_event_that_is_told_twice_at_once_moves_nothing_the_second_time"),
        (Restless, "test_what_is_never_told_anything_changes_nothing_as_time_goes_by"),
        (Resentful, "test_what_it_refuses_is_refused_with_a_reason_and_leaves_it_as_it_was"),
        (Littering, "test_a_thousand_events_a_second_are_taken_and_leave_nothing_lying_about"),
        (Demanding, "test_what_the_human_file_may_say_of_it_are_numbers_and_names_with_defaults"),
        (Chancy, "test_the_same_events_make_the_same_predictions"),
    ],
)
def test_an_anticipator_that_breaks_its_contract_is_found(kind, test) -> None:
    broken(anticipator_contract(kind), test)


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Lenient, "test_what_it_refuses_is_refused_with_a_reason_and_leaves_it_as_it_was"),
        (Excitable, "test_events_that_it_does_not_know_are_refused"),
        (Gullible, "test_others_may_say_when_its_points_are_only_if_it_is_of_the_kind_that_is_told"),
    ],
)
def test_an_anticipator_that_refuses_nothing_is_found(kind, test) -> None:
    with pytest.raises(pytest.fail.Exception, match="DID NOT RAISE"):
        getattr(anticipator_contract(kind)(), test)()
