"""Predictions of points that happen once, that recur, and that did not count."""

import math

import pytest

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Counted, Predictions
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey, anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.predicted_points import PredictedPoints
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.reactive.graph import Graph


class Key(Anticipator):
    kind = "key"
    points = ("press", Counted("turn"))

    async def predictions(self) -> Predictions:
        yield "press", 1.0


class Stage:
    """A board with the anticipator ``key``; all others are predicted by clients."""

    def __init__(self) -> None:
        self.board = PegBoard(Graph())
        self.points = PredictedPoints(self.board, 10)
        self.board.anticipators["key"] = Key(AnticipatorContext("key", TickClock()))

    def predict(self, sync: str, time: float | None, now: float = 0.0, anticipator: str = "key") -> float | None:
        with self.board.graph.transaction("test"):
            self.points.predict(anticipator, sync, None if time is None else GlobalTime(time), GlobalTime(now))
        return self.board.predicted(anticipator, sync).value

    def tell(self, sync: str, time: float | None, now: float = 0.0) -> float | None:
        return self.predict(sync, time, now, "told")

    def renew(self, now: float) -> None:
        with self.board.graph.transaction("test"):
            self.points.renew(GlobalTime(now))

    def revoke(self) -> None:
        with self.board.graph.transaction("test"):
            self.points.revoke("key", "press")

    def hang(self, sync: str = "press", anticipator: str = "key") -> OffsetPeg:
        """The peg of a behavior half a second after a point."""
        return OffsetPeg(self.board.graph, "behavior", self.board.predicted(anticipator, sync), 0.5)


@pytest.fixture
def stage() -> Stage:
    return Stage()


def test_a_prediction_moves_a_point_until_it_has_passed(stage: Stage) -> None:
    assert stage.tell("hit", 3.0) == 3.0
    assert stage.tell("hit", 2.0, now=1.0) == 2.0
    assert stage.tell("hit", 1.0, now=2.5) == 2.0, "it has passed and keeps its time"
    assert stage.tell("hit", 4.0, now=2.5) == 4.0, "it is to happen again"


def test_a_late_prediction_is_set_to_now(stage: Stage) -> None:
    assert stage.tell("hit", 1.0, now=2.0) == 2.0
    assert stage.tell("other", 5.0, now=2.0) == 5.0
    assert stage.tell("other", 1.0, now=3.0) == 3.0


def test_a_prediction_can_be_withdrawn(stage: Stage) -> None:
    stage.tell("hit", 3.0)
    assert stage.tell("hit", None) is None


@pytest.mark.parametrize("time", [math.nan, math.inf, -math.inf])
def test_a_time_that_is_not_finite_is_refused(stage: Stage, time: float) -> None:
    stage.tell("hit", 3.0)
    with pytest.raises(RealizerError, match="not a finite number"):
        stage.tell("hit", time)
    assert stage.board.predicted("told", "hit").value == 3.0


def test_the_name_of_a_recurring_point_means_the_next_occurrence_when_it_has_passed(stage: Stage) -> None:
    early = stage.hang()
    assert stage.predict("press", 2.0) == 2.0
    stage.renew(1.99)
    assert stage.board.predicted("key", "press").value == 2.0
    stage.renew(2.0)
    late = stage.hang()
    assert (early.value, late.value) == (2.5, None)
    stage.predict("press", 7.0, now=3.0)
    assert (early.value, late.value) == (2.5, 7.5)


def test_an_occurrence_now_is_over_at_once(stage: Stage) -> None:
    early = stage.hang()
    assert stage.predict("press", 2.0, now=2.0) is None
    assert early.value == 2.5


def test_counted_points_and_those_of_clients_keep_their_names(stage: Stage) -> None:
    stage.predict("turn1", 1.0)
    stage.tell("hit", 1.0)
    stage.renew(5.0)
    assert stage.board.predicted("key", "turn1").value == 1.0
    assert stage.board.predicted("told", "hit").value == 1.0


def test_what_depends_on_a_revoked_occurrence_waits_for_the_next_one(stage: Stage) -> None:
    hanging = []
    for now in (2.0, 4.0, 6.0):
        hanging.append(stage.hang())
        stage.predict("press", now, now)
        stage.revoke()
        assert [peg.value for peg in hanging] == [None] * len(hanging)
    stage.predict("press", 8.0, now=7.0)
    assert [peg.value for peg in hanging] == [8.5] * 3
    stage.predict("press", 9.0, now=7.5)
    assert [peg.value for peg in hanging] == [9.5] * 3


def test_only_the_last_occurrence_is_revoked(stage: Stage) -> None:
    first = stage.hang()
    stage.predict("press", 2.0, now=2.0)
    second = stage.hang()
    stage.predict("press", 3.0, now=3.0)
    stage.revoke()
    assert (first.value, second.value) == (2.5, None)


def test_a_revoked_occurrence_gets_the_time_of_the_next_one_if_that_is_predicted(stage: Stage) -> None:
    early = stage.hang()
    stage.predict("press", 2.0, now=2.0)
    stage.predict("press", 9.0, now=2.1)
    stage.revoke()
    assert early.value == 9.5


def test_nothing_is_revoked_before_the_first_occurrence(stage: Stage) -> None:
    early = stage.hang()
    stage.predict("press", 9.0)
    stage.revoke()
    assert early.value == 9.5


def test_a_renewed_point_keeps_its_owner(stage: Stage) -> None:
    stage.board.predicted("key", "press")
    (old,) = stage.board.snapshot()
    stage.predict("press", 2.0, now=2.0)
    (new,) = stage.board.snapshot()
    assert new.time is None
    assert new.owner == old.owner


def test_renewing_leaves_nothing_behind(stage: Stage) -> None:
    for number in range(100):
        stage.predict("press", float(number), float(number))
    board = stage.board
    assert [str(view.key) for view in board.snapshot()] == ["anticipators:key:press"]
    block = BlockKey("alice", "b")
    board.add(PegKey(*block, "h", "start"), OffsetPeg(board.graph, "h", board.predicted("key", "press"), 0.0))
    with board.graph.transaction("test"):
        board.pin_block(block)
    board.remove_block(block, [anticipator_key("key", "press")])
    assert board.snapshot() == ()


def test_points_that_have_passed_make_room_for_new_ones(stage: Stage) -> None:
    for number in range(30):
        stage.tell(f"hit{number}", float(number), float(number))
    assert list(stage.board.predictions("told")) == [f"hit{number}" for number in range(20, 30)]
