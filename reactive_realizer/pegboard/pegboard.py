"""The peg board: the pegs of all characters, by name."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime, Time, has_passed, is_due
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.nearest_name import nearest_name
from reactive_realizer.pegboard.anticipator import Anticipator, NoAnticipatorYet, Remote
from reactive_realizer.pegboard.peg_key import ANTICIPATORS, BlockKey, PegKey, anticipator_key
from reactive_realizer.pegboard.peg_view import Explanation, PegView, explain, view_of
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, TimeCell, TimePeg, time_of
from reactive_realizer.reactive.cell import replace_cell
from reactive_realizer.reactive.graph import Cell, Graph

_PREDICTED = BlockKey("", ANTICIPATORS)


class NoPoint(Fault):
    """No point of the board has the name."""

    code = "no-point"
    template = "there is no point {point}"
    point: str


class PegBoard:
    """The named pegs (thesis 7.3.2); the graph of cells keeps their times consistent.

    Attributes:
        graph: of the pegs; every write is a transaction on it.
        previous: time of the tick before the present one, s.
        anticipators: those whose points blocks can refer to, by id; others may be predicted all the same.
        forecast: asks an anticipator for the time of a counted point that is named for the first time.
    """

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.previous = GlobalTime(-1.0)
        self._pegs: dict[PegKey, TimeCell] = {}
        self._blocks: dict[BlockKey, dict[PegKey, None]] = {}
        self._owners: dict[TimeCell, BlockKey] = {}
        self._last: dict[PegKey, AnticipatorPeg] = {}
        self._unnamed: dict[BlockKey, list[TimePeg]] = {}
        self.anticipators: dict[str, Anticipator] = {}
        self.forecast: Callable[[Anticipator, str], Time] = lambda anticipator, sync: anticipator.forecast(sync)

    @property
    def time(self) -> GlobalTime:
        """Time of the present tick, s, which is noted in commits."""
        return GlobalTime(self.graph.time)

    def begin(self, tick: Tick) -> None:
        """Set the tick that begins."""
        self.graph.time, self.previous = tick.time, tick.previous

    def add(self, key: PegKey, peg: TimeCell) -> None:
        """Name a peg; a peg may have several names."""
        self.add_block(key.block_key, {key: peg})

    def add_block(self, block: BlockKey, pegs: Mapping[PegKey, TimeCell]) -> None:
        """Name the pegs of a block."""
        self._pegs.update(pegs)
        self._blocks.setdefault(block, {}).update(dict.fromkeys(pegs))
        for peg in pegs.values():
            self._owners.setdefault(peg, block)

    def add_unnamed(self, block: BlockKey, pegs: Iterable[TimePeg]) -> None:
        """Register unnamed pegs on which only pegs of a block depend, and which are removed with it."""
        self._unnamed.setdefault(block, []).extend(pegs)

    def unnamed(self, block: BlockKey) -> Sequence[TimePeg]:
        """The unnamed pegs of a block."""
        return self._unnamed.get(block, ())

    def replace(self, key: PegKey, peg: TimePeg) -> None:
        """Within a transaction, give a name to another peg; dependents of the old one then depend on the new one."""
        old = self._pegs[key]
        if isinstance(old, TimePeg) and not old.pinned:
            old.pin(time_of(old))
        replace_cell(old, peg)
        self._owners.pop(old, None)
        self._pegs[key] = peg
        self._owners.setdefault(peg, key.block_key)

    def get(self, key: PegKey) -> TimeCell | None:
        """The peg of that name."""
        return self._pegs.get(key)

    def explain(self, key: PegKey) -> Explanation:
        """The chain of pegs, constraints and commits that determined the time of a point.

        Raises:
            RealizerError: there is no such point.
        """
        return explain(self._point(key))

    def followers(self, key: PegKey) -> int:
        """The number of pegs that depend on a named one, directly or through others; 0 for an unknown name."""
        found = set[Cell[Any]]()
        waiting: list[Cell[Any]] = [self._pegs[key]] if key in self._pegs else []
        while waiting:
            new = [each for each in waiting.pop().dependents if each not in found]
            found.update(new)
            waiting += new
        return len(found)

    def explain_block(self, block: BlockKey) -> Iterator[tuple[str, object]]:
        """The name and the explanation of every point of a block, as objects that `json.dumps` takes.

        Points that leave the board meanwhile are left out.
        """
        for key in tuple(self._blocks.get(block, ())):
            if key in self._pegs:
                yield str(key), self.explain(key).as_json()

    def pin_block(self, block: BlockKey) -> list[TimePeg]:
        """Within a transaction, pin all pegs of a block at their times; those that were not pinned, each once."""
        named = dict.fromkeys(self._pegs[key] for key in self._blocks.get(block, ()))
        cut = [peg for peg in named if isinstance(peg, TimePeg) and not peg.pinned]
        for peg in cut:
            peg.pin(time_of(peg))
        return cut

    def remove_block(self, block: BlockKey, points: Iterable[PegKey] = ()) -> None:
        """Remove the names of a block; and of predicted points, those without dependents that can be predicted again.

        A peg that others depend on stays alive with them, and keeps its time.

        Args:
            block: that has ended.
            points: the predicted points that it named.
        """
        for key in self._blocks.pop(block, ()):
            peg = self._pegs.pop(key)
            if self._owners.get(peg) == block:
                del self._owners[peg]
                if isinstance(peg, TimePeg) and not peg.pinned:
                    peg.dispose()
        for peg in self._unnamed.pop(block, ()):
            peg.dispose()
        self.forget_points([key for key in points if key in self._pegs and self._forgettable(key)])

    def predicted(self, anticipator: str, sync: str) -> AnticipatorPeg:
        """The peg of a predicted point, made when the point is first named."""
        key = anticipator_key(anticipator, sync)
        peg = self._pegs.get(key)
        if not isinstance(peg, AnticipatorPeg):
            owner = self.anticipators.get(anticipator)
            time = self.forecast(owner, sync) if owner is not None and owner.counts(sync) else None
            peg = AnticipatorPeg(self.graph, str(key), time)
            self.add(key, peg)
        return peg

    def upcoming(self, anticipator: str, sync: str) -> AnticipatorPeg:
        """The peg of the next occurrence of a predicted point; a counted point has only one."""
        owner, peg = self.anticipators.get(anticipator), self.predicted(anticipator, sync)
        if is_due(peg.value, self.time) and not (owner is not None and owner.counts(sync)):
            self.renew(anticipator, sync)
            peg = self.predicted(anticipator, sync)
        return peg

    def first_since(self, anticipator: str, sync: str, time: GlobalTime, *, at_it: bool) -> AnticipatorPeg:
        """The peg of the first of the last two occurrences of a predicted point that came since a time, or of the next.

        Args:
            anticipator: id of the anticipator.
            sync: id of the point.
            time: not after the present tick, s.
            at_it: whether an occurrence at that time counts.
        """
        for peg in (self._last.get(anticipator_key(anticipator, sync)), self.predicted(anticipator, sync)):
            if peg is None or not is_due(peg.value, self.time):
                continue
            if not (has_passed(peg.value, time) if at_it else is_due(peg.value, time)):
                return peg
        return self.upcoming(anticipator, sync)

    def renew(self, anticipator: str, sync: str) -> None:
        """Make a predicted point mean its next occurrence; pegs that depend on it already keep this one."""
        key = anticipator_key(anticipator, sync)
        if key in self._pegs:
            self._last[key] = self.predicted(anticipator, sync)
            self._owners.pop(self._pegs[key], None)
            self._pegs[key] = AnticipatorPeg(self.graph, str(key), None)
            self._owners[self._pegs[key]] = key.block_key

    def check_point(self, anticipator: str, sync: str, reference: str) -> None:
        """Check a reference to a point; an anticipator that does not exist yet may predict any.

        Raises:
            RealizerError: "unknown-point".
        """
        if anticipator in self.anticipators:
            self.anticipators[anticipator].check_point(sync, reference)

    def mistyped_anticipator(self, anticipator: str, reference: str) -> NoAnticipatorYet | None:
        """The fault of a reference to an anticipator that does not exist yet, if its name is like a known one.

        It is no fault otherwise, because clients may predict the points of any anticipator.
        """
        known = tuple(self.anticipators)
        if nearest_name(anticipator, known) is None:
            return None
        return NoAnticipatorYet(reference=reference, anticipator=anticipator, known=known)

    def occur(self, anticipator: str, sync: str, time: GlobalTime) -> None:
        """Within a transaction, have a point occur; from now on, its name means the next occurrence."""
        if anticipator_key(anticipator, sync) in self._pegs:
            self.predicted(anticipator, sync).set(time)
            self.renew(anticipator, sync)

    def predictions(self, anticipator: str) -> dict[str, AnticipatorPeg]:
        """The points of an anticipator that were named, by sync id."""
        keys = self._blocks.get(_PREDICTED, ())
        pegs = ((key.sync, self._pegs[key]) for key in keys if key.behavior == anticipator)
        return {sync: peg for sync, peg in pegs if isinstance(peg, AnticipatorPeg)}

    @property
    def predicted_points(self) -> Collection[PegKey]:
        """The predicted points that were named, in order of naming."""
        return self._blocks.get(_PREDICTED, ())

    def unneeded_points(self, now: GlobalTime) -> list[PegKey]:
        """The predicted points that no peg depends on, in the order in which they may be forgotten.

        Those that are unknown or have passed come first, then those that clients have predicted for later; each in
        order of naming.
        """
        free = [(key, self._pegs[key].value) for key in self.predicted_points if not self._pegs[key].dependents]
        spent = [key for key, time in free if time is None or is_due(time, now)]
        later = [key for key, time in free if not (time is None or is_due(time, now))]
        return spent + [key for key in later if isinstance(self.anticipators.get(key.behavior or ""), Remote | None)]

    def forget_points(self, keys: Iterable[PegKey]) -> None:
        """Forget predicted points that no peg depends on; if one is named again, it is a new one."""
        for key in keys:
            del self._blocks[_PREDICTED][key]
            self._owners.pop(self._pegs.pop(key), None)
            self._last.pop(key, None)

    def snapshot(self, newest: int | None = None) -> tuple[PegView, ...]:
        """The named pegs, in order of naming; only the newest, if a number is given."""
        first = 0 if newest is None else max(0, len(self._pegs) - newest)
        pegs = islice(self._pegs.items(), first, None)
        return tuple(view_of(key, peg, self._owners.get(peg)) for key, peg in pegs)

    def _point(self, key: PegKey) -> TimeCell:
        if key not in self._pegs:
            raise RealizerError(NoPoint(point=str(key)))
        return self._pegs[key]

    def _forgettable(self, key: PegKey) -> bool:
        peg, anticipator = self._pegs[key], self.anticipators.get(key.behavior or "")
        return not peg.dependents and (peg.value is None or (anticipator is not None and anticipator.answers(key.sync)))
