"""Resolves the references of a block, and turns its constraints into ties and precedences (thesis 7.1.1)."""

from collections import defaultdict
from collections.abc import Collection, Container, Generator, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from heapq import heappop, heappush
from typing import NamedTuple, TypeVar

from reactive_realizer.bml.block import BehaviorBlock, OrderKind, Synchronize
from reactive_realizer.bml.block import Order as OrderConstraint
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.reference_faults import LostWith, UnknownReference, UnknownSync
from reactive_realizer.bml.references import predictions_of, unknown_behavior, unknown_block, unknown_block_point
from reactive_realizer.bml.sync_ref import FIRST_STROKE, OWN_BLOCK_POINTS, SyncRef, named_point
from reactive_realizer.errors import Fault, RealizerError, SchedulingFault
from reactive_realizer.pegboard.bounded_pegs import Bound
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Node, Origin, Point, Precedence, Tie
from reactive_realizer.scheduler.solution import Loss, lost_behavior

C = TypeVar("C", Tie, Precedence)


class CyclicReference(SchedulingFault):
    """A reference to a point that depends on the block itself."""

    code = "cyclic-reference"
    template = "{reference} depends on the block '{block}' itself"
    reference: str
    block: str


class MutualReference(SchedulingFault):
    """A reference to a block that refers back to this one."""

    code = "mutual-reference"
    template = (
        "{reference}: '{other}' is not planned before '{block}', because it refers to it directly or through "
        "other blocks"
    )
    reference: str
    other: str
    block: str


class WaitsForItself(SchedulingFault):
    """A wait that begins with something that waits for its end."""

    code = "waits-for-itself"
    template = "its start depends on its own end"


_SEARCH = 50
"""Work of finding the known name that an unknown one may mean."""


def _search(fault: Fault) -> int:
    """Find the name that an unknown one may mean, which is remembered until the fault is reported; the work."""
    return _SEARCH if fault.sentence else 0


