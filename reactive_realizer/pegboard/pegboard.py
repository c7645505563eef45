"""The board: every point in time of every character, by name."""

from collections.abc import Callable, Iterable, Mapping
from itertools import islice

from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import error
from reactive_realizer.pegboard.explanation import Explanation, explain
from reactive_realizer.pegboard.moving import MovableSource, move
from reactive_realizer.pegboard.peg_key import ANTICIPATORS, BlockKey, PegKey, anticipator_key
from reactive_realizer.pegboard.peg_view import PegView, view_of
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimeCell, TimePeg, time_of
from reactive_realizer.reactive.graph import Graph

_PREDICTED = BlockKey("", ANTICIPATORS)


class PegBoard:
    """Names cells; the cells themselves keep each other right (thesis 7.3.2).

    Attributes:
        graph: where the cells live; every write is a transaction on it.
    """

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._pegs: dict[PegKey, TimeCell] = {}
        self._blocks: dict[BlockKey, list[PegKey]] = {}
        self._owners: dict[TimeCell, BlockKey] = {}
        self._unnamed: dict[BlockKey, list[TimePeg]] = {}
        self._forecasts: dict[str, Callable[[str], Time]] = {}

    @property
    def time(self) -> GlobalTime:
        """Realizer time, s, which is noted in commits; its owner sets it with every tick."""
        return GlobalTime(self.graph.time)

    @time.setter
    def time(self, time: GlobalTime) -> None:
        self.graph.time = time

    def add(self, key: PegKey, peg: TimeCell) -> None:
        """Name a peg; one peg may bear several names."""
        self.add_block(key.block_key, {key: peg})

    def add_block(self, block: BlockKey, pegs: Mapping[PegKey, TimeCell]) -> None:
        """Name the pegs of a block."""
        self._pegs.update(pegs)
        self._blocks.setdefault(block, []).extend(pegs)
        for peg in pegs.values():
            self._owners.setdefault(peg, block)

    def add_unnamed(self, block: BlockKey, pegs: Iterable[TimePeg]) -> None:
        """Take in pegs that only pegs of a block hang on, and that go with it."""
        self._unnamed.setdefault(block, []).extend(pegs)

    def replace(self, key: PegKey, peg: TimePeg) -> None:
        """Within a transaction, give a name to another peg; what hung on the old one hangs on the new one."""
        old = self._pegs[key]
        if isinstance(old, TimePeg) and not old.pinned:
            old.pin(time_of(old))
        old.replace_by(peg)
        self._owners.pop(old, None)
        self._pegs[key] = peg
        self._owners.setdefault(peg, key.block_key)

    def owner(self, peg: TimeCell) -> BlockKey | None:
        """The block that a peg is named for; None for one that has no name."""
        return self._owners.get(peg)

    def get(self, key: PegKey) -> TimeCell | None:
        """The peg of that name."""
        return self._pegs.get(key)

    def move(self, key: PegKey, time: GlobalTime) -> MovableSource:
        """Within a transaction, bring a point to a time (s) by writing the one source that it hangs on; which that is.

        Raises:
            RealizerError: there is no such point, or no source that would bring it there; nothing changes.
        """
        return move(self._point(key), time)

    def explain(self, key: PegKey) -> Explanation:
        """The chain of pegs, constraints and commits that set the time of a point.

        Raises:
            RealizerError: there is no such point.
        """
        return explain(self._point(key))

    def explain_block(self, block: BlockKey) -> dict[str, object]:
        """The explanation of every point of a block by its name, as objects that `json.dumps` takes."""
        return {str(key): self.explain(key).as_json() for key in self._blocks.get(block, ())}

    def pin_block(self, block: BlockKey) -> list[TimePeg]:
        """Within a transaction, cut all pegs of a block from what they hang on; those that still hung, each once."""
        named = dict.fromkeys(self._pegs[key] for key in self._blocks.get(block, ()))
        cut = [peg for peg in named if isinstance(peg, TimePeg) and not peg.pinned]
        for peg in cut:
            peg.pin(time_of(peg))
        return cut

    def remove_block(self, block: BlockKey) -> None:
        """Forget the names of a block, and predicted points that nothing hangs on and that are known without a peg.

        Pegs that others hang on live on with them, and stay where they are.
        """
        for key in dict.fromkeys(self._blocks.pop(block, ())):
            peg = self._pegs.pop(key)
            if self._owners.get(peg) == block:
                del self._owners[peg]
                if isinstance(peg, TimePeg) and not peg.pinned:
                    peg.dispose()
        for peg in self._unnamed.pop(block, ()):
            peg.dispose()
        predicted = self._blocks.get(_PREDICTED, [])
        self._blocks[_PREDICTED] = [key for key in predicted if not self._forgettable(key)]
        for key in set(predicted).difference(self._blocks[_PREDICTED]):
            self._owners.pop(self._pegs.pop(key), None)

    def predicted(self, anticipator: str, sync: str) -> AnticipatorPeg:
        """The peg of a predicted point, made when it is first named; unknown unless its anticipator has an answer."""
        key = anticipator_key(anticipator, sync)
        peg = self._pegs.get(key)
        if not isinstance(peg, AnticipatorPeg):
            peg = AnticipatorPeg(self.graph, str(key), self._forecast(key))
            self.add(key, peg)
        return peg

    def renew(self, anticipator: str, sync: str) -> None:
        """Have a predicted point mean the next time it happens; what hangs on it already keeps this one."""
        key = anticipator_key(anticipator, sync)
        if key in self._pegs:
            self._owners.pop(self._pegs[key], None)
            self._pegs[key] = AnticipatorPeg(self.graph, str(key), self._forecast(key))
            self._owners[self._pegs[key]] = key.block_key

    def ask(self, anticipator: str, forecast: Callable[[str], Time]) -> None:
        """Have an anticipator asked for the time of its points when they are first named."""
        self._forecasts[anticipator] = forecast

    def predictions(self, anticipator: str) -> dict[str, AnticipatorPeg]:
        """The points of an anticipator that were named, by sync id."""
        keys = self._blocks.get(_PREDICTED, ())
        pegs = ((key.sync, self._pegs[key]) for key in keys if key.behavior == anticipator)
        return {sync: peg for sync, peg in pegs if isinstance(peg, AnticipatorPeg)}

    def snapshot(self, newest: int | None = None) -> tuple[PegView, ...]:
        """All that is named, in order of naming; or only so many of the newest."""
        first = 0 if newest is None else max(0, len(self._pegs) - newest)
        pegs = islice(self._pegs.items(), first, None)
        return tuple(view_of(key, peg, self._owners.get(peg)) for key, peg in pegs)

    def _point(self, key: PegKey) -> TimeCell:
        if key not in self._pegs:
            raise error("no-point", point=key)
        return self._pegs[key]

    def _forecast(self, key: PegKey) -> Time:
        forecast = self._forecasts.get(key.behavior or "")
        return forecast(key.sync) if forecast else None

    def _forgettable(self, key: PegKey) -> bool:
        peg = self._pegs[key]
        return not peg.dependents and peg.value == self._forecast(key)
