"""Any operations on any graph give the same values as computing everything from scratch."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.reactive.cell import Derived, Source, replace_cell
from reactive_realizer.reactive.errors import DisposedCellError, Failure, PropagationCycleError
from reactive_realizer.reactive.graph import Cell, Commit, Graph

Value = int | str
Action = tuple[str, int, str, int, list[int]]

FORMULAS: dict[str, Callable[..., int]] = {
    "half": lambda *values: sum(values) // 2,  # loses information, so that the cut-off is met
    "most": lambda *values: max(values, default=0),
    "quotient": lambda *values: 6 // sum(values),  # raises at times
}


@dataclass
class Node:
    """A cell of the oracle: a constant, or a formula over others."""

    constant: Value | None
    formula: str | None = None
    dependencies: tuple[int, ...] = ()
    disposed: bool = False


class Oracle:
    """Computes all values from scratch for each query; a failure is the name of the cell whose formula raised."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []

    def value(self, index: int) -> Value:
        return self.values()[index]

    def values(self) -> list[Value]:
        known: dict[int, Value] = {}
        for index in range(len(self.nodes)):
            self._compute(index, known)
        return [known[index] for index in range(len(self.nodes))]

    def depends(self, index: int, on: int) -> bool:
        return index == on or any(self.depends(each, on) for each in self.nodes[index].dependencies)

    def _compute(self, index: int, known: dict[int, Value]) -> Value:
        if index not in known:
            node = self.nodes[index]
            values = [self._compute(each, known) for each in node.dependencies]
            failed = [value for value in values if isinstance(value, str)]
            known[index] = failed[0] if failed else self._apply(index, node, values)
        return known[index]

    @staticmethod
    def _apply(index: int, node: Node, values: list[Value]) -> Value:
        if node.formula is None:
            assert node.constant is not None
            return node.constant
        try:
            return FORMULAS[node.formula](*values)
        except ZeroDivisionError:
            return f"c{index}"


class Subject:
    """The graph under test."""

    def __init__(self, oracle: Oracle) -> None:
        self.oracle = oracle
        self.graph = Graph()
        self.cells: list[Cell[Any]] = []
        self.computed: list[int] = []
        self.told: list[tuple[int, object]] = []
        self.commits: list[Commit] = []
        self.graph.listen(self.commits.append)

    def make(self, node: Node) -> None:
        index = len(self.cells)
        self.oracle.nodes.append(node)
        if node.formula is None:
            self.cells.append(Source(self.graph, f"c{index}", node.constant))
        else:
            dependencies = tuple(self.cells[each] for each in node.dependencies)
            self.cells.append(Derived(self.graph, f"c{index}", dependencies, self.formula(index, node.formula)))
        self.cells[index].observe(lambda change: self.told.append((index, plain(change.new))))

    def formula(self, index: int, name: str) -> Callable[..., int]:
        def noted(*values: int) -> int:
            self.computed.append(index)
            return FORMULAS[name](*values)

        return noted

    def do(self, action: str, index: int, name: str, value: int, others: list[int]) -> None:
        """Apply one action to both; a refused action changes nothing."""
        cell, node = self.cells[index], self.oracle.nodes[index]
        try:
            getattr(self, action)(cell, node, index, name, value, others)
        except DisposedCellError:
            assert node.disposed

    def write(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        if isinstance(cell, Source):
            cell.set(value)
            node.constant = value

    def pin(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        if isinstance(cell, Derived):
            cell.pin(value)
            self.oracle.nodes[index] = Node(value)

    def rebind(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        if not isinstance(cell, Derived):
            return
        cycle = any(self.oracle.depends(other, index) for other in others)
        try:
            cell.rebind(tuple(self.cells[other] for other in others), self.formula(index, name))
        except PropagationCycleError:
            assert cycle
        else:
            assert not cycle
            self.oracle.nodes[index] = Node(None, name, tuple(others))

    def replace(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        new = others[0]
        hanging = [i for i, each in enumerate(self.oracle.nodes) if index in each.dependencies]
        cycle = any(self.oracle.depends(new, each) for each in hanging)
        try:
            replace_cell(cell, self.cells[new])
        except PropagationCycleError:
            assert cycle
        else:
            assert not cycle
            for each in (self.oracle.nodes[i] for i in hanging):
                each.dependencies = tuple(new if i == index else i for i in each.dependencies)

    def dispose(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        kept = self.oracle.value(index)
        cell.dispose()
        self.oracle.nodes[index] = Node(kept, disposed=True)

    def read(self, cell: Cell[Any], node: Node, index: int, name: str, value: int, others: list[int]) -> None:
        assert plain(cell.result) == self.oracle.value(index)


def plain(value: Failure | Value) -> Value:
    return value.cell if isinstance(value, Failure) else value


@st.composite
def sessions(draw: st.DrawFn) -> tuple[list[Node], list[list[Action]]]:
    """Sources, cells that depend on earlier ones, and transactions with actions on any of them."""
    sources = draw(st.integers(1, 4))
    names = st.sampled_from(sorted(FORMULAS))
    cells = [(Node(draw(st.integers(-2, 2)))) for _ in range(sources)]
    for index in range(sources, sources + draw(st.integers(1, 14))):
        dependencies = draw(st.lists(st.integers(0, index - 1), min_size=1, max_size=3))
        cells.append(Node(None, draw(names), tuple(dependencies)))
    indices = st.integers(0, len(cells) - 1)
    actions = st.sampled_from(["write"] * 8 + ["read", "rebind", "rebind", "replace", "pin", "dispose"])
    step = st.tuples(actions, indices, names, st.integers(-3, 3), st.lists(indices, min_size=1, max_size=3))
    return cells, draw(st.lists(st.lists(step, max_size=5), min_size=1, max_size=6))


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(max_examples=300)
@given(sessions())
def test_propagation_gives_the_same_as_computing_everything_again(
    session: tuple[list[Node], list[list[Action]]],
) -> None:
    nodes, transactions = session
    oracle = Oracle()
    subject = Subject(oracle)
    for node in nodes:
        subject.make(node)
    for steps in transactions:
        before = oracle.values()
        for notes in (subject.computed, subject.told, subject.commits):
            notes.clear()
        with subject.graph.transaction("steps"):
            for step in steps:
                subject.do(*step)
        after = oracle.values()
        assert [plain(cell.result) for cell in subject.cells] == after
        changed = {i: new for i, (old, new) in enumerate(zip(before, after, strict=True)) if old != new}
        recorded = {subject.cells.index(c.cell): plain(c.new) for commit in subject.commits for c in commit.changes}
        assert recorded == changed
        assert len(subject.told) == len(dict(subject.told)), "somebody was told twice"
        assert dict(subject.told) == {i: new for i, new in changed.items() if not subject.cells[i].disposed}
        if not {"read", "dispose"} & {step[0] for step in steps}:
            assert len(subject.computed) == len(set(subject.computed)), "a cell was computed twice"
