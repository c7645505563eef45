"""A graph that records computations and commits."""

from collections.abc import Callable
from typing import Any

import pytest

from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.graph import Cell, Commit, Graph


class Trace:
    """Makes cells that record when they are computed."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.computed: list[str] = []
        self.commits: list[Commit] = []
        self.graph.listen(self.commits.append)

    def source(self, name: str, value: object = 0) -> Source[Any]:
        return Source(self.graph, name, value)

    def derived(
        self, name: str, *cells: Cell[Any], formula: Callable[..., object] = lambda *values: sum(values)
    ) -> Derived[Any]:
        def noted(*values: object) -> object:
            self.computed.append(name)
            return formula(*values)

        return Derived(self.graph, name, cells, noted)

    def write(self, cell: Source[Any], *values: object) -> None:
        self.computed.clear()
        with self.graph.transaction("test"):
            for value in values:
                cell.set(value)

    def changed(self) -> list[str]:
        return [change.cell.name for change in self.commits[-1].changes]


@pytest.fixture
def trace() -> Trace:
    return Trace()
