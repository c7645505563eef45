"""The peg board names pegs, and anticipators predict points outside of blocks."""

import gc
import json

import pytest

from reactive_realizer.clock.tick_clock import TickClock
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Counted, Predictions, Remote
from reactive_realizer.pegboard.block_pegs import BMLBlockPeg, LatestPeg
from reactive_realizer.pegboard.bounded_pegs import AfterPeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey, anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg, RatioPeg, TimeCell, TimePeg
from reactive_realizer.reactive.graph import Graph

BLOCK = BlockKey("alice", "b")


@pytest.fixture
def board() -> PegBoard:
    return PegBoard(Graph())


class Clockwork(Anticipator):
    kind = "clockwork"
    points = (Counted("tick"),)

    async def predictions(self) -> Predictions:
        for tick in self.named:
            yield tick, self.forecast(tick)

    def forecast(self, point: str) -> GlobalTime | None:
        return GlobalTime(7.0) if point == "tick7" else None


@pytest.fixture
def clock(board: PegBoard) -> Clockwork:
    clock = Clockwork(AnticipatorContext("clock", TickClock()))
    board.anticipators["clock"] = clock
    return clock


def predict(board: PegBoard, anticipator: str, sync: str, time: float | None) -> None:
    with board.graph.transaction("predict"):
        board.predicted(anticipator, sync).set(None if time is None else GlobalTime(time))


def hang(board: PegBoard, sync: str, peg: AnticipatorPeg) -> OffsetPeg:
    own = OffsetPeg(board.graph, f"b:h:{sync}", peg, 0.0)
    board.add(PegKey(*BLOCK, "h", sync), own)
    return own


def test_a_key_is_written_as_block_behavior_and_sync_point() -> None:
    assert str(PegKey("alice", "b", "h", "start")) == "b:h:start"
    assert str(PegKey("alice", "b", None, "start")) == "b:start"


@pytest.mark.usefixtures("clock")
def test_an_anticipator_is_asked_for_a_counted_point_that_is_named_for_the_first_time(board: PegBoard) -> None:
    assert board.predicted("clock", "tick7").value == 7.0
    assert board.predicted("clock", "tick8").value is None
    assert board.predicted("nobody", "tick7").value is None
    assert set(board.predictions("clock")) == {"tick7", "tick8"}


def test_an_anticipator_with_its_own_predictions_accepts_none_from_outside(clock: Clockwork) -> None:
    Remote(AnticipatorContext("partner", TickClock())).check_prediction("hit")
    with pytest.raises(RealizerError, match="'clock' is a clockwork: it makes its own predictions"):
        clock.check_prediction("hit")


def test_one_point_has_one_peg(board: PegBoard) -> None:
    assert board.predicted("a", "hit") is board.predicted("a", "hit")


def test_a_snapshot_has_name_time_state_and_source(board: PegBoard) -> None:
    hit = board.predicted("a", "hit")
    peg = hang(board, "start", hit)
    assert [(str(v.key), v.time, v.state, v.source) for v in board.snapshot()] == [
        ("anticipators:a:hit", None, "unknown", "predicted"),
        ("b:h:start", None, "unknown", "anticipators:a:hit +0 s"),
    ]
    with board.graph.transaction("test"):
        hit.set(GlobalTime(2.0))
    assert [(v.time, v.state) for v in board.snapshot()] == [(2.0, "moving"), (2.0, "moving")]
    with board.graph.transaction("test"):
        peg.pin(GlobalTime(2.0))
    assert board.snapshot()[1].state == "pinned"


def test_a_snapshot_is_complete_and_is_written_as_json(board: PegBoard) -> None:
    board.begin(Tick.on_time(125))
    with board.graph.transaction("plan b"):
        start = BMLBlockPeg(board.graph, "b:start", GlobalTime(0.5), ())
        end = OffsetPeg(board.graph, "b:h:end", start, 2.0)
        end.why = "h:end = 2"
        between = RatioPeg(board.graph, "b:h:stroke", start, end, 0.25)
        after = AfterPeg(board.graph, "b:i:start", between, [(end, -1.0)])
        for key, peg in (((None, "start"), start), (("h", "end"), end), (("h", "stroke"), between)):
            board.add(PegKey(*BLOCK, *key), peg)
        board.add(PegKey(*BLOCK, "i", "start"), after)
    pegs = json.loads(json.dumps([view.as_json() for view in board.snapshot()]))
    assert pegs[1] == {
        "name": "b:h:end",
        "key": {"character": "alice", "block": "b", "behavior": "h", "sync": "end"},
        "kind": "offset",
        "time": 2.5,
        "state": "moving",
        "source": "b:start +2 s",
        "ties": ["b:start"],
        "parameters": {"offset": 2.0},
        "why": "h:end = 2",
        "owner": {"character": "alice", "block": "b"},
        "commit": {"sequence": 1, "cause": "plan b", "time": 1.25},
    }
    assert [(peg["kind"], peg["ties"], peg["parameters"]) for peg in (pegs[0], *pegs[2:])] == [
        ("block", [], {"floor": 0.5}),
        ("ratio", ["b:start", "b:h:end"], {"ratio": 0.25}),
        ("after", ["b:h:stroke", "b:h:end"], {"bounds": [-1.0], "stops": []}),
    ]


