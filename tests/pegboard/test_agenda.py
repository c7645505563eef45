"""An agenda reads an item when it enters, and again only when one of its pegs has moved or it is noted."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.agenda import Agenda
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.reactive.graph import Graph


class Stage:
    """An agenda of letters, each due at the time of its peg."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.pegs: dict[str, AnticipatorPeg] = {}
        self.read: list[str] = []
        self.woken = 0
        self.agenda: Agenda[str] = Agenda(self._due, lambda item: [self.pegs[item]], self._wake)

    def add(self, item: str, time: float | None) -> None:
        self.pegs[item] = AnticipatorPeg(self.graph, item, None if time is None else GlobalTime(time))
        self.agenda.add(item)

    def move(self, item: str, time: float | None) -> None:
        with self.graph.transaction("move"):
            self.pegs[item].set(None if time is None else GlobalTime(time))

    def due(self, now: float) -> list[str]:
        return self.agenda.take_due(GlobalTime(now))

    def _due(self, item: str) -> Time:
        self.read.append(item)
        return self.pegs[item].value

    def _wake(self) -> None:
        self.woken += 1


@pytest.fixture
def stage() -> Stage:
    return Stage()


def test_items_are_due_in_order_of_time_until_they_change(stage: Stage) -> None:
    for item, time in (("c", 3.0), ("a", 1.0), ("b", 2.0), ("never", None)):
        stage.add(item, time)
    assert stage.agenda.next_due == 1.0
    assert (stage.due(0.9), stage.due(2.5), stage.due(2.5)) == ([], ["a", "b"], ["a", "b"])
    stage.move("a", 4.0)
    assert stage.due(2.5) == ["b"]
    stage.move("b", None)
    assert stage.due(2.5) == []
    assert stage.agenda.next_due == 3.0


def test_an_item_is_read_only_when_its_peg_has_moved_or_it_is_noted(stage: Stage) -> None:
    stage.add("a", 5.0)
    stage.add("b", None)
    assert (stage.due(1.0), stage.due(2.0), stage.read) == ([], [], ["a", "b"])
    stage.read.clear()
    stage.move("b", 3.0)
    stage.move("b", 4.0)
    assert stage.read == []
    assert stage.due(4.0) == ["b"]
    assert stage.read == ["b"]
    stage.agenda.note("a")
    assert stage.agenda.next_due == 4.0
    assert stage.read == ["b", "b", "a"]


def test_an_item_that_moves_later_is_read_only_when_its_old_time_has_come(stage: Stage) -> None:
    stage.add("a", 5.0)
    stage.add("b", 6.0)
    stage.due(1.0)
    stage.read.clear()
    for time in (7.0, 9.0, None, 8.0):
        stage.move("b", time)
        assert stage.agenda.next_due == 5.0
    assert stage.read == []
    assert stage.due(5.0) == ["a"]
    stage.move("a", None)
    assert stage.due(7.0) == []
    assert stage.read == ["a", "b"]
    assert stage.due(8.0) == ["b"]


def test_an_item_that_moves_earlier_with_the_peg_that_it_is_due_at_is_read_only_when_it_is_due(stage: Stage) -> None:
    stage.add("a", 5.0)
    stage.due(1.0)
    stage.read.clear()
    for time, next_due in ((4.0, 4.0), (3.0, 3.0), (8.0, 3.0), (3.5, 3.0)):
        stage.move("a", time)
        assert stage.agenda.next_due == next_due
    assert stage.read == []
    assert stage.due(3.2) == []
    assert stage.read == ["a"]
    assert stage.due(3.5) == ["a"]


def test_an_item_that_is_due_when_it_is_read_is_not_observed(stage: Stage) -> None:
    stage.add("a", 1.0)
    assert stage.due(1.0) == ["a"]
    assert not stage.pegs["a"].observers
    assert stage.agenda.next_due == 1.0
    assert stage.pegs["a"].observers


def test_it_wakes_for_new_items_and_for_each_move(stage: Stage) -> None:
    stage.add("a", 5.0)
    stage.agenda.take_due(GlobalTime(1.0))
    assert stage.woken == 1
    stage.move("a", 6.0)
    stage.move("a", 7.0)
    assert stage.woken == 3


def test_an_item_that_was_removed_is_not_due_and_not_observed(stage: Stage) -> None:
    stage.add("a", 1.0)
    assert stage.due(1.0) == ["a"]
    stage.agenda.remove("a")
    stage.agenda.remove("a")
    stage.agenda.note("a")
    stage.move("a", 0.5)
    assert (stage.due(2.0), stage.agenda.next_due, stage.woken) == ([], None, 1)
    assert not stage.pegs["a"].observers


def test_an_item_that_cannot_be_read_is_read_again(stage: Stage) -> None:
    stage.add("a", 1.0)
    peg = stage.pegs.pop("a")
    for _ in range(2):
        with pytest.raises(KeyError):
            stage.due(2.0)
    stage.pegs["a"] = peg
    assert stage.due(2.0) == ["a"]


MOVES = st.lists(st.tuples(st.sampled_from("abcd"), st.none() | st.integers(0, 9)), max_size=60)


@given(MOVES, st.integers(0, 9))
def test_whatever_has_moved_the_due_items_are_those_whose_time_has_come(
    moves: list[tuple[str, int | None]], now: int
) -> None:
    stage = Stage()
    for item in "abcd":
        stage.add(item, 5.0)
    for item, time in moves:
        stage.move(item, time)
        stage.due(now / 2)
    times = {item: peg.value for item, peg in stage.pegs.items()}
    known = [time for time in times.values() if time is not None]
    assert not known or (stage.agenda.next_due or 0.0) <= min(known)
    assert sorted(stage.due(now)) == [item for item, time in times.items() if time is not None and time <= now]


def test_moving_an_item_often_does_not_accumulate_memory(stage: Stage) -> None:
    stage.add("a", 100.0)
    for time in range(1000):
        stage.move("a", 100.0 + time)
        stage.due(1.0)
    assert len(stage.agenda._heap) < 100
