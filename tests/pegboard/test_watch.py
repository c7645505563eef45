"""A watch tells which items hang on pegs that have moved."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.pegboard.watch import Watch
from reactive_realizer.reactive.graph import Change, Graph


def test_each_item_of_a_moved_peg_is_told_until_it_follows_others() -> None:
    graph, told = Graph(), list[tuple[str, float, float]]()
    one, two = (AnticipatorPeg(graph, name, GlobalTime(1.0)) for name in ("one", "two"))

    def note(item: str, change: Change) -> None:
        told.append((item, change.old, change.new))

    def move(peg: AnticipatorPeg, time: float) -> list[tuple[str, float, float]]:
        told.clear()
        with graph.transaction("move"):
            peg.set(GlobalTime(time))
        return list(told)

    watch = Watch(note)
    watch.follow("a", [one, one])
    watch.follow("b", [one, two])
    assert move(one, 2.0) == [("a", 1.0, 2.0), ("b", 1.0, 2.0)]
    assert move(two, 2.0) == [("b", 1.0, 2.0)]
    assert watch.following([one, two]) == ["a", "b"]
    watch.follow("b", [two])
    assert move(one, 3.0) == [("a", 2.0, 3.0)]
    watch.forget("a")
    watch.forget("a")
    assert (move(one, 4.0), watch.following([one])) == ([], [])
    assert (len(one.observers), len(two.observers)) == (0, 1)
