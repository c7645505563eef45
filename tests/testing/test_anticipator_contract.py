"""Each of these anticipators breaks its contract in one way, and the test for that fails."""

from collections.abc import Callable
from itertools import count

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import NotANumber, RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_harness import AnticipatorEvent

from .conftest import broken


class Clock(Anticipator):
    """Predicts a hit one second after a throw."""

    kind = "clock"
    events = ("throw",)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        if name == "throw":
            self.predict("hit", GlobalTime(now + 1.0), now)


class Late(Clock):
    """Sets a time in the past, without the base class."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        if name == "throw":
            self._board.predicted(self.id, "hit").set(GlobalTime(now - 0.1))


class Magic(Clock):
    """Uses a number for an unknown time."""

    def forecast(self, sync: str) -> GlobalTime | None:
        return GlobalTime(-1.0)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self.predict("hit", None, now)


class Intruder(Clock):
    """Writes points of another anticipator."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self._board.predicted("other", "hit").set(GlobalTime(now + 1.0))


class Trembling(Clock):
    """Changes its prediction without a new event."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self.calls = getattr(self, "calls", 0) + 1
        self.predict("hit", GlobalTime(now + 1.0 + self.calls / 1e6), now)


class Restless(Clock):
    """Predicts without an event."""

    def advance(self, now: GlobalTime) -> None:
        self.predict("hit", GlobalTime(now + 1.0), now)


class Excitable(Clock):
    """Takes unknown events."""

    def check(self, name: str, value: float | None) -> None:
        pass


class Lenient(Clock):
    """Refuses nothing."""


class Resentful(Clock):
    """Changes after it has refused an event."""

    patience = 1.0

    def check(self, name: str, value: float | None) -> None:
        super().check(name, value)
        if value is not None and value < 0:
            self.patience = 2.0
            raise RealizerError(NotANumber())

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self.predict("hit", GlobalTime(now + self.patience), now)


class Littering(Clock):
    """Makes a point for each event."""

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self.predict(f"hit{now}", GlobalTime(now + 1.0), now)


class Gullible(Clock):
    """Takes predictions of others although it makes its own."""

    def check_prediction(self) -> None:
        pass


class Demanding(Clock):
    """Has an option without a default."""

    def __init__(self, id: str, board: PegBoard, word: str) -> None:  # noqa: A002
        super().__init__(id, board)


class Chancy(Clock):
    """Predicts other times in every session."""

    chances = count()

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        self.predict("hit", GlobalTime(now + 1.0 + next(self.chances) / 1e6), now)


def anticipator_contract(kind: Callable[..., Clock]) -> type[AnticipatorContract]:
    class Contract(AnticipatorContract):
        points = ("hit",)
        events = (AnticipatorEvent("throw"), AnticipatorEvent("throw", 1.0))
        refused = (AnticipatorEvent("throw", -1.0),)

        def anticipator(self, id: str, board: PegBoard) -> Clock:  # noqa: A002
            return kind(id, board, "word") if kind is Demanding else kind(id, board)

    return Contract


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Late, "test_no_point_is_set_before_now_and_an_unknown_time_is_none"),
        (Magic, "test_a_point_with_an_unknown_name_has_no_time"),
        (Intruder, "test_it_writes_only_its_own_points"),
        (Trembling, "test_the_same_event_twice_at_one_time_moves_nothing_the_second_time"),
        (Restless, "test_without_events_nothing_changes"),
        (Resentful, "test_a_refused_event_has_a_reason_and_no_effect"),
        (Littering, "test_a_thousand_events_a_second_leave_no_points_on_the_board"),
        (Demanding, "test_its_options_are_numbers_and_names_with_defaults"),
        (Chancy, "test_the_same_events_make_the_same_predictions"),
    ],
)
def test_an_anticipator_that_breaks_its_contract_is_found(kind: type[Clock], test: str) -> None:
    broken(anticipator_contract(kind), test)


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Lenient, "test_a_refused_event_has_a_reason_and_no_effect"),
        (Excitable, "test_unknown_events_are_refused"),
        (Gullible, "test_only_a_remote_anticipator_takes_predictions_of_others"),
    ],
)
def test_an_anticipator_that_refuses_nothing_is_found(kind: type[Clock], test: str) -> None:
    with pytest.raises(pytest.fail.Exception, match="DID NOT RAISE"):
        getattr(anticipator_contract(kind)(), test)()
