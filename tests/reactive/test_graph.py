"""Cells of a transaction change together: once each, in order, and atomically."""

from collections.abc import Collection
from typing import Any

import pytest

from reactive_realizer.reactive.cell import Derived, replace_cell
from reactive_realizer.reactive.errors import (
    PropagationCycleError,
    WriteDuringCommitError,
    WriteOutsideTransactionError,
)
from reactive_realizer.reactive.graph import Cell, Change, Commit

from .conftest import Trace


def test_each_cell_of_a_diamond_is_computed_once_a_commit(trace: Trace) -> None:
    top = trace.source("top")
    left, right = trace.derived("left", top), trace.derived("right", top)
    bottom = trace.derived("bottom", left, right)
    trace.write(top, 3)
    assert trace.computed == ["left", "right", "bottom"]
    assert bottom.value == 6
    assert trace.changed() == ["top", "left", "right", "bottom"]


def test_a_jagged_diamond_waits_for_its_longest_side(trace: Trace) -> None:
    top = trace.source("top")
    first = trace.derived("first", top)
    second = trace.derived("second", first)
    bottom = trace.derived("bottom", top, second)
    trace.write(top, 1)
    assert trace.computed == ["first", "second", "bottom"]
    assert bottom.value == 2


def test_cells_of_one_rank_are_computed_in_order_of_creation(trace: Trace) -> None:
    one, two = trace.source("one"), trace.source("two")
    for name in ("a", "b", "c"):
        trace.derived(name, one if name == "b" else two)
    trace.computed.clear()
    with trace.graph.transaction("test"):
        two.set(1)
        one.set(1)
    assert trace.computed == ["a", "b", "c"]


def test_many_writes_in_a_transaction_are_one_commit(trace: Trace) -> None:
    top = trace.source("top")
    trace.derived("below", top)
    trace.write(top, 1, 2, 3)
    assert trace.computed == ["below"]
    assert [(c.old, c.new) for c in trace.commits[-1].changes] == [(0, 3), (0, 3)]
    assert len(trace.commits) == 1


def test_nothing_is_computed_beyond_a_cell_that_keeps_its_value(trace: Trace) -> None:
    top = trace.source("top", 1)
    sign = trace.derived("sign", top, formula=lambda value: value > 0)
    trace.derived("below", sign)
    trace.write(top, 2)
    assert trace.computed == ["sign"]
    assert trace.changed() == ["top"]


def test_a_value_that_changes_and_returns_notifies_no_observer(trace: Trace) -> None:
    top = trace.source("top", 1)
    told: list[object] = []
    top.observe(lambda change: told.append(change.new))
    trace.derived("below", top).observe(lambda change: told.append(change.new))
    trace.write(top, 2, 1)
    assert told == []
    assert trace.commits == []


def test_a_value_that_returns_is_no_change_even_if_it_was_read_between(trace: Trace) -> None:
    top = trace.source("top", 1)
    below = trace.derived("below", top)
    with trace.graph.transaction("test"):
        top.set(2)
        assert below.value == 2
        top.set(1)
    assert trace.commits == []


def test_an_equal_write_recomputes_nothing(trace: Trace) -> None:
    top = trace.source("top", 1.5)
    trace.derived("below", top)
    for _ in range(100):
        trace.write(top, 1.5)
    assert trace.computed == []
    assert trace.commits == []


def test_each_cell_has_the_stamp_of_the_commit_that_gave_it_its_value(trace: Trace) -> None:
    one, two = trace.source("one"), trace.source("two")
    below = trace.derived("below", one)
    before = below.stamp
    assert before is None
    trace.graph.time = 0.5
    trace.write(one, 1)
    trace.graph.time = 0.7
    trace.write(two, 1)
    assert below.stamp
    assert (below.stamp.sequence, below.stamp.cause, below.stamp.time) == (1, "test", 0.5)
    assert one.stamp is below.stamp
    assert two.stamp
    assert two.stamp.sequence == 2


def test_a_cell_that_is_made_in_a_transaction_has_its_stamp(trace: Trace) -> None:
    top = trace.source("top")
    with trace.graph.transaction("plan"):
        made = trace.derived("made", top)
    assert made.stamp
    assert made.stamp.cause == "plan"
    assert [commit.changes for commit in trace.commits] == [()]


def test_a_read_inside_a_transaction_is_never_stale(trace: Trace) -> None:
    top = trace.source("top")
    below = trace.derived("below", trace.derived("between", top))
    with trace.graph.transaction("test"):
        top.set(5)
        assert below.value == 5
        made = trace.derived("made", top, below)
        assert made.value == 10
        top.set(6)
        assert (below.value, made.value) == (6, 12)


