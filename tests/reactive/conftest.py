"""A graph that notes what it computes and commits."""

import pytest

from reactive_realizer.reactive.cell import Derived, Source
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
