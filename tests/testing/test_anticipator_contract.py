"""Each of these anticipators breaks its contract in one way, and the test for that fails."""

from collections.abc import Callable
from itertools import count

import pytest

from reactive_realizer.errors import NotANumber, RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent, Predictions
from reactive_realizer.testing.anticipator_contract import AnticipatorContract

from .conftest import broken


class Clock(Anticipator):
    """Predicts a hit one second after a throw."""

    kind = "clock"
    events = ("throw",)
    points: tuple[str, ...] = ("hit",)

    async def predictions(self) -> Predictions:
        async for event in self.inputs:
            yield "hit", event.time + 1.0


class Undeclared(Clock):
    """Predicts a point that it does not declare."""

    points = ("miss",)


class Crashing(Clock):
    """Fails at the second throw."""

    async def predictions(self) -> Predictions:
        for left in (1, 0):
            event = await self.next_input()
            assert event is not None
            yield "hit", event.time + 1.0 / left


class Magic(Clock):
    """Uses infinity for an unknown time."""

    async def predictions(self) -> Predictions:
        async for _ in self.inputs:
            yield "hit", float("inf")


class Trembling(Clock):
    """Changes its prediction without a new event."""

    async def predictions(self) -> Predictions:
        calls = 0
        async for event in self.inputs:
            calls += 1
            yield "hit", event.time + 1.0 + calls / 1e6


class Restless(Clock):
    """Predicts without an event."""

    async def predictions(self) -> Predictions:
        while True:
            await self.clock.sleep(0.5)
            yield "hit", self.clock.now() + 1.0


class Excitable(Clock):
    """Takes unknown events."""

    def check(self, name: str, value: float | None) -> None:
        pass


class Lenient(Clock):
    """Refuses nothing."""


class Resentful(Clock):
    """Changes after it has refused an event."""

    patience = 1.0

    async def predictions(self) -> Predictions:
        async for event in self.inputs:
            yield "hit", event.time + self.patience

    def check(self, name: str, value: float | None) -> None:
        super().check(name, value)
        if value is not None and value < 0:
            self.patience = 2.0
            raise RealizerError(NotANumber())


class Littering(Clock):
    """Makes a point for each event."""

    points = ()

    async def predictions(self) -> Predictions:
        async for event in self.inputs:
            yield f"hit{event.time}", event.time + 1.0


class Gullible(Clock):
    """Takes predictions of others although it makes its own."""

    def check_prediction(self, point: str) -> None:
        pass


class Permissive(Clock):
    """Has every point."""

    def check_point(self, point: str, reference: str) -> None:
        pass


class Demanding(Clock):
    """Has an option without a default."""

    def __init__(self, context: AnticipatorContext, word: str) -> None:
        super().__init__(context)


class Chancy(Clock):
    """Predicts other times in every session."""

    chances = count()

    async def predictions(self) -> Predictions:
        async for event in self.inputs:
            yield "hit", event.time + 1.0 + next(self.chances) / 1e6


def anticipator_contract(kind: Callable[..., Clock]) -> type[AnticipatorContract]:
    class Contract(AnticipatorContract):
        points = ("hit",)
        events = (AnticipatorEvent("throw"), AnticipatorEvent("throw", 1.0))
        refused = (AnticipatorEvent("throw", -1.0),)

        def anticipator(self, context: AnticipatorContext) -> Clock:
            return kind(context, "word") if kind is Demanding else kind(context)

    return Contract


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Undeclared, "test_its_stream_goes_on_and_predicts_only_its_own_points"),
        (Crashing, "test_its_stream_goes_on_and_predicts_only_its_own_points"),
        (Magic, "test_its_stream_goes_on_and_predicts_only_its_own_points"),
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
        (Permissive, "test_a_point_with_an_unknown_name_is_refused_unless_none_is_declared"),
    ],
)
def test_an_anticipator_that_refuses_nothing_is_found(kind: type[Clock], test: str) -> None:
    with pytest.raises(pytest.fail.Exception, match="DID NOT RAISE"):
        getattr(anticipator_contract(kind)(), test)()
