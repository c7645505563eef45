"""Ties to points that never come: behaviors that depend on them keep the last predicted time, or are dropped."""

from collections.abc import Collection, Container, Iterable, Mapping, Sequence
from itertools import chain

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.effects import Dropped
from reactive_realizer.errors import SchedulingFault
from reactive_realizer.pegboard.open_pegs import OpenPeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.peg_view import followers_of
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import TimeCell, TimePeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Node, Point, Precedence, Tie
from reactive_realizer.scheduler.unit_lifecycle import UnitLifecycle

MissedPoints = Mapping[Point, TimePeg]
"""Points that will not be reached as planned, with the pegs on which others may depend."""


class DroppedTie(SchedulingFault):
    """A point whose behavior was dropped after others were tied to it."""

    code = "dropped-tie"
    template = "the behavior of {point} is dropped; this behavior keeps the last predicted time"
    point: str


class CutTie(SchedulingFault):
    """A point that was interrupted after others were tied to it."""

    code = "cut-tie"
    template = "{point} was interrupted; this behavior keeps the last predicted time"
    point: str


class NeverComes(SchedulingFault):
    """A behavior tied to a point without a time."""

    code = "never-comes"
    template = "it is dropped: it depends on {point}, which will never come"
    point: str


class StartReleased(SchedulingFault):
    """A block that does not wait for a point any more."""

    code = "start-released"
    template = "it does not wait for {point} any more, which will never come"
    point: str


class TieRelease:
    """Releases behaviors from points that were cut or dropped, and warns each once."""

    def __init__(self, board: PegBoard, blocks: Blocks, units: UnitLifecycle, feedback: BlockFeedback) -> None:
        self._board = board
        self._blocks = blocks
        self._units = units
        self._feedback = feedback

    def missed_by_cut(self, units: Sequence[PlanUnit], time: GlobalTime) -> MissedPoints:
        """The points that behaviors will miss if they are cut at a time."""
        missed: dict[Point, TimePeg] = {}
        for unit in units:
            moved = unit.points[-1] if self._units.cut_scheduled(unit) else None
            ahead = [point for point in unit.ahead() if point is moved or not is_due(point.peg.value, time)]
            missed |= self._pegs_of(unit, ahead)
        return missed

    def missed_by_drop(self, units: Iterable[PlanUnit]) -> MissedPoints:
        """The points that behaviors will miss if they are dropped."""
        missed: dict[Point, TimePeg] = {}
        for unit in units:
            missed |= self._pegs_of(unit, unit.ahead())
        return missed

    def release(self, block: BMLBlock, missed: MissedPoints, kind: type[DroppedTie | CutTie], time: GlobalTime) -> None:
        """Have behaviors that depend on missed points of a continuing block keep their times, with a warning."""
        dependent = _dependents_of({point.behavior for point in missed}, block.kept)
        others = [unit for unit in block.live_units if unit.behavior.id not in dependent]
        living = {point.peg for unit in others for point in unit.ahead()}
        rigid = [unit for unit in block.live_units if unit.behavior.id in dependent and unit.timing.rigid]
        held = {peg: _held_with(peg, rigid) for peg in dict.fromkeys(missed.values()) if not peg.pinned}
        pegs = [peg for peg, each in held.items() if living.isdisjoint(_with_followers(each))]
        with self._board.graph.transaction(f"cut a part of {block.key.block}"):
            for each in dict.fromkeys(chain.from_iterable(held[peg] for peg in pegs)):
                each.pin(each.value)
            block.update_end()
        warned = self.release_from(block.key, pegs, time, kind, began=block.state.plays)
        tied = _tied_points(missed, block.kept)
        for unit in [unit for unit in block.live_units if unit.behavior.id in dependent and unit not in warned]:
            point = tied.get(unit.behavior.id)
            if isinstance(point, Point):
                self._feedback.warn_behavior(unit, kind(point=str(PegKey(*block.key, *point))))

    def release_from(
        self,
        owner: BlockKey,
        cut: Collection[TimePeg],
        now: GlobalTime,
        kind: type[DroppedTie | CutTie],
        *,
        began: bool,
    ) -> set[PlanUnit]:
        """Have behaviors that depend on pinned pegs of a block keep their times; the behaviors that were warned.

        A behavior without such a time is dropped; so is one that has not begun, if the block never began. In other
        blocks, only behaviors that are tied to such a point directly are warned; their dependents stay tied to them.
        """
        warned = set()
        gone = frozenset(cut)
        followed = {follower: peg for peg in cut for follower in (peg, *followers_of(peg))}
        # Another point may be unknown for another reason, such as the end of a wait for an event.
        lost = {follower for peg in cut if peg.value is None for follower in (peg, *followers_of(peg))}
        following = self._blocks.watch.following(followed)
        for block in following:
            self._release_start(block, followed, now)
        for block in following:
            directly = _tied_points(gone, block.kept) if block.key != owner else {}
            dropped = []
            for unit in block.live_units:
                tied = [point.peg for point in unit.ahead() if point.peg in followed]
                if not tied:
                    continue
                never = [peg for peg in tied if peg in lost and peg.value is None]
                point = self._as_written(unit, owner, followed[(never or tied)[0]])
                gives_way = block.gives_way and block.key != owner
                if never or not (began or unit.begun) or (gives_way and not unit.begun):
                    dropped.append(Dropped(unit, NeverComes(point=point)))
                    warned.add(unit)
                elif unit.behavior.id in directly:
                    self._feedback.warn_behavior(unit, kind(point=point))
                    warned.add(unit)
            if dropped:
                self._units.drop(dropped, now)
        return warned

    def _release_start(self, block: BMLBlock, followed: Mapping[TimeCell, TimePeg], now: GlobalTime) -> None:
        """Have a block start without points that were cut before their times were known."""
        holds = {hold: followed[hold] for hold in block.holds if hold in followed and hold.value is None}
        if not holds or block.state.plays:
            return
        with self._board.graph.transaction(f"release the start of {block.key.block}"):
            block.release_start(holds, now)
        for point in dict.fromkeys(peg.name for peg in holds.values()):
            self._feedback.warn_element(block.key, block.description, StartReleased(point=point))

    def _pegs_of(self, unit: PlanUnit, points: Iterable[SyncPoint]) -> dict[Point, TimePeg]:
        pegs = ((Point(unit.behavior.id, point.id), self._board.get(unit.key(point.id))) for point in points)
        return {point: peg for point, peg in pegs if isinstance(peg, TimePeg) and not isinstance(peg, OpenPeg)}

    def _as_written(self, unit: PlanUnit, owner: BlockKey, peg: TimePeg) -> str:
        """The name that a behavior, or else its block, has for a peg, which may be the peg of several points."""
        block = self._blocks.get(unit.block)
        refs = chain(unit.behavior.syncs.values(), block.description.refs if block is not None else ())
        own = (ref for ref in refs if (ref.block or unit.block.block) == owner.block)
        keys = (PegKey(*owner, ref.behavior, ref.sync or "start") for ref in own)
        return next((str(key) for key in keys if self._board.get(key) is peg), peg.name)