def test_a_new_cell_is_computed_from_settled_values(trace: Trace) -> None:
    top = trace.source("top")
    below = trace.derived("below", trace.derived("between", top))
    with trace.graph.transaction("test"):
        top.set(5)
        trace.computed.clear()
        made = trace.derived("made", below)
    assert trace.computed == ["between", "below", "made"]
    assert made.value == 5


def test_a_transaction_within_a_transaction_joins_it(trace: Trace) -> None:
    top = trace.source("top")
    with trace.graph.transaction("outer"):
        with trace.graph.transaction("inner"):
            top.set(1)
        assert trace.commits == []
        top.set(2)
    assert [commit.stamp.cause for commit in trace.commits] == ["outer"]


def test_observers_are_notified_after_the_commit_and_see_all_of_it(trace: Trace) -> None:
    one, two = trace.source("one"), trace.source("two")
    total = trace.derived("total", one, two)
    told: list[object] = []
    one.observe(lambda change: told.append((change.new, two.value, total.value)))
    with trace.graph.transaction("test"):
        one.set(1)
        assert told == []
        two.set(2)
    assert told == [(1, 2, 3)]


def test_an_observer_may_not_write(trace: Trace, caplog: pytest.LogCaptureFixture) -> None:
    top, other = trace.source("top"), trace.source("other")

    def write(value: object) -> None:
        with (
            pytest.raises(WriteDuringCommitError, match="from an observer"),
            trace.graph.transaction("from an observer"),
        ):
            other.set(value)
        raise RuntimeError("it noticed")

    top.observe(write)
    trace.write(top, 1)
    assert "it noticed" in caplog.text
    assert other.value == 0


def test_an_observer_may_not_write_without_a_transaction_either(trace: Trace, caplog: pytest.LogCaptureFixture) -> None:
    top, other = trace.source("top"), trace.source("other")
    top.observe(other.set)
    trace.write(top, 1)
    assert "WriteOutsideTransactionError: 'other' is written outside a transaction" in caplog.text
    assert other.value == 0


def test_a_listener_may_not_write_either(trace: Trace, caplog: pytest.LogCaptureFixture) -> None:
    top, other = trace.source("top"), trace.source("other")
    trace.graph.listen(lambda commit: trace.write(other, 1))
    trace.write(top, 1)
    assert "WriteDuringCommitError: 'test' writes during a commit" in caplog.text
    assert other.value == 0
    trace.graph._listeners.pop()
    trace.write(other, 2)
    assert other.value == 2


def test_other_observers_are_notified_when_one_raises(trace: Trace, caplog: pytest.LogCaptureFixture) -> None:
    top = trace.source("top")
    told: list[object] = []

    def fail(value: object) -> None:
        raise IndexError

    def fail_to_listen(commit: Commit) -> None:
        raise KeyError(commit.stamp.cause)

    top.observe(fail)
    top.observe(lambda change: told.append(change.new))
    trace.graph._listeners.insert(0, fail_to_listen)
    trace.write(top, 1)
    assert told == [1]
    assert len(trace.commits) == 1
    assert "IndexError" in caplog.text
    assert "KeyError: 'test'" in caplog.text


def test_a_formula_that_writes_fails(trace: Trace, caplog: pytest.LogCaptureFixture) -> None:
    top, other = trace.source("top"), trace.source("other")
    cell = trace.derived("cell", top, formula=lambda value: other.set(value) if value else 0)
    trace.write(top, 1)
    assert "WriteOutsideTransactionError" in cell.result.reason
    assert other.value == 0


def test_a_write_requires_a_transaction(trace: Trace) -> None:
    with pytest.raises(WriteOutsideTransactionError, match="top"):
        trace.source("top").set(1)


def test_an_observer_disposed_of_by_another_one_is_not_notified(trace: Trace) -> None:
    top = trace.source("top")
    told: list[object] = []
    top.observe(lambda value: second.dispose())
    second = top.observe(lambda change: told.append(change.new))
    trace.write(top, 1)
    assert told == []
    second.dispose()


def test_an_observer_that_disposes_of_itself_is_notified_once(trace: Trace) -> None:
    top = trace.source("top")
    told: list[object] = []

    def observe(change: Change) -> None:
        told.append(change.new)
        subscription.dispose()

    subscription = top.observe(observe)
    trace.write(top, 1)
    trace.write(top, 2)
    assert told == [1]


def test_a_cycle_is_refused_with_its_path_and_changes_nothing(trace: Trace) -> None:
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


def test_a_cell_may_not_depend_on_itself(trace: Trace) -> None:
    cell = trace.derived("cell", trace.source("top"))
    with trace.graph.transaction("test"), pytest.raises(PropagationCycleError) as refused:
        cell.rebind((cell,), lambda value: value)
    assert refused.value.path == ("cell", "cell")


