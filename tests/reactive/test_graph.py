"""Cells change together: once each, in order, and nobody ever sees half of it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.errors import (
    PropagationCycleError,
    WriteDuringCommitError,
    WriteOutsideTransactionError,
)
from reactive_realizer.reactive.graph import Graph


class Trace:
    """Makes cells that note when they are computed."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.computed: list[str] = []
        self.commits: list = []
        self.graph.listen(self.commits.append)

    def source(self, name, value=0):
        return Source(self.graph, name, value)

    def derived(self, name, *cells, formula=lambda *values: sum(values)):
        def noted(*values):
            self.computed.append(name)
            return formula(*values)

        return Derived(self.graph, name, cells, noted)

    def write(self, cell, *values):
        self.computed.clear()
        with self.graph.transaction("test"):
            for value in values:
                cell.set(value)

    def changed(self):
        return [change.cell.name for change in self.commits[-1].changes]


@pytest.fixture
def trace() -> Trace:
    return Trace()


def test_each_cell_of_a_diamond_is_computed_once_a_commit(trace) -> None:
    top = trace.source("top")
    left, right = trace.derived("left", top), trace.derived("right", top)
    bottom = trace.derived("bottom", left, right)
    trace.write(top, 3)
    assert trace.computed == ["left", "right", "bottom"]
    assert bottom.value == 6
    assert trace.changed() == ["top", "left", "right", "bottom"]


def test_a_jagged_diamond_waits_for_its_longest_side(trace) -> None:
    top = trace.source("top")
    first = trace.derived("first", top)
    second = trace.derived("second", first)
    bottom = trace.derived("bottom", top, second)
    trace.write(top, 1)
    assert trace.computed == ["first", "second", "bottom"]
    assert bottom.value == 2


def test_many_writes_in_a_transaction_are_one_commit(trace) -> None:
    top = trace.source("top")
    trace.derived("below", top)
    trace.write(top, 1, 2, 3)
    assert trace.computed == ["below"]
    assert [(c.old, c.new) for c in trace.commits[-1].changes] == [(0, 3), (0, 3)]
    assert len(trace.commits) == 1


def test_nothing_is_computed_beyond_a_cell_that_keeps_its_value(trace) -> None:
    top = trace.source("top", 1)
    sign = trace.derived("sign", top, formula=lambda value: value > 0)
    trace.derived("below", sign)
    trace.write(top, 2)
    assert trace.computed == ["sign"]
    assert trace.changed() == ["top"]


def test_there_and_back_again_tells_nobody(trace) -> None:
    top = trace.source("top", 1)
    told = []
    top.observe(told.append)
    trace.derived("below", top).observe(told.append)
    trace.write(top, 2, 1)
    assert told == []
    assert trace.commits == []


def test_even_where_what_lies_between_was_read(trace) -> None:
    top = trace.source("top", 1)
    below = trace.derived("below", top)
    with trace.graph.transaction("test"):
        top.set(2)
        assert below.value == 2
        top.set(1)
    assert trace.commits == []


def test_a_read_inside_a_transaction_is_never_stale(trace) -> None:
    top = trace.source("top")
    below = trace.derived("below", trace.derived("between", top))
    with trace.graph.transaction("test"):
        top.set(5)
        assert below.value == 5
        made = trace.derived("made", top, below)
        assert made.value == 10
        top.set(6)
        assert (below.value, made.value) == (6, 12)


def test_a_transaction_within_a_transaction_joins_it(trace) -> None:
    top = trace.source("top")
    with trace.graph.transaction("outer"):
        with trace.graph.transaction("inner"):
            top.set(1)
        assert trace.commits == []
        top.set(2)
    assert [commit.cause for commit in trace.commits] == ["outer"]


def test_observers_are_told_after_the_commit_and_see_all_of_it(trace) -> None:
    one, two = trace.source("one"), trace.source("two")
    total = trace.derived("total", one, two)
    told = []
    one.observe(lambda value: told.append((value, two.value, total.value)))
    with trace.graph.transaction("test"):
        one.set(1)
        assert told == []
        two.set(2)
    assert told == [(1, 2, 3)]


def test_an_observer_may_not_write(trace) -> None:
    top, other = trace.source("top"), trace.source("other")

    def write(value):
        with trace.graph.transaction("from an observer"):
            other.set(value)

    top.observe(write)
    with pytest.raises(WriteDuringCommitError, match="from an observer"):
        trace.write(top, 1)
    assert other.value == 0


def test_a_write_wants_a_transaction(trace) -> None:
    with pytest.raises(WriteOutsideTransactionError, match="top"):
        trace.source("top").set(1)


def test_an_observer_disposed_of_while_others_are_told_is_told_no_more(trace) -> None:
    top = trace.source("top")
    told = []
    top.observe(lambda value: second.dispose())
    second = top.observe(told.append)
    trace.write(top, 1)
    assert told == []
    second.dispose()


