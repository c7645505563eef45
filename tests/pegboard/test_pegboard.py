"""The board names pegs; anticipators say what nobody else knows."""

import math

import pytest

from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.reactive.graph import Graph

BLOCK = BlockKey("alice", "b")


@pytest.fixture
def board() -> PegBoard:
    return PegBoard(Graph())


class Clockwork(Anticipator):
    kind = "clockwork"

    def forecast(self, sync):
        return 7.0 if sync == "seven" else None


def predict(anticipator, sync, time, now=0.0):
    with anticipator._board.graph.transaction("predict"):
        anticipator.predict(sync, time, now)
    return anticipator._board.predicted(anticipator.id, sync).value


def hang(board, sync, peg):
    own = OffsetPeg(board.graph, f"b:h:{sync}", peg, 0.0)
    board.add(PegKey(*BLOCK, "h", sync), own)
    return own


def test_a_name_says_block_behavior_and_sync_point() -> None:
    assert str(PegKey("alice", "b", "h", "start")) == "b:h:start"
    assert str(PegKey("alice", "b", None, "start")) == "b:start"


def test_a_point_that_is_named_for_the_first_time_is_asked_for(board) -> None:
    Clockwork("clock", board)
    assert board.predicted("clock", "seven").value == 7.0
    assert board.predicted("clock", "eight").value is None
    assert board.predicted("nobody", "seven").value is None
    assert set(board.predictions("clock")) == {"seven", "eight"}


def test_one_that_predicts_by_itself_takes_no_predictions_from_outside(board) -> None:
    Anticipator("partner", board).check_prediction()
    with pytest.raises(RealizerError, match="'clock' is a clockwork, which makes its own predictions"):
        Clockwork("clock", board).check_prediction()


def test_one_point_has_one_peg(board) -> None:
    assert board.predicted("a", "hit") is board.predicted("a", "hit")


def test_a_snapshot_tells_name_time_state_and_source(board) -> None:
    hit = board.predicted("a", "hit")
    peg = hang(board, "start", hit)
    assert [(str(v.key), v.time, v.state, v.source) for v in board.snapshot()] == [
        ("anticipators:a:hit", None, "unknown", "predicted"),
        ("b:h:start", None, "unknown", "anticipators:a:hit +0 s"),
    ]
    with board.graph.transaction("test"):
        hit.set(2.0)
    assert [(v.time, v.state) for v in board.snapshot()] == [(2.0, "moving"), (2.0, "moving")]
    with board.graph.transaction("test"):
        peg.pin(2.0)
    assert board.snapshot()[1].state == "pinned"


def test_a_block_that_is_cut_hangs_on_nothing_and_says_what_did(board) -> None:
    hit = board.predicted("a", "hit")
    start, end = hang(board, "start", hit), hang(board, "end", hit)
    board.add(PegKey(*BLOCK, "also", "end"), end)
    with board.graph.transaction("test"):
        start.pin(0.0)
        assert board.pin_block(BLOCK) == [end]
    assert hit.dependents == {}


def test_a_block_that_is_removed_leaves_nothing_behind_that_can_be_known_again(board) -> None:
    Clockwork("clock", board)
    told = Anticipator("told", board)
    predict(told, "hit", 3.0)
    for peg in (board.predicted("clock", "seven"), board.predicted("told", "other"), board.predicted("told", "hit")):
        hang(board, "start", peg)
        with board.graph.transaction("test"):
            board.pin_block(BLOCK)
    board.remove_block(BLOCK)
    assert [str(view.key) for view in board.snapshot()] == ["anticipators:told:hit"]
    assert board.predicted("clock", "seven").value == 7.0


def test_a_predicted_point_that_others_hang_on_stays(board) -> None:
    hang(board, "start", board.predicted("a", "hit"))
    board.remove_block(BlockKey("alice", "another"))
    assert len(board.snapshot()) == 2


def test_a_prediction_moves_a_point_until_it_has_passed(board) -> None:
    told = Anticipator("told", board)
    assert predict(told, "hit", 3.0) == 3.0
    assert predict(told, "hit", 2.0, now=1.0) == 2.0
    assert predict(told, "hit", 1.0, now=2.5) == 2.0, "it has passed and keeps its time"
    assert predict(told, "hit", 4.0, now=2.5) == 4.0, "it is to happen again"


def test_whatever_comes_late_comes_now(board) -> None:
    told = Anticipator("told", board)
    assert predict(told, "hit", 1.0, now=2.0) == 2.0
    assert predict(told, "other", 5.0, now=2.0) == 5.0
    assert predict(told, "other", 1.0, now=3.0) == 3.0


def test_what_was_said_can_be_withdrawn(board) -> None:
    told = Anticipator("told", board)
    predict(told, "hit", 3.0)
    assert predict(told, "hit", None) is None


@pytest.mark.parametrize("time", [math.nan, math.inf, -math.inf])
def test_a_time_that_is_none_is_refused(board, time) -> None:
    told = Anticipator("told", board)
    predict(told, "hit", 3.0)
    with pytest.raises(RealizerError, match="not a finite number"):
        predict(told, "hit", time)
    assert board.predicted("told", "hit").value == 3.0
