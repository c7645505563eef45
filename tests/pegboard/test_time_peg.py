"""Pegs follow what they hang on (thesis 7.3.2, 7.3.3)."""

import pytest

from reactive_realizer.pegboard.time_peg import (
    AnticipatorPeg,
    BMLBlockPeg,
    LatestPeg,
    OffsetPeg,
    RatioPeg,
    followers_of,
    unknown_sources,
)
from reactive_realizer.reactive.graph import Graph


@pytest.fixture
def graph() -> Graph:
    return Graph()


def write(peg, time):
    with peg.graph.transaction("test"):
        peg.set(time)


def pin(peg, time):
    with peg.graph.transaction("test"):
        peg.pin(time)


def test_an_offset_peg_keeps_its_distance(graph) -> None:
    hit = AnticipatorPeg(graph, "hit", 2.0)
    peg = OffsetPeg(graph, "start", hit, -0.5)
    assert peg.value == 1.5
    write(hit, 3.0)
    assert peg.value == 2.5
    assert peg.describe() == "hit -0.5 s"


def test_a_ratio_peg_keeps_its_part_of_the_way(graph) -> None:
    start, end = AnticipatorPeg(graph, "start", 1.0), AnticipatorPeg(graph, "end", 3.0)
    stroke = RatioPeg(graph, "stroke", start, end, 0.25)
    assert stroke.value == 1.5
    write(end, 5.0)
    assert stroke.value == 2.0
    assert stroke.describe() == "0.25 of the way start .. end"


@pytest.mark.parametrize("unknown", ["start", "end"])
def test_what_hangs_on_the_unknown_is_unknown_and_comes_back(graph, unknown) -> None:
    pegs = {name: AnticipatorPeg(graph, name, 1.0) for name in ("start", "end")}
    between = RatioPeg(graph, "between", pegs["start"], pegs["end"], 0.5)
    after = OffsetPeg(graph, "after", between, 1.0)
    latest = LatestPeg(graph, "latest", 0.0, (after, pegs["end"]))
    write(pegs[unknown], None)
    assert (between.value, after.value, latest.value) == (None, None, None)
    assert unknown_sources([latest]) == [unknown]
    write(pegs[unknown], 1.0)
    assert (between.value, after.value, latest.value) == (1.0, 2.0, 2.0)
    assert unknown_sources([latest]) == []


def test_a_block_is_predicted_for_the_latest_of_what_it_waits_for_and_not_before_its_floor(graph) -> None:
    one, two = AnticipatorPeg(graph, "one", 1.0), AnticipatorPeg(graph, "two", 2.0)
    block = BMLBlockPeg(graph, "b:start", 1.5, (one, two))
    assert block.value == 2.0
    write(two, 0.5)
    assert block.value == 1.5
    with graph.transaction("test"):
        block.wait_for(0.2, (one,))
    assert block.value == 1.0
    assert block.describe() == "latest of 0.2 s, one"
    assert two.dependents == {}


def test_a_pinned_peg_is_cut_from_its_source_and_the_rest_goes_on(graph) -> None:
    hit = AnticipatorPeg(graph, "hit", 2.0)
    start, end = OffsetPeg(graph, "start", hit, -1.0), OffsetPeg(graph, "end", hit, 1.0)
    between = RatioPeg(graph, "between", start, end, 0.5)
    pin(start, 1.0)
    write(hit, 4.0)
    assert (start.value, between.value, end.value) == (1.0, 3.0, 5.0)
    assert start.pinned
    assert not between.pinned
    assert start.describe() == "pinned"


def test_a_peg_of_its_own_leaves_the_shared_one_where_it_was(graph) -> None:
    shared = OffsetPeg(graph, "shared", AnticipatorPeg(graph, "hit", 2.0), 0.0)
    with graph.transaction("test"):
        own = shared.apart("own", 0.7)
    assert (own.value, own.pinned, shared.value, shared.dependents) == (0.7, True, 2.0, {})


def test_what_moves_with_a_peg_ends_at_starts_and_ends_of_blocks(graph) -> None:
    hit = AnticipatorPeg(graph, "hit", 2.0)
    near = OffsetPeg(graph, "near", hit, 0.0)
    far = OffsetPeg(graph, "far", near, 0.0)
    OffsetPeg(graph, "of the next block", LatestPeg(graph, "end", 0.0, (far,)), 0.0)
    assert followers_of(hit) == {near, far}