def _held_with(peg: TimePeg, rigid: Iterable[PlanUnit]) -> list[TimePeg]:
    """A peg, and the other pegs of rigid behaviors of which a point follows it: these keep their times as a whole."""
    followed = _with_followers([peg])
    ahead = ([point.peg for point in unit.ahead()] for unit in rigid)
    others = (each for pegs in ahead if not followed.isdisjoint(pegs) for each in pegs)
    return [peg, *(each for each in others if each not in followed and not each.pinned)]


def _with_followers(pegs: Iterable[TimePeg]) -> set[TimeCell]:
    return {cell for peg in pegs for cell in (peg, *followers_of(peg))}


def _dependents_of(named: Collection[str], kept: Iterable[Tie | Precedence]) -> set[str]:
    """Ids of the other behaviors that name some behaviors, or share a `synchronize` with them, directly or not.

    A behavior does not depend on those that name it: a speech continues without the nod that is tied to its words.
    """
    dependents: dict[str, set[str]] = {}
    for tie in (tie for tie in kept if isinstance(tie, Tie)):
        ids = {node.behavior for node in tie.nodes if isinstance(node, Point)}
        for id_ in ids:
            dependents.setdefault(id_, set()).update({tie.owner} if tie.owner else ids)
    found, waiting = set(named), list(named)
    while waiting:
        new = dependents.get(waiting.pop(), set()) - found
        found |= new
        waiting += new
    return found.difference(named)


def _tied_points(points: Container[Node], kept: Iterable[Tie | Precedence]) -> dict[str, Node]:
    """By behavior, the first of some points, or pegs from outside, that a constraint ties it to."""
    tied: dict[str, Node] = {}
    for each in kept:
        found = next((node for node in each.nodes if node in points), None)
        if found is not None:
            for node in each.nodes:
                if isinstance(node, Point):
                    tied.setdefault(node.behavior, found)
    return tied
