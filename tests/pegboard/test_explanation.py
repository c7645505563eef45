"""Explanations of the times of points: pegs, constraints, commits."""

import json

import pytest

from reactive_realizer.clock.ticker import RATE, Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.block_pegs import BMLBlockPeg, LatestPeg
from reactive_realizer.pegboard.bounded_pegs import AfterPeg, BeforePeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.peg_view import Explanation
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg, RatioPeg, TimePeg
from reactive_realizer.reactive.graph import Graph, Stamp

BLOCK = BlockKey("alice", "b")
START, STROKE, END = (PegKey(*BLOCK, "clap", sync) for sync in ("start", "stroke", "end"))


@pytest.fixture
def board() -> PegBoard:
    """A clap whose stroke is tied to a predicted point."""
    board = PegBoard(Graph())
    board.begin(Tick.on_time(10))
    with board.graph.transaction("plan b"):
        stroke = OffsetPeg(board.graph, "b:clap:stroke", board.predicted("partner", "hit"), 0.0)
        stroke.why = "clap:stroke = anticipators:partner:hit"
        board.add(STROKE, stroke)
        board.add(START, OffsetPeg(board.graph, "b:clap:start", stroke, -0.5))
        board.add(END, OffsetPeg(board.graph, "b:clap:end", stroke, 0.5))
    predict(board, 2.0, at=0.4)
    return board


def peg_of(board: PegBoard, key: PegKey) -> TimePeg:
    peg = board.get(key)
    assert isinstance(peg, TimePeg)
    return peg


def predict(board: PegBoard, time: float | None, at: float) -> None:
    board.begin(Tick.on_time(round(at * RATE)))
    with board.graph.transaction("partner predicts hit"):
        board.predicted("partner", "hit").set(None if time is None else GlobalTime(time))


def pin(board: PegBoard, key: PegKey, at: float) -> None:
    board.begin(Tick.on_time(round(at * RATE)))
    with board.graph.transaction("reached"):
        peg = peg_of(board, key)
        peg.pin(peg.value)


def stamp_of(explanation: Explanation) -> Stamp:
    assert explanation.commit
    return explanation.commit


def chain(explanation: Explanation) -> list[tuple[str, float | None]]:
    """Names and times along the first sources."""
    links: list[tuple[str, float | None]] = [(explanation.name, explanation.time)]
    while explanation.sources:
        explanation = explanation.sources[0]
        links.append((explanation.name, explanation.time))
    return links


def test_an_explanation_has_the_chain_of_pegs_that_determined_a_time(board: PegBoard) -> None:
    assert chain(board.explain(START)) == [
        ("b:clap:start", 1.5),
        ("b:clap:stroke", 2.0),
        ("anticipators:partner:hit", 2.0),
    ]


def test_each_explained_peg_has_its_rule_its_constraint_and_its_commit(board: PegBoard) -> None:
    start = board.explain(START)
    stroke, hit = start.sources[0], start.sources[0].sources[0]
    assert (start.kind, start.state, start.rule, start.tie) == ("offset", "moving", "b:clap:stroke -0.5 s", None)
    assert stroke.tie == "clap:stroke = anticipators:partner:hit"
    assert (hit.kind, hit.rule) == ("predicted", "predicted")
    assert {(stamp_of(each).cause, stamp_of(each).time) for each in (start, stroke, hit)} == {
        ("partner predicts hit", 0.4)
    }


def test_a_point_that_never_moved_has_the_commit_that_made_it(board: PegBoard) -> None:
    with board.graph.transaction("plan c"):
        board.add(PegKey("alice", "c", None, "start"), BMLBlockPeg(board.graph, "c:start", GlobalTime(3.0), ()))
    explanation = board.explain(PegKey("alice", "c", None, "start"))
    assert (explanation.kind, explanation.rule, stamp_of(explanation).cause) == ("block", "latest of 3 s", "plan c")


def test_a_commit_without_a_change_is_no_explanation(board: PegBoard) -> None:
    predict(board, 2.0, at=0.9)
    assert stamp_of(board.explain(START)).time == 0.4


def test_an_unknown_time_is_explained_by_what_it_waits_for(board: PegBoard) -> None:
    predict(board, None, at=0.5)
    assert board.explain(START).state == "unknown"
    assert chain(board.explain(START))[-1] == ("anticipators:partner:hit", None)
    assert stamp_of(board.explain(START)).time == 0.5


def test_a_fired_point_is_explained_by_its_dependencies_at_that_time(board: PegBoard) -> None:
    pin(board, START, at=1.5)
    assert chain(board.explain(START))[1:] == [("b:clap:stroke", 2.0), ("anticipators:partner:hit", 2.0)]
    predict(board, 2.4, at=1.6)
    start = board.explain(START)
    assert chain(start) == [("b:clap:start", 1.5), ("b:clap:stroke", 2.0)]
    assert (start.state, start.rule, start.sources[0].state) == ("pinned", "b:clap:stroke -0.5 s", "past")
    assert stamp_of(start.sources[0]).time == 0.4, "the commit that set it then, not the last one"
    assert chain(board.explain(END)) == [("b:clap:end", 2.9), ("b:clap:stroke", 2.4), ("anticipators:partner:hit", 2.4)]


