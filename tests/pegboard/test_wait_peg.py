"""The end of a wait follows the awaited point, between the start of the wait and its limit."""

import pytest

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.open_pegs import WaitPeg
from reactive_realizer.pegboard.peg_view import unknown_sources
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.reactive.graph import Graph


@pytest.fixture
def graph() -> Graph:
    return Graph()


def waiting(graph: Graph, start: Time, awaited: Time, limit: float | None, offset: float = 0.0) -> WaitPeg:
    peg = WaitPeg(graph, "b:w:end", offset, limit)
    with graph.transaction("test"):
        peg.follow(AnticipatorPeg(graph, "start", start), AnticipatorPeg(graph, "go", awaited))
    return peg


@pytest.mark.parametrize(
    ("start", "awaited", "limit", "offset", "end"),
    [
        (1, None, None, 0, None),
        (1, None, 2, 0, 3),
        (1, 2, None, 0, 2),
        (1, 2, 2, 0.5, 2.5),
        (1, 9, 2, 0, 3),
        (1, 0, 2, 0, 1),
        (1, 2, 2, -3, 1),
        (1, 2, 0, 0, 1),
        (None, 2, 2, 0, None),
    ],
)
def test_it_is_the_awaited_time_but_not_before_the_start_and_not_after_the_limit(
    graph: Graph, start: Time, awaited: Time, limit: float | None, offset: float, end: Time
) -> None:
    assert waiting(graph, start, awaited, limit, offset).value == end


def test_it_is_unknown_before_it_follows_anything(graph: Graph) -> None:
    peg = WaitPeg(graph, "b:w:end", 0.0, 2.0)
    assert peg.value is None
    assert unknown_sources([peg]) == ["the end of the wait, b:w:end"]


def test_the_unknown_point_that_it_waits_for_is_named(graph: Graph) -> None:
    assert unknown_sources([waiting(graph, GlobalTime(1.0), None, None)]) == ["go"]


def test_a_point_that_depends_on_it_never_comes_for_it(graph: Graph) -> None:
    peg = WaitPeg(graph, "b:w:end", 0.0, 2.0)
    after = OffsetPeg(graph, "after", peg, 1.0)
    with graph.transaction("test"):
        peg.follow(AnticipatorPeg(graph, "start", GlobalTime(1.0)), after)
    assert peg.value == pytest.approx(3)
    assert after.value == pytest.approx(4)


@pytest.mark.parametrize(("awaited", "decides"), [(2.0, "go"), (9.0, "start"), (0.0, "start"), (None, "start")])
def test_an_explanation_names_the_point_that_gives_the_time(graph: Graph, awaited: float | None, decides: str) -> None:
    peg = waiting(graph, GlobalTime(1.0), None if awaited is None else GlobalTime(awaited), 2.0)
    assert [link.name for link in peg.deciding] == [decides]
    assert peg.describe() == "go +0 s, not before start and not after start +2 s"
    assert peg.parameters == {"offset": 0.0, "limit": 2.0}
