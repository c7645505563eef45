"""Errors are values: they propagate to dependents, are recorded, and disappear with the next value."""

from typing import Any

import pytest

from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.errors import CellError, Failure

from .conftest import Trace

Half = tuple[Source[Any], Derived[Any], Derived[Any], Derived[Any]]


@pytest.fixture
def half(trace: Trace) -> Half:
    """10 // top, a cell that depends on it, and a sibling."""
    top = trace.source("top", 2)
    quotient = trace.derived("quotient", top, formula=lambda value: 10 // value)
    return top, quotient, trace.derived("below", quotient), trace.derived("sibling", top)


def test_a_formula_that_raises_fails_its_cell_and_what_depends_on_it_and_nothing_else(trace: Trace, half: Half) -> None:
    top, quotient, below, sibling = half
    trace.write(top, 0)
    assert isinstance(quotient.result, Failure)
    assert below.result == quotient.result
    assert (top.value, sibling.value) == (0, 0)


def test_a_formula_is_not_called_while_a_dependency_has_failed(trace: Trace, half: Half) -> None:
    trace.write(half[0], 0)
    assert trace.computed == ["quotient", "sibling"]


def test_reading_a_failed_cell_raises_with_its_name_and_the_reason(trace: Trace, half: Half) -> None:
    top, quotient, below, _ = half
    trace.write(top, 0)
    with pytest.raises(CellError, match=r"^'quotient' has failed: ZeroDivisionError: .*by zero$"):
        _ = quotient.value
    with pytest.raises(CellError, match=r"^'below' has failed through 'quotient': ZeroDivisionError") as raised:
        _ = below.value
    assert isinstance(raised.value.failure.error, ZeroDivisionError)


def test_a_failed_cell_heals_with_the_next_value_that_can_be_computed(trace: Trace, half: Half) -> None:
    top, quotient, below, _ = half
    trace.write(top, 0)
    trace.write(top, 5)
    assert (quotient.value, below.value) == (2, 2)


def test_a_pin_heals_a_failed_cell(trace: Trace, half: Half) -> None:
    top, quotient, below, _ = half
    trace.write(top, 0)
    with trace.graph.transaction("test"):
        quotient.pin(7)
    assert (quotient.value, below.value) == (7, 7)


def test_the_commit_and_the_observers_see_the_failure(trace: Trace, half: Half) -> None:
    top, quotient, below, _ = half
    told: list[object] = []
    below.observe(lambda change: told.append(change.new))
    trace.write(top, 0)
    changes = {change.cell: (change.old, change.new) for change in trace.commits[-1].changes}
    assert changes[quotient] == (5, quotient.result)
    assert told == [quotient.result]
    trace.write(top, 1)
    assert told[1:] == [10]


def test_a_repeated_failure_is_no_change(trace: Trace) -> None:
    top = trace.source("top", "1")
    number = trace.derived("number", top, formula=lambda text: len(text) // 0)
    told: list[object] = []
    number.observe(lambda change: told.append(change.new))
    trace.write(top, "2")
    assert told == []
    assert trace.changed() == ["top"]


def test_a_cell_may_be_made_on_one_that_has_failed_and_may_fail_from_the_start(
    trace: Trace, half: Half, caplog: pytest.LogCaptureFixture
) -> None:
    top, _, below, _ = half
    trace.write(top, 0)
    later = trace.derived("later", below)
    empty: dict[str, int] = {}
    broken = trace.derived("broken", formula=lambda: empty["no"])
    assert later.result == below.result
    assert broken.result.reason == "KeyError: 'no'"
    assert "the formula of 'broken' raised" in caplog.text


def test_of_two_failures_the_first_in_order_is_passed_on(trace: Trace) -> None:
    one, two = (trace.derived(name, formula=lambda: 1 // 0) for name in ("one", "two"))
    assert trace.derived("both", two, one).result.cell == "two"


def test_a_transaction_in_which_a_formula_raises_is_committed_whole(trace: Trace, half: Half) -> None:
    top, quotient, _, _ = half
    other = trace.source("other")
    with trace.graph.transaction("test"):
        top.set(0)
        assert isinstance(quotient.result, Failure)
        other.set(3)
    assert other.value == 3
    assert len(trace.commits) == 1
