"""A cell that is disposed of keeps its value and has no references to or from the graph."""

import gc
from functools import partial

import pytest

from reactive_realizer.reactive.cell import Derived
from reactive_realizer.reactive.errors import DisposedCellError

from .conftest import Trace


def test_a_disposed_cell_keeps_its_value(trace: Trace) -> None:
    top = trace.source("top", 1)
    cell = trace.derived("cell", top)
    cell.dispose()
    trace.write(top, 2)
    assert cell.value == 1
    assert top.dependents == {}
    assert cell.disposed


def test_dependents_of_a_disposed_cell_go_on_with_its_value(trace: Trace) -> None:
    one, two = trace.source("one", 1), trace.source("two", 10)
    both = trace.derived("both", one, two)
    one.dispose()
    trace.write(two, 20)
    assert both.value == 21


def test_observers_of_a_disposed_cell_are_notified_of_its_end_only(trace: Trace) -> None:
    top = trace.source("top")
    cell = trace.derived("cell", top)
    told: list[object] = []
    subscription = cell.observe(told.append, lambda: told.append("ended"))
    cell.dispose()
    trace.write(top, 1)
    subscription.dispose()
    cell.dispose()
    assert told == ["ended"]


def test_a_cell_disposed_of_in_a_transaction_keeps_what_was_written_before(trace: Trace) -> None:
    top = trace.source("top", 1)
    cell = trace.derived("cell", top)
    below = trace.derived("below", cell)
    with trace.graph.transaction("test"):
        top.set(2)
        cell.dispose()
        top.set(3)
    assert (cell.value, below.value) == (2, 2)
    assert trace.changed() == ["top", "cell", "below"]


def test_an_observer_may_dispose_of_cells_whose_observers_come_later(trace: Trace) -> None:
    top = trace.source("top")
    cells = [trace.derived(f"c{i}", top) for i in range(3)]
    told: list[object] = []

    def note(name: str, value: object) -> None:
        told.append(name)

    cells[0].observe(lambda value: cells[1].dispose())
    for cell in cells:
        cell.observe(partial(note, cell.name))
    trace.write(top, 1)
    assert told == ["c0", "c2"]
    trace.write(top, 2)
    assert [cell.value for cell in cells] == [2, 1, 2]


@pytest.mark.parametrize("write", ["set", "pin", "rebind"])
def test_a_disposed_cell_cannot_be_written(trace: Trace, write: str) -> None:
    top = trace.source("top", 1)
    cell = trace.derived("cell", top)
    top.dispose()
    cell.dispose()
    act = {"set": lambda: top.set(5), "pin": lambda: cell.pin(5), "rebind": lambda: cell.rebind((top,), cell.formula)}
    with trace.graph.transaction("test"), pytest.raises(DisposedCellError):
        act[write]()
    assert (top.value, cell.value, top.dependents) == (1, 1, {})


def test_a_disposed_cell_is_freed(trace: Trace) -> None:
    top = trace.source("top")

    def make_and_dispose() -> None:
        trace.write(top, top.value + 1)
        with trace.graph.transaction("made"):
            cell = Derived(trace.graph, "cell", (top,), lambda value: value)
        cell.observe(lambda value: None)
        trace.write(top, top.value + 1)
        cell.dispose()

    for _ in range(1000):
        make_and_dispose()
    trace.commits.clear()
    gc.collect()
    assert not [thing for thing in gc.get_objects() if isinstance(thing, Derived) and thing.graph is trace.graph]