def test_a_peg_that_cannot_be_computed_is_unknown_in_a_snapshot_and_may_be_cut(board: PegBoard) -> None:
    hit = board.predicted("a", "hit")
    peg = hang(board, "start", hit)
    with board.graph.transaction("a plug-in of somebody"):
        hit.set("soon")  # type: ignore[arg-type]  # a mistake of a plug-in
    assert (board.snapshot()[1].time, board.snapshot()[1].state) == (None, "unknown")
    assert board.explain(PegKey(*BLOCK, "h", "start")).time is None
    with board.graph.transaction("test"):
        board.pin_block(BLOCK)
    assert peg.value is None


def test_a_snapshot_may_be_of_the_newest_only(board: PegBoard) -> None:
    for number in range(5):
        board.predicted("a", str(number))
    assert [view.key.sync for view in board.snapshot(newest=2)] == ["3", "4"]


def test_a_pinned_block_has_no_dependencies_and_reports_the_pegs_that_had(board: PegBoard) -> None:
    hit = board.predicted("a", "hit")
    start, end = hang(board, "start", hit), hang(board, "end", hit)
    board.add(PegKey(*BLOCK, "also", "end"), end)
    with board.graph.transaction("test"):
        start.pin(GlobalTime(0.0))
        assert board.pin_block(BLOCK) == [end]
    assert hit.dependents == {}


@pytest.mark.usefixtures("clock")
def test_a_removed_block_leaves_nothing_that_can_be_predicted_again(board: PegBoard) -> None:
    predict(board, "told", "hit", 3.0)
    points = (("clock", "tick7"), ("told", "other"), ("told", "hit"))
    for point in points:
        hang(board, "start", board.predicted(*point))
        with board.graph.transaction("test"):
            board.pin_block(BLOCK)
    board.remove_block(BLOCK, [anticipator_key(*point) for point in points])
    assert [str(view.key) for view in board.snapshot()] == ["anticipators:told:hit"]
    assert board.predicted("clock", "tick7").value == 7.0


def test_a_predicted_point_with_dependents_stays(board: PegBoard) -> None:
    hang(board, "start", board.predicted("a", "hit"))
    board.remove_block(BlockKey("alice", "another"), [anticipator_key("a", "hit")])
    assert len(board.snapshot()) == 2


def test_a_peg_that_is_named_in_two_blocks_belongs_to_the_first(board: PegBoard) -> None:
    other = BlockKey("alice", "c")
    peg = hang(board, "start", board.predicted("a", "hit"))
    board.add(PegKey(*other, "h", "start"), peg)
    assert [view.owner for view in board.snapshot() if view.key.sync == "start"] == [BLOCK, BLOCK]
    board.remove_block(other)
    assert [view.owner for view in board.snapshot() if view.key.sync == "start"] == [BLOCK]


def test_a_thousand_blocks_leave_nothing_behind(board: PegBoard) -> None:
    predict(board, "told", "hit", 1.0)
    hit = board.predicted("told", "hit")
    previous: TimeCell = hit

    def play(number: int, previous: TimeCell) -> TimeCell:
        key = BlockKey("alice", f"b{number}")
        with board.graph.transaction(f"plan {key.block}"):
            start = BMLBlockPeg(board.graph, "start", GlobalTime(0.0), (previous,))
            pegs = [OffsetPeg(board.graph, f"{i}", start if i % 2 else hit, float(i)) for i in range(8)]
            end = LatestPeg(board.graph, "end", GlobalTime(0.0), pegs)
            for i, peg in enumerate((start, *pegs, end)):
                board.add(PegKey(*key, "h", str(i)), peg)
        predict(board, "told", "hit", 1.0 + number)
        if number % 2:
            with board.graph.transaction("end"):
                board.pin_block(key)
        board.remove_block(key)
        return end

    for number in range(1000):
        previous = play(number, previous)
    del previous
    gc.collect()
    assert not [thing for thing in gc.get_objects() if isinstance(thing, TimePeg) and thing.graph is board.graph]
    assert hit.dependents == {}
    assert [str(view.key) for view in board.snapshot()] == ["anticipators:told:hit"]
    assert (len(board._blocks), list(board._owners)) == (1, [hit])
