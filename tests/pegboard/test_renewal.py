"""Recurring points: the name refers to the next occurrence, and dependents keep the one they had."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.reactive.graph import Graph


def anticipator() -> tuple[PegBoard, Anticipator]:
    board = PegBoard(Graph())
    return board, Anticipator("key", board)


def predict(board: PegBoard, key: Anticipator, time: float | None, now: float = 0.0) -> None:
    with board.graph.transaction("test"):
        key.predict("press", None if time is None else GlobalTime(time), GlobalTime(now))


def test_dependents_of_a_renewed_point_keep_the_old_peg() -> None:
    board, key = anticipator()
    early = OffsetPeg(board.graph, "early", board.predicted("key", "press"), 0.5)
    predict(board, key, 2.0)
    key.renew("press")
    late = OffsetPeg(board.graph, "late", board.predicted("key", "press"), 0.5)
    assert (early.value, late.value) == (2.5, None)
    predict(board, key, 7.0)
    assert (early.value, late.value) == (2.5, 7.5)


def test_a_renewed_point_keeps_its_owner() -> None:
    board, key = anticipator()
    old = board.predicted("key", "press")
    owner = board.owner(old)
    key.renew("press")
    assert board.owner(board.predicted("key", "press")) == owner
    assert board.owner(old) is None


def test_points_that_passed_are_not_revised() -> None:
    times = {"one": GlobalTime(1.0), "two": GlobalTime(2.0)}

    class Listed(Anticipator):
        def forecast(self, sync: str) -> GlobalTime | None:
            return times.get(sync)

    board = PegBoard(Graph())
    key = Listed("key", board)
    assert [board.predicted("key", sync).value for sync in times] == [1.0, 2.0]
    times |= {"one": GlobalTime(8.0), "two": GlobalTime(9.0)}
    with board.graph.transaction("test"):
        key.revise(GlobalTime(1.5))
    assert [board.predicted("key", sync).value for sync in times] == [1.0, 9.0]


def test_an_anticipator_is_asked_for_a_renewed_point() -> None:
    board, key = anticipator()
    times = iter([GlobalTime(1.0), GlobalTime(2.0)])
    board.ask("key", lambda sync: next(times))
    assert board.predicted("key", "press").value == 1.0
    key.renew("press")
    assert board.predicted("key", "press").value == 2.0


def test_a_point_that_was_never_named_needs_no_renewal() -> None:
    board, key = anticipator()
    key.renew("press")
    assert board.snapshot() == ()


def test_renewing_leaves_nothing_behind() -> None:
    board, key = anticipator()
    for number in range(100):
        predict(board, key, float(number), float(number))
        key.renew("press")
    assert [str(view.key) for view in board.snapshot()] == ["anticipators:key:press"]
    block = BlockKey("alice", "b")
    board.add(PegKey(*block, "h", "start"), OffsetPeg(board.graph, "h", board.predicted("key", "press"), 0.0))
    with board.graph.transaction("test"):
        board.pin_block(block)
    board.remove_block(block)
    assert board.snapshot() == ()


def test_the_predictions_of_all_points_are_withdrawn() -> None:
    board, key = anticipator()
    predict(board, key, 2.0)
    other = Anticipator("other", board)
    with board.graph.transaction("test"):
        other.predict("press", GlobalTime(2.0), GlobalTime(0.0))
        key.withdraw(GlobalTime(1.0))
    assert board.predicted("key", "press").value is None
    assert board.predicted("other", "press").value == 2.0
