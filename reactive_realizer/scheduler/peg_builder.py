"""From descriptions of pegs to pegs."""

from collections.abc import Iterator, Mapping, Sequence

from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.time_peg import AfterPeg, BeforePeg, Bound, OffsetPeg, RatioPeg, TimeCell, TimePeg
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import AtBlock, AtLeast, AtMost, AtOffset, AtRatio, PegSpec


class PegBuilder:
    """Makes the pegs of a plan; what shares a description shares a peg, which bears the name of the first."""

    def __init__(self, graph: Graph, block: BMLBlock, specs: Mapping[PegKey, PegSpec]) -> None:
        self._graph = graph
        self._block = block
        self._specs = specs
        self._names: dict[PegSpec, str] = {}
        for key, spec in specs.items():
            if spec not in self._names:
                self._names[spec] = str(key)
        for spec, name in list(self._names.items()):
            for natural in _naturals(spec):
                self._names.setdefault(natural, f"{name} as planned")
        self._built: dict[PegSpec, TimePeg] = {}

    def build(self) -> dict[PegKey, TimePeg]:
        """The peg of each sync point."""
        for spec in self._specs.values():
            if spec not in self._built:
                self._build(spec)
        return {key: self._built[spec] for key, spec in self._specs.items()}

    @property
    def unnamed(self) -> list[TimePeg]:
        """What was made beside them."""
        named = set(self._specs.values())
        return [peg for spec, peg in self._built.items() if spec not in named]

    def _build(self, spec: PegSpec) -> None:
        """Make a peg, after those that it hangs on; these may be a long chain, too deep for recursion."""
        built, waiting = self._built, [spec]
        while waiting:
            made = waiting[-1]
            missing = [link for link in made.links if link not in built and not isinstance(link, Cell)]
            if missing and made not in built:
                waiting += missing
            elif waiting.pop() not in built:
                built[made] = self._make(made)

    def _make(self, spec: PegSpec) -> TimePeg:
        name = self._names.get(spec) or f"{self._block.key.block}:a planned time"
        match spec:
            case AtBlock(anchor, offset):
                return OffsetPeg(self._graph, name, self._block.start, anchor.time + offset)
            case AtOffset(link, offset):
                return OffsetPeg(self._graph, name, self._cell(link), offset)
            case AtRatio(before, after, ratio):
                return RatioPeg(self._graph, name, self._cell(before), self._cell(after), ratio)
            case AtLeast(natural, bounds, ceilings):
                return AfterPeg(self._graph, name, self._cell(natural), self._bounds(bounds), self._bounds(ceilings))
            case AtMost(natural, bounds, floors):
                return BeforePeg(self._graph, name, self._cell(natural), self._bounds(bounds), self._bounds(floors))

    def _cell(self, link: PegSpec | TimeCell) -> TimeCell:
        return link if isinstance(link, Cell) else self._built[link]

    def _bounds(self, bounds: Sequence[tuple[PegSpec | TimeCell, float]]) -> list[Bound]:
        return [(self._cell(link), distance) for link, distance in bounds]


def _naturals(spec: PegSpec) -> Iterator[PegSpec]:
    """Where a bounded peg would be without its bounds, one kind after the other."""
    while isinstance(spec, AtLeast | AtMost) and not isinstance(spec.natural, Cell):
        spec = spec.natural
        yield spec
