"""Finds mistakes in BML documents, and behaviors that the scene cannot play."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import chain, islice
from typing import NamedTuple

from reactive_realizer.bml.attribute_types import IdList
from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.block import BLOCK_EXTENSIONS, BehaviorBlock, DefineProc, Parsed, Problem
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.faults import ForeignAttribute
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.reference_faults import UnknownSync
from reactive_realizer.bml.references import (
    check_references,
    predictions_of,
    references_of,
    standard_points,
    unknown_block,
    unknown_block_point,
)
from reactive_realizer.bml.sync_ref import named_point
from reactive_realizer.errors import Fault, RealizerError, WarningType
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.scheduler.block_composition import UnknownTargetBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.rehearsal import Rehearsal, Turns, rehearse, rehearse_slowly
from reactive_realizer.scheduler.requests import NoSuchBehavior

_UNPLAYABLE = frozenset(
    {
        WarningType.CANNOT_CREATE_BEHAVIOR,
        WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED,
        WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED,
    }
)
"""The warning types of valid behaviors that cannot be played; other faults of engines are mistakes in the BML."""


_AT_ONCE = 50
"""Problems that are found in one turn."""


class NotInHumanFile(Fault):
    """A reference to an anticipator that the human file does not have."""

    code = "not-in-human-file"
    template = (
        "{reference}: the human file has no anticipator '{anticipator}', so clients must predict it; available: {known}"
    )
    reference: str
    anticipator: str
    known: tuple[str, ...]


class Findings(NamedTuple):
    """The findings in a block or procedure.

    Attributes:
        mistakes: invalid BML.
        notes: valid BML that this scene cannot play or ignores.
    """

    mistakes: list[Problem]
    notes: list[Problem]


class DocumentChecker:
    """Checks the blocks and procedures of documents, one after another.

    A block may refer to all blocks of its document and to those alive; it joins, interrupts or starts those before it.

    Args:
        routing: to the engines that would play the behaviors.
        board: of the anticipators.
        alive: the blocks that are alive, or will be before the first document enters.
        has_ended: whether there has been another block with an id.
    """

    def __init__(
        self, routing: EngineRouting, board: PegBoard, alive: Iterable[BehaviorBlock], has_ended: Callable[[str], bool]
    ) -> None:
        self._routing = routing
        self._board = board
        self._alive = _by_id(alive)
        self._has_ended = has_ended
        self._named: Mapping[str, Sequence[BehaviorBlock]] = {}

    def begin(self, document: Sequence[Parsed]) -> None:
        """Begins with a document, to whose blocks all of its blocks may refer."""
        written = (parsed.block for parsed in document if parsed.block is not None)
        self._named = _by_id((*chain.from_iterable(self._alive.values()), *written))

    async def check(self, parsed: Parsed, refused: Fault | None, turns: Turns | None = None) -> Findings:
        """The findings in the next block or procedure of the document.

        Args:
            parsed: the block or procedure, with what could not be read of it.
            refused: why it may not enter; None if it may.
            turns: to check some behaviors in each; None to plan them with slow work, in a scene that does not play.
        """
        found, block = Findings(list(parsed.problems), []), parsed.written
        if block is None:
            return found
        if refused is not None:
            found.mistakes.append(_problem(refused, block))
        rehearsing = rehearse_slowly(block, self._routing) if turns is None else rehearse(block, self._routing, turns)
        rehearsal = await rehearsing
        await _add(found.mistakes, self._mistakes(block, rehearsal), turns)
        await _add(found.notes, chain(_foreign_attributes(block, rehearsal), self._remote(block)), turns)
        for problem in rehearsal.problems:
            (found.notes if problem.fault.warning in _UNPLAYABLE else found.mistakes).append(problem)
        if isinstance(block, BehaviorBlock):
            self._alive.setdefault(block.id, []).append(block)
        return found

    def _mistakes(self, block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Problem]:
        def points(behavior: Behavior) -> Collection[str] | None:
            """The sync points of a behavior, including those of its motion; None if they are not known."""
            known = rehearsal.points.get(behavior.id) if behavior.open_points else None
            return standard_points(behavior) if known is None else known

        if isinstance(block, BehaviorBlock):
            yield from self._unknown_others(block)
        yield from check_references(block, points, self._described)
        yield from self._unknown_blocks(block)
        yield from self._unknown_predictions(block)
        yield from _unknown_behaviors(block)
        yield from _unknown_points(block, rehearsal)

    def _unknown_others(self, block: BehaviorBlock) -> Iterator[Problem]:
        """Unknown blocks that a block joins, interrupts or starts."""
        for attribute in attributes_of(BehaviorBlock):
            names = getattr(block, attribute.field) if isinstance(attribute.type, IdList) else ()
            for name in names:
                if name not in self._alive and not self._has_ended(name):
                    yield _problem(
                        UnknownTargetBlock(attribute=attribute.name, block=name, known=tuple(self._alive)), block
                    )

    def _unknown_blocks(self, block: BehaviorBlock | DefineProc) -> Iterator[Problem]:
        for id_, location, ref in references_of(block):
            if ref.block not in (None, ANTICIPATORS, block.id) and ref.block not in self._named:
                others = (name for name in self._named if name != block.id)
                yield Problem(unknown_block(ref, block, others).located(location.line, location.column), id_)
            if ref.block not in {None, block.id} and ref.behavior is None:
                fault = unknown_block_point(ref, self._described(ref.block))
                if fault is not None:
                    yield Problem(fault.located(location.line, location.column), id_)

    def _described(self, id_: str) -> Sequence[BehaviorBlock]:
        """The blocks with an id; none if one uses a procedure, whose behaviors are not known before it enters."""
        blocks = self._named.get(id_, ())
        return () if any(block.procedure is not None and not block.behaviors for block in blocks) else blocks

    def _unknown_predictions(self, block: BehaviorBlock | DefineProc) -> Iterator[Problem]:
        """References to points that anticipators of the human file do not have."""
        for id_, location, anticipator, ref in predictions_of(block):
            try:
                self._board.check_point(anticipator, ref.sync or "", str(ref))
            except RealizerError as unknown:
                yield Problem(unknown.fault.located(location.line, location.column), id_)

    def _remote(self, block: BehaviorBlock | DefineProc) -> Iterator[Problem]:
        """References to points of anticipators that are not known yet: clients may predict these."""
        known = tuple(self._board.anticipators)
        for id_, location, anticipator, ref in predictions_of(block):
            if anticipator not in known:
                mistyped = self._board.mistyped_anticipator(anticipator, str(ref))
                fault = mistyped or NotInHumanFile(reference=str(ref), anticipator=anticipator, known=known)
                yield Problem(fault.located(location.line, location.column), id_)


async def _add(found: list[Problem], problems: Iterator[Problem], turns: Turns | None) -> None:
    """Adds problems, some in each turn."""
    while some := list(islice(problems, _AT_ONCE)):
        found += some
        if turns is not None:
            async with turns:
                pass


def _by_id(blocks: Iterable[BehaviorBlock]) -> dict[str, list[BehaviorBlock]]:
    found: dict[str, list[BehaviorBlock]] = {}
    for block in blocks:
        found.setdefault(block.id, []).append(block)
    return found


def _unknown_points(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Problem]:
    """Attributes for sync points that the motion of their behavior does not have."""
    for behavior in block.behaviors:
        known = rehearsal.points.get(behavior.id)
        for sync, ref in behavior.syncs.items():
            if behavior.open_points and known is not None and named_point(sync, known) not in known:
                fault = UnknownSync(reference=str(ref), behavior=behavior.id, sync=sync, known=tuple(known))
                yield _problem(fault, block, behavior)


def _foreign_attributes(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Problem]:
    """Attributes of other namespaces that the engine of their behavior ignores; they are legal BML.

    The attributes of a foreign behavior without an engine are not reported, because only an engine can judge them.
    """
    if isinstance(block, BehaviorBlock):
        unknown = (name for name in block.extensions if name not in BLOCK_EXTENSIONS)
        yield from (_problem(fault, block) for fault in ForeignAttribute.of(unknown))
    for behavior in block.behaviors:
        engine = rehearsal.engines.get(behavior.id)
        known = engine.extensions if engine is not None else frozenset()
        if engine is not None or not isinstance(behavior, ForeignBehavior):
            unknown = (name for name in behavior.extensions if name not in known)
            yield from (_problem(fault, block, behavior) for fault in ForeignAttribute.of(unknown))


def _unknown_behaviors(block: BehaviorBlock | DefineProc) -> Iterator[Problem]:
    """Unknown behaviors of the block itself that its parameter changes name."""
    known = tuple(behavior.id for behavior in block.behaviors)
    changes = (each for each in block.behaviors if isinstance(each, ParameterValueChange))
    for change in changes:
        if change.target_block in {None, block.id} and change.target_behavior not in known:
            fault = NoSuchBehavior(block=block.id, behaviors=(change.target_behavior,), known=known)
            yield _problem(fault, block, change)


def _problem(fault: Fault, block: BehaviorBlock | DefineProc, behavior: Behavior | None = None) -> Problem:
    """The problem of a block, or of a behavior of it."""
    place = (behavior or block).location
    id_ = block.id if behavior is None else f"{block.id}:{behavior.id}"
    return Problem(fault.located(place.line, place.column), id_)
