"""A derived peg is moved by the source it hangs on, or it is said why it cannot be."""

import pytest

from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AfterPeg, BeforePeg, BMLBlockPeg, LatestPeg, OffsetPeg, RatioPeg
from reactive_realizer.reactive.graph import Graph

KEY = PegKey("alice", "b", "h", "start")


@pytest.fixture
def board() -> PegBoard:
    return PegBoard(Graph())


@pytest.fixture
def hit(board):
    return predicted(board, "hit", 2.0)


def predicted(board, sync, time):
    peg = board.predicted("told", sync)
    with board.graph.transaction("predict"):
        peg.set(time)
    return peg


def offset(board, link, distance):
    return OffsetPeg(board.graph, f"{link.name} {distance:+g}", link, distance)


def move(board, peg, time):
    board.add(KEY, peg)
    with board.graph.transaction("move"):
        return board.move(KEY, time)


def refusal(board, peg, time):
    before = peg.value
    with pytest.raises(RealizerError) as refused:
        move(board, peg, time)
    assert peg.value == before
    return str(refused.value)


def test_a_chain_of_offsets_is_moved_by_the_predicted_point_at_its_end(board, hit) -> None:
    peg = offset(board, offset(board, hit, -0.5), 1.0)
    assert move(board, peg, 4.0) is hit
    assert (hit.value, peg.value) == (3.5, 4.0)


def test_a_predicted_point_is_moved_itself(board, hit) -> None:
    assert move(board, hit, 5.0) is hit
    assert hit.value == 5.0


def test_a_point_of_a_block_is_moved_by_putting_its_block_off(board, hit) -> None:
    start = BMLBlockPeg(board.graph, "b:start", 0.0, (hit,))
    peg = offset(board, start, 1.0)
    assert move(board, peg, 7.0) is start
    assert (start.value, peg.value, hit.value) == (6.0, 7.0, 2.0)


def test_a_block_does_not_start_before_what_it_waits_for(board, hit) -> None:
    start = BMLBlockPeg(board.graph, "b:start", 0.0, (hit,))
    assert refusal(board, start, 1.5) == "b:start does not come to 1.5 s by b:start: it would be at 2 s"
    assert start.floor == 0.0


def test_a_clamped_peg_is_moved_as_far_as_its_bounds_let_it(board, hit) -> None:
    bound = predicted(board, "bound", 3.0)
    after = AfterPeg(board.graph, "after", hit, [(bound, 0.0)])
    assert move(board, after, 3.5) is hit
    assert refusal(board, after, 2.5).endswith("does not come to 2.5 s by anticipators:told:hit: it would be at 3 s")
    before = BeforePeg(board.graph, "before", hit, [(bound, 1.0)])
    assert move(board, before, 1.0) is hit
    assert refusal(board, before, 5.0).endswith("it would be at 4 s")
    assert hit.value == 1.0


def test_a_peg_that_waits_for_an_unknown_bound_cannot_be_moved(board, hit) -> None:
    after = AfterPeg(board.graph, "after", hit, [(board.predicted("told", "unknown"), 0.0)])
    assert refusal(board, after, 3.0).endswith("it would be at an unknown time")


def test_a_peg_on_several_points_names_them(board, hit) -> None:
    other = predicted(board, "other", 4.0)
    between = RatioPeg(board.graph, "b:h:stroke", hit, other, 0.5)
    assert refusal(board, between, 3.5) == (
        "b:h:stroke is moved by several points together: "
        "0.5 of the way anticipators:told:hit .. anticipators:told:other"
    )
    latest = LatestPeg(board.graph, "b:end", 0.0, (hit, other))
    assert "b:end is moved by several points together: latest of 0 s" in refusal(board, latest, 5.0)


def test_a_pinned_peg_stays(board, hit) -> None:
    peg = offset(board, hit, 1.0)
    peg.name = "b:h:start"
    with board.graph.transaction("reach"):
        peg.pin(3.0)
    assert refusal(board, peg, 5.0) == "b:h:start stays at 3 s: it has been reached, or hangs on nothing"
    assert "stays at 3 s" in refusal(board, offset(board, peg, 1.0), 9.0)


def test_a_point_that_is_not_there_is_named(board) -> None:
    with board.graph.transaction("move"), pytest.raises(RealizerError, match=r"^there is no point b:h:start$"):
        board.move(KEY, 1.0)
