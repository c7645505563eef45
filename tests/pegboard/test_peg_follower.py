"""A follower is told of the moves of the pegs that it follows."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.peg_follower import PegFollower
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.reactive.graph import Change, Graph


class Told(PegFollower):
    def __init__(self) -> None:
        super().__init__()
        self.moves: list[tuple[str, float, float]] = []

    def notify(self, change: Change) -> None:
        self.moves.append((change.cell.name, change.old, change.new))

    def take(self) -> list[tuple[str, float, float]]:
        moves, self.moves = self.moves, []
        return moves


def test_it_is_told_of_each_of_its_pegs_that_moves_until_it_follows_others() -> None:
    graph = Graph()
    one, two = (AnticipatorPeg(graph, name, GlobalTime(1.0)) for name in ("one", "two"))

    def move(*pegs: AnticipatorPeg, time: float) -> None:
        with graph.transaction("move"):
            for peg in pegs:
                peg.set(GlobalTime(time))

    first, second = Told(), Told()
    first.follow([one, one])
    second.follow([one, two])
    move(one, time=2.0)
    assert first.take() == second.take() == [("one", 1.0, 2.0)]
    second.follow([two])
    move(one, two, time=3.0)
    assert (first.take(), second.take()) == ([("one", 2.0, 3.0)], [("two", 1.0, 3.0)])
    first.follow([])
    move(one, time=4.0)
    assert (first.take(), len(one.observers), len(two.observers)) == ([], 0, 1)