def test_a_rebound_cell_is_computed_after_its_new_dependencies(trace: Trace) -> None:
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


def test_a_pinned_cell_keeps_its_value_and_updates_its_dependents(trace: Trace) -> None:
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


def test_a_cell_that_was_touched_and_then_pinned_is_not_computed(trace: Trace) -> None:
    top = trace.source("top", 1)
    cell = trace.derived("cell", top)
    trace.computed.clear()
    with trace.graph.transaction("test"):
        top.set(2)
        cell.pin(1)
    assert trace.computed == []
    assert cell.value == 1


def test_a_cell_that_is_rebound_twice_is_computed_once(trace: Trace) -> None:
    one, two = trace.source("one", 1), trace.source("two", 2)
    cell = trace.derived("cell", one)
    trace.derived("below", cell)
    formula = cell.formula
    trace.computed.clear()
    with trace.graph.transaction("test"):
        cell.rebind((two,), formula)
        cell.rebind((one, two), formula)
        one.set(5)
    assert trace.computed == ["cell", "below"]
    assert cell.value == 7


def test_a_cell_may_be_rebound_to_no_dependencies(trace: Trace) -> None:
    cell = trace.derived("cell", trace.source("top", 1))
    with trace.graph.transaction("test"):
        cell.rebind((), lambda: 9)
    assert cell.value == 9


def test_replacing_a_cell_moves_its_dependents_to_the_other(trace: Trace) -> None:
    old, new, other = trace.source("old", 1), trace.source("new", 2), trace.source("other", 10)
    first, both = trace.derived("first", old), trace.derived("both", old, other)
    last = trace.derived("last", first, both)
    trace.computed.clear()
    with trace.graph.transaction("test"):
        replace_cell(old, new)
    assert trace.computed == ["first", "both", "last"]
    assert (first.value, both.value, last.value) == (2, 12, 14)
    assert both.dependencies == (new, other)
    assert old.dependents == {}
    trace.write(new, 5)
    assert last.value == 20


def test_a_cell_cannot_be_replaced_by_its_dependent(trace: Trace) -> None:
    old = trace.source("old", 1)
    first = trace.derived("first", old)
    last = trace.derived("last", first)
    with trace.graph.transaction("test"), pytest.raises(PropagationCycleError) as refused:
        replace_cell(old, last)
    assert refused.value.path == ("first", "last", "first")
    trace.write(old, 2)
    assert last.value == 2


def test_a_body_that_raises_leaves_a_graph_that_works(trace: Trace) -> None:
    top = trace.source("top")
    below = trace.derived("below", top)

    def write_and_fail() -> None:
        with trace.graph.transaction("test"):
            top.set(1)
            raise KeyError

    with pytest.raises(KeyError):
        write_and_fail()
    assert below.value == 1
    trace.write(top, 2)
    assert below.value == 2


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
def test_a_chain_of_100_000_cells_needs_no_recursion(trace: Trace) -> None:
    top = trace.source("top")
    cell: Cell[int] = top
    for _ in range(100_000):
        cell = Derived(trace.graph, "link", (cell,), lambda value: value + 1)
    trace.write(top, 1)
    assert cell.value == 100_001
    before = trace.source("before", 10)
    link = next(iter(top.dependents))
    assert isinstance(link, Derived)
    with trace.graph.transaction("lengthen at the front"):
        link.rebind((trace.derived("new", before),), lambda value: value + 1)
    assert cell.value == 100_010


def test_a_rule_writes_within_the_transaction_that_it_checks_and_sees_what_it_changes(trace: Trace) -> None:
    top, limit = trace.source("top"), trace.source("limit", 5)
    below = trace.derived("below", top)
    seen = []

    def keep_below_limit(changed: Collection[Cell[Any]]) -> None:
        if below.value > limit.value:
            top.set(limit.value)
        seen.append([cell.name for cell in changed])

    trace.graph.before_commit(keep_below_limit)
    trace.write(top, 9)
    changes = [(each.cell.name, each.old, each.new) for each in trace.commits[-1].changes]
    assert changes == [("top", 0, 5), ("below", 0, 5)]
    trace.write(top, 5)
    assert seen == [["top", "below"]], "nothing has changed since"


def test_a_rule_that_raises_leaves_a_graph_that_works(trace: Trace) -> None:
    top = trace.source("top")

    def fail(changed: Collection[Cell[Any]]) -> None:
        raise KeyError

    trace.graph.before_commit(fail)
    with pytest.raises(KeyError):
        trace.write(top, 1)
    assert (top.value, len(trace.commits)) == (1, 1)