def test_an_observer_that_disposes_of_itself_was_told_once(trace) -> None:
    top = trace.source("top")
    told = []
    subscription = top.observe(lambda value: (told.append(value), subscription.dispose()))
    trace.write(top, 1)
    trace.write(top, 2)
    assert told == [1]


def test_a_cycle_is_refused_with_its_path_and_changes_nothing(trace) -> None:
    top = trace.source("top", 1)
    first = trace.derived("first", top)
    second = trace.derived("second", first)
    third = trace.derived("third", second)
    with trace.graph.transaction("test"), pytest.raises(PropagationCycleError) as refused:
        first.rebind((third,), lambda value: value)
    assert refused.value.path == ("first", "second", "third", "first")
    assert first.dependencies == (top,)
    trace.write(top, 2)
    assert (first.value, third.value) == (2, 2)


def test_a_cell_may_not_depend_on_itself(trace) -> None:
    cell = trace.derived("cell", trace.source("top"))
    with trace.graph.transaction("test"), pytest.raises(PropagationCycleError) as refused:
        cell.rebind((cell,), lambda value: value)
    assert refused.value.path == ("cell", "cell")


def test_a_cell_that_hangs_on_others_now_follows_them_in_order(trace) -> None:
    top, other = trace.source("top", 1), trace.source("other", 1)
    low = trace.derived("low", top)
    high = trace.derived("high", trace.derived("between", other))
    with trace.graph.transaction("test"):
        low.rebind((high,), lambda value: value)
    trace.write(other, 7)
    assert trace.computed == ["between", "high"]
    assert low.value == 7
    trace.write(top, 9)
    assert low.value == 7


def test_a_pinned_cell_keeps_its_value_and_still_moves_what_hangs_on_it(trace) -> None:
    top = trace.source("top", 1)
    cell = trace.derived("cell", top)
    below = trace.derived("below", cell)
    with trace.graph.transaction("test"):
        top.set(2)
        cell.pin(5)
    assert (cell.value, below.value) == (5, 5)
    trace.write(top, 3)
    assert (cell.value, below.value) == (5, 5)
    assert top.dependents == {}


def test_a_body_that_raises_leaves_a_graph_that_works(trace) -> None:
    top = trace.source("top")
    below = trace.derived("below", top)

    def write_and_fail():
        with trace.graph.transaction("test"):
            top.set(1)
            raise KeyError

    with pytest.raises(KeyError):
        write_and_fail()
    assert below.value == 1
    trace.write(top, 2)
    assert below.value == 2


def test_a_chain_of_100_000_cells_is_no_matter_of_recursion(trace) -> None:
    top = cell = trace.source("top")
    for _ in range(100_000):
        cell = Derived(trace.graph, "link", (cell,), lambda value: value + 1)
    trace.write(top, 1)
    assert cell.value == 100_001
    before = trace.source("before", 10)
    link = next(iter(top.dependents))
    with trace.graph.transaction("lengthen at the front"):
        link.rebind((trace.derived("new", before),), lambda value: value + 1)
    assert cell.value == 100_010


@st.composite
def graphs(draw):
    """Sources, then cells that each depend on some before them, and writes."""
    sources = draw(st.integers(1, 4))
    cells = draw(st.lists(st.lists(st.integers(0, 1000), min_size=1, max_size=4), min_size=1, max_size=25))
    dependencies = [[index % (sources + i) for index in own] for i, own in enumerate(cells)]
    writes = st.tuples(st.integers(0, sources - 1), st.integers(-3, 3))
    return sources, dependencies, draw(st.lists(st.lists(writes, max_size=4), min_size=1, max_size=6))


@given(graphs())
def test_whatever_the_graph_it_is_as_if_everything_were_computed_anew(drawn) -> None:
    sources, dependencies, transactions = drawn
    trace = Trace()
    formula = lambda *values: sum(values) // 2  # noqa: E731 - loses information, so that the cut-off is met
    cells = [trace.source(f"s{i}") for i in range(sources)]
    for i, own in enumerate(dependencies):
        cells.append(trace.derived(f"d{i}", *(cells[index] for index in own), formula=formula))
    expected = [0] * len(cells)
    for writes in transactions:
        before = list(expected)
        trace.computed.clear()
        trace.commits.clear()
        with trace.graph.transaction("writes"):
            for index, value in writes:
                cells[index].set(value)
                expected[index] = value
        for i, own in enumerate(dependencies):
            expected[sources + i] = formula(*(expected[index] for index in own))
        assert [cell.value for cell in cells] == expected
        assert len(trace.computed) == len(set(trace.computed)), "a cell was computed twice"
        changed = {change.cell for commit in trace.commits for change in commit.changes}
        assert changed == {cell for cell, old, new in zip(cells, before, expected, strict=True) if old != new}