class ReferenceResolver:
    """Finds the points that the references of one block name.

    Attributes:
        units: the behaviors of the block that can be placed, by id.
    """

    def __init__(self, block: BMLBlock, units: Mapping[str, PlanUnit], board: PegBoard, blocks: Blocks) -> None:
        self.units = dict(units)
        self._block = block
        self._board = board
        self._blocks = blocks
        self._causes: dict[str, str] = {}
        # What a reference names is found once: the block of the point may end, ticks later, while this one is planned.
        self._outer: dict[SyncRef, TimeCell] = {}

    def drop_unplaceable(self) -> Generator[int, None, list[Loss]]:
        """Drop the behaviors with invalid references, those that depend on them, and so on.

        A behavior in each step, which gives the work that it took.
        """
        losses: list[Loss] = []
        order = list(self.units)
        unchecked = list(range(len(order)))  # a heap
        naming = self._naming()
        while unchecked:
            unit = self.units.get(order[heappop(unchecked)])
            fault = None if unit is None else self._fault(unit)
            if unit is not None and fault is not None:
                if isinstance(fault, LostWith):
                    self._causes[unit.behavior.id] = fault.behavior
                losses.append(lost_behavior(unit.behavior, fault))
                del self.units[unit.behavior.id]
                for number in naming.get(unit.behavior.id, ()):
                    heappush(unchecked, number)
            yield 1 if fault is None else _search(fault)
        return losses

    def locate(self, ref: SyncRef) -> Node:
        """The point that a reference names, without its offset.

        Raises:
            RealizerError: there is no such point.
        """
        if ref.block == ANTICIPATORS and ref.behavior is not None and ref.sync is not None:
            self._board.check_point(ref.behavior, ref.sync, str(ref))
            return self._block.predicted[ref.behavior, ref.sync]
        if ref.block not in (None, self._block.key.block):
            if ref not in self._outer:
                self._outer[ref] = self._outside(ref)
            return self._outer[ref]
        if ref.behavior is None or ref.sync is None:
            return Origin.BLOCK_START
        unit = self.units.get(ref.behavior)
        if unit is None and ref.behavior in _written(self._block):
            raise RealizerError(LostWith(behavior=self._causes.get(ref.behavior, ref.behavior), reference=str(ref)))
        if unit is None:
            raise RealizerError(self._unknown(ref))
        sync = _sync_of(unit, ref.sync, ref)
        return unit.open.get(sync) or Point(ref.behavior, sync)

    def mistyped_anticipator(self, anticipator: str, ref: SyncRef) -> Fault | None:
        """The fault of a reference to an anticipator that has almost the name of a known one."""
        return self._board.mistyped_anticipator(anticipator, str(ref))

    def startable(self, constraints: list[C]) -> list[C]:
        """The constraints.

        Raises:
            RealizerError: the block would start with, or after, a point that follows from its own start.
        """
        own = {peg: f"{id_}:{sync}" for id_, unit in self.units.items() for sync, peg in unit.open.items()}
        for each in constraints:
            bound = bound_on_start(each)
            if bound is not None and bound[0] in own:
                raise RealizerError(CyclicReference(block=self._block.key.block, reference=own[bound[0]]))
        return constraints

    def _unknown(self, ref: SyncRef) -> Fault:
        """The fault of a reference to a behavior that the block does not have."""
        name, block = ref.behavior or "", self._block.key
        other = None if ref.block is not None or name == block.block else self._blocks.find(block.character, name)
        known = tuple(behavior.id for behavior in self._block.description.behaviors)
        return unknown_behavior(ref, known, () if other is None else (other.description,))

    def _naming(self) -> dict[str, list[int]]:
        """The numbers of the behaviors that name each behavior of the block."""
        naming: defaultdict[str, list[int]] = defaultdict(list)
        for number, unit in enumerate(self.units.values()):
            for ref in self._own(unit.behavior.syncs.values()):
                naming[ref.behavior or ""].append(number)
        return naming

    def _own(self, refs: Iterable[SyncRef]) -> Iterator[SyncRef]:
        """The references to the block itself."""
        return (ref for ref in refs if ref.block in (None, self._block.key.block))

    def _fault(self, unit: PlanUnit) -> Fault | None:
        """The first fault that keeps a behavior from being placed."""
        for sync, ref in unit.behavior.syncs.items():
            try:
                self.locate(ref)
                _sync_of(unit, sync, ref)
            except RealizerError as problem:
                return problem.fault
        return WaitsForItself() if unit.timing.waits and self._waits_for_itself(unit) else None

    def _waits_for_itself(self, waiting: PlanUnit) -> bool:
        """Whether the start of a wait depends on its end, through behaviors that are tied to both."""
        id_, (tied, after) = waiting.behavior.id, self._links
        reachable = _reachable(id_, tied, self.units)
        return any(own in reachable for own in after[id_] if own in self.units)

    @cached_property
    def _links(self) -> tuple[Mapping[str, Collection[str]], Mapping[str, Collection[str]]]:
        """By id, the behaviors that are tied to each behavior, and those that come after the end of each wait."""
        tied: defaultdict[str, set[str]] = defaultdict(set)
        after: defaultdict[str, set[str]] = defaultdict(set)
        units = dict(self.units)
        for own, unit in units.items():
            for ref in self._own(ref for sync, ref in unit.behavior.syncs.items() if sync not in unit.open):
                other = units.get(ref.behavior or "")
                if other is not None and ref.sync in other.open:
                    after[other.behavior.id].add(own)
                elif other is not None:
                    tied[own].add(other.behavior.id)
                    tied[other.behavior.id].add(own)
        return tied, after

    def _outside(self, ref: SyncRef) -> TimeCell:
        """A peg of another block."""
        name = ref.block or ""
        other = self._blocks.find(self._block.key.character, name)
        if other is None:
            known = self._blocks.names(self._block.key.character)
            raise RealizerError(unknown_block(ref, self._block.description, known))
        if ref.behavior is None and ref.sync in OWN_BLOCK_POINTS:
            ref = self._defining(other, ref)
        peg = self._peg(other, ref)
        if peg is not None and peg.depends_on(self._block.start):
            raise RealizerError(CyclicReference(block=self._block.key.block, reference=str(ref)))
        if peg is not None and ref.behavior not in other.dropped:
            return peg
        unit = next((unit for unit in other.units if unit.behavior.id == ref.behavior), None)
        if unit is not None:
            _sync_of(unit, ref.sync or "", ref)
        if ref.behavior not in _written(other):
            known = tuple(behavior.id for behavior in other.description.behaviors)
            raise RealizerError(UnknownReference(behavior=ref.behavior or "", reference=str(ref), known=known))
        if other.state is BlockState.IN_PREP:
            raise RealizerError(MutualReference(block=self._block.key.block, other=name, reference=str(ref)))
        raise RealizerError(LostWith(behavior=f"{name}:{ref.behavior}", reference=str(ref)))

    def _peg(self, other: BMLBlock, ref: SyncRef) -> TimeCell | None:
        sync = ref.sync or "start"
        names = dict.fromkeys((sync, named_point(sync, (FIRST_STROKE,))))
        pegs = (self._board.get(PegKey(*other.key, ref.behavior, name)) for name in names)
        return next((peg for peg in pegs if peg is not None), None)

    def _defining(self, other: BMLBlock, ref: SyncRef) -> SyncRef:
        """The reference to the behavior that defines a sync point of another block (thesis 12.1.3).

        By default, a block is ready with the behavior that is planned to be ready first.

        Raises:
            RealizerError: the block has no such point.
        """
        own = other.description.points.get(ref.sync or "")
        if own is not None:
            return replace(ref, behavior=own.behavior, sync=own.sync)
        points = ((unit.behavior.id, point) for unit in other.units for point in unit.points)
        times = {id_: point.peg.value for id_, point in points if point.id == "ready"}
        if ref.sync == "ready" and times:
            return replace(ref, behavior=min(times, key=lambda id_: (times[id_] is None, times[id_] or 0.0)))
        if ref.sync == "ready" and other.state is BlockState.IN_PREP:
            raise RealizerError(MutualReference(block=self._block.key.block, other=other.key.block, reference=str(ref)))
        unknown = unknown_block_point(ref, [other.description])
        raise RealizerError(unknown or LostWith(behavior=f"{other.key.block}:ready", reference=str(ref)))