def test_a_source_that_returned_to_its_time_has_the_commit_that_determined_the_point(board: PegBoard) -> None:
    pin(board, START, at=1.5)
    for time in (2.4, 2.0):
        predict(board, time, at=1.6)
    assert stamp_of(board.explain(START).sources[0]).time == 0.4


def test_a_fired_point_does_not_keep_its_former_dependencies_alive(board: PegBoard) -> None:
    with board.graph.transaction("plan c"):
        peg = OffsetPeg(
            board.graph, "c:x:start", OffsetPeg(board.graph, "b:clap:gone", peg_of(board, STROKE), 0.0), 1.0
        )
        board.add(PegKey("alice", "c", "x", "start"), peg)
        peg.pin(GlobalTime(3.0))
        peg_of(board, STROKE).dependents.clear()
    assert peg.links[0].peg() is None
    gone = board.explain(PegKey("alice", "c", "x", "start")).sources[0]
    assert (gone.name, gone.time, gone.state) == ("b:clap:gone", 2.0, "past")


def test_all_points_of_a_block_are_explained_also_when_it_has_ended(board: PegBoard) -> None:
    predict(board, 3.0, at=1.0)
    with board.graph.transaction("end b"):
        board.pin_block(BLOCK)
    told = json.loads(json.dumps(dict(board.explain_block(BLOCK))))
    board.remove_block(BLOCK)
    assert list(told) == ["b:clap:stroke", "b:clap:start", "b:clap:end"]
    assert told["b:clap:start"] == {
        "name": "b:clap:start",
        "kind": "offset",
        "time": 2.5,
        "state": "pinned",
        "rule": "b:clap:stroke -0.5 s",
        "tie": None,
        "commit": {"sequence": 3, "cause": "partner predicts hit", "time": 1.0},
        "sources": [told["b:clap:stroke"]],
    }
    assert told["b:clap:stroke"]["tie"] == "clap:stroke = anticipators:partner:hit"
    assert told["b:clap:stroke"]["sources"][0]["name"] == "anticipators:partner:hit"
    assert not list(board.explain_block(BLOCK))


def explain(board: PegBoard, peg: TimePeg) -> Explanation:
    key = PegKey("alice", "c", "x", "start")
    board.add(key, peg)
    return board.explain(key)


def sources(board: PegBoard, peg: TimePeg) -> list[str]:
    return [source.name for source in explain(board, peg).sources]


def test_only_the_dependency_that_determines_the_time_is_explained(board: PegBoard) -> None:
    times = (("low", 1.0), ("high", 4.0), ("as high", 4.0))
    low, high, as_high = (AnticipatorPeg(board.graph, name, GlobalTime(time)) for name, time in times)
    assert sources(board, LatestPeg(board.graph, "latest", GlobalTime(0.0), (low, high, as_high))) == ["high"]
    assert sources(board, LatestPeg(board.graph, "latest", GlobalTime(9.0), (low, high))) == []
    assert sources(board, AfterPeg(board.graph, "after", low, [(high, -1.0)])) == ["high"]
    assert sources(board, AfterPeg(board.graph, "after", high, [(low, -1.0)])) == ["high"]
    assert sources(board, BeforePeg(board.graph, "before", high, [(low, 1.0)])) == ["low"]
    assert sources(board, RatioPeg(board.graph, "ratio", low, high, 0.5)) == ["low", "high"]


def test_only_the_unknown_dependencies_of_an_unknown_time_are_explained(board: PegBoard) -> None:
    known, unknown = AnticipatorPeg(board.graph, "known", GlobalTime(1.0)), AnticipatorPeg(board.graph, "unknown", None)
    assert sources(board, LatestPeg(board.graph, "latest", GlobalTime(0.0), (known, unknown))) == ["unknown"]
    assert sources(board, AfterPeg(board.graph, "after", known, [(unknown, 0.0)])) == ["unknown"]


def test_a_peg_that_occurs_twice_is_explained_once(board: PegBoard) -> None:
    peg = peg_of(board, STROKE)
    for level in range(40):
        left, right = (OffsetPeg(board.graph, f"{side}{level}", peg, 0.0) for side in ("left", "right"))
        peg = RatioPeg(board.graph, f"middle{level}", left, right, 0.5)
    last = explain(board, peg).sources[1]
    assert last.sources[0].name == "middle38"
    assert last.sources[0].sources == ()
    assert last.sources[0].rule.endswith(" ...")


def test_a_long_chain_is_explained_to_a_limited_depth(board: PegBoard) -> None:
    peg = peg_of(board, STROKE)
    for number in range(2000):
        peg = OffsetPeg(board.graph, f"p{number}", peg, 0.0)
    explanation = explain(board, peg)
    assert len(chain(explanation)) == 65
    assert json.dumps(explanation.as_json())


def test_the_name_of_an_unknown_point_is_reported(board: PegBoard) -> None:
    with pytest.raises(RealizerError, match=r"^there is no point b:clap:relax$"):
        board.explain(PegKey(*BLOCK, "clap", "relax"))