class Constraints(NamedTuple):
    """The constraints of a block.

    Attributes:
        ties: its `at` constraints.
        orders: its before/after constraints.
        losses: for invalid references of the block.
    """

    ties: list[Tie]
    orders: list[Precedence]
    losses: list[Loss]


def constraints_of(block: BehaviorBlock, resolver: ReferenceResolver) -> Generator[int, None, Constraints]:
    """All constraints of the units of a block; those of a unit, or a constraint of the block, in each step.

    Each step gives the work that it took.
    """
    found = Constraints([], [], [])
    for unit in resolver.units.values():
        found.ties.extend(_own_ties(unit, resolver))
        yield 1
    for each in sorted(block.constraints, key=lambda each: isinstance(each, OrderConstraint)):
        work = 1
        try:
            if isinstance(each, Synchronize):
                found.ties.extend(resolver.startable(_synchronized(each, resolver)))
            else:
                found.orders.extend(resolver.startable(_ordered(each, resolver)))
        except RealizerError as problem:
            fault = problem.fault.located(each.location.line, each.location.column)
            found.losses.append(Loss(None, fault, dropped=False, required=each.required))
            work = _search(fault)
        yield work
    for ref in block.points.values():
        try:
            resolver.locate(ref)
        except RealizerError as problem:
            fault = problem.fault.located(block.location.line, block.location.column)
            found.losses.append(Loss(None, fault, dropped=False, required=False))
    for place, location, anticipator, ref in predictions_of(block):
        mistyped = resolver.mistyped_anticipator(anticipator, ref)
        if mistyped is not None:
            fault = mistyped.located(location.line, location.column)
            found.losses.append(Loss(place.partition(":")[2] or None, fault, dropped=False, required=False))
        yield 1 if mistyped is None else _search(mistyped)
    return found


def bound_on_start(constraint: Tie | Precedence) -> Bound | None:
    """The bound that a constraint puts on the start of its block, if it does (thesis, example 34)."""
    match constraint:
        case Precedence(later=Origin.BLOCK_START, earlier=node, offset=distance):
            pass
        case Tie(left=Origin.BLOCK_START, right=node, offset=distance):
            pass
        case Tie(left=node, right=Origin.BLOCK_START, offset=offset):
            distance = -offset
        case _:
            return None
    return None if isinstance(node, Point | Origin) else (node, distance)


def _own_ties(unit: PlanUnit, resolver: ReferenceResolver) -> Iterator[Tie]:
    id_, behavior = unit.behavior.id, unit.behavior
    for sync, ref in behavior.syncs.items():
        if sync in unit.open:
            continue  # it waits for the point that its end names, and is not tied to it
        text, node = f"{id_}:{sync} = {ref}", resolver.locate(ref)
        yield Tie(
            Point(id_, named_point(sync, unit.timing.points)),
            node,
            ref.offset,
            id_,
            behavior.location,
            text,
            behavior.required,
        )


def _synchronized(constraint: Synchronize, resolver: ReferenceResolver) -> list[Tie]:
    """Ties of all points to the first one from outside, or else to the first: all follow that, in any order."""
    nodes = [(resolver.locate(ref), ref) for ref in constraint.refs]
    pivot, first = next((pair for pair in nodes if not isinstance(pair[0], Point)), nodes[0])
    place, required = constraint.location, constraint.required
    return [
        Tie(node, pivot, first.offset - ref.offset, None, place, f"{ref} = {first}", required)
        for node, ref in nodes
        if ref is not first
    ]


def _ordered(constraint: OrderConstraint, resolver: ReferenceResolver) -> list[Precedence]:
    orders, pivot = [], constraint.ref
    for ref in constraint.refs:
        late, early = (ref, pivot) if constraint.kind is OrderKind.AFTER else (pivot, ref)
        text = f"{ref} {constraint.kind} {pivot}"
        nodes, name = (resolver.locate(late), resolver.locate(early)), f"{constraint.id or ''} {text}"
        distance = early.offset - late.offset
        orders.append(Precedence(*nodes, distance, name, constraint.location, text, constraint.required))
    return orders


def _reachable(first: str, links: Mapping[str, Collection[str]], among: Container[str]) -> set[str]:
    found, waiting = {first}, [first]
    while waiting:
        new = {each for each in links.get(waiting.pop(), ()) if each not in found and each in among}
        found |= new
        waiting += new
    return found


def _written(block: BMLBlock) -> set[str]:
    """Ids of all behaviors in the document of a block, whether they are played or not."""
    return {behavior.id for behavior in block.description.behaviors} | block.description.unread


def _sync_of(unit: PlanUnit, sync: str, ref: SyncRef) -> str:
    """The sync point of a unit that a name denotes.

    Raises:
        RealizerError: there is none; the reference is for the message.
    """
    if (named := named_point(sync, known := unit.timing.points)) not in known:
        fault = UnknownSync(reference=str(ref), behavior=unit.behavior.id, sync=sync, known=known)
        raise RealizerError(fault)
    return named
