"""Finds mistakes in BML documents, and behaviors that the scene cannot play."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from reactive_realizer.bml.attribute_types import IdList, Target
from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.block import BehaviorBlock, DefineProc, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.faults import ForeignAttribute, UnknownSync
from reactive_realizer.bml.names import ANTICIPATORS, Location
from reactive_realizer.bml.references import check_references, references_of, standard_points, unknown_block
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engines.animation.faults import NoTarget
from reactive_realizer.errors import Fault, RealizerError, WarningType
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.admission import Admission
from reactive_realizer.scheduler.block_composition import UnknownTargetBlock
from reactive_realizer.scheduler.engine_routing import EngineRouting, Result, RoutedBehavior
from reactive_realizer.scheduler.requests import NoSuchBehavior


class NotInHumanFile(Fault):
    """A reference to an anticipator that the human file does not have."""

    code = "not-in-human-file"
    template = (
        "{reference}: the human file has no anticipator '{anticipator}', so clients must predict it; available: {known}"
    )
    unknown = "anticipator"
    reference: str
    anticipator: str
    known: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """The result of planning the behaviors of a block without playing them.

    Attributes:
        engines: the engine of each behavior, by id; behaviors without an engine are missing.
        units: the planned units, by id.
        faults: of the behaviors that could not be planned.
    """

    engines: Mapping[str, Engine]
    units: Mapping[str, PlanUnit]
    faults: Sequence[Fault]


async def rehearse(block: BehaviorBlock | DefineProc, routing: EngineRouting) -> Rehearsal:
    """Plans the behaviors of a block, in document order.

    The plan ignores the effects of earlier blocks. For an unknown character, no behavior has an engine.
    """
    character = (isinstance(block, BehaviorBlock) and block.character) or routing.characters[0]
    played = routing.route(character, block.behaviors) if character in routing.characters else {}
    units: dict[str, PlanUnit] = {}
    faults: list[Fault] = []
    for id_, routed in played.items():
        place = routed.behavior.location
        try:
            units[id_] = routed.plan(BlockKey(character, block.id), await _prepared(routed), lambda _: None)
        except RealizerError as refused:
            faults.append(refused.fault.located(place.line, place.column))
    return Rehearsal({id_: routed.engine for id_, routed in played.items()}, units, faults)


async def _prepared(routed: RoutedBehavior) -> Result:
    try:
        work = routed.prepare()
        return None if work is None else await work
    except Exception as failure:
        return failure


_UNPLAYABLE = WarningType.CANNOT_CREATE_BEHAVIOR
"""The warning type of valid behaviors that cannot be played; other faults of engines are mistakes in the BML."""


class Findings(NamedTuple):
    """The findings of a document, in its order.

    Attributes:
        mistakes: invalid BML.
        notes: valid BML that this scene cannot play or ignores.
    """

    mistakes: list[Fault]
    notes: list[Fault]


class Checker:
    """Checks documents, one after another.

    A block may refer to all blocks of its document and of earlier ones; it joins, interrupts or starts those before it.
    """

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._routing = EngineRouting({character.id: character.engines for character in realizer.characters.values()})
        self._earlier: set[str] = set()
        self._named: set[str] = set()
        self._procedures: dict[str, None] = {}

    async def check(self, text: bytes) -> Findings:
        """Returns the findings of a document."""
        admission = self._realizer.scheduler.admission(self._procedures)
        mistakes: list[Fault] = []
        notes: list[Fault] = []
        document = parse(text, self._realizer.limits)
        self._named = self._earlier.union(parsed.block.id for parsed in document if parsed.block is not None)
        for parsed in document:
            mistakes += (problem.fault for problem in parsed.problems)
            mistakes += self._refusals(parsed, admission)
            written = parsed.block or parsed.procedure
            if written is not None:
                rehearsal = await rehearse(written, self._routing)
                mistakes += self._inside(written, rehearsal)
                notes += (fault for fault in rehearsal.faults if fault.warning is _UNPLAYABLE)
                notes += _foreign_attributes(written, rehearsal)
                notes += self._remote(written)
            self._remember(parsed)
        return Findings(sorted(mistakes, key=_place), sorted(notes, key=_place))

    def _remember(self, parsed: Parsed) -> None:
        if parsed.procedure is not None:
            self._procedures[parsed.procedure.id] = None
        if parsed.block is not None:
            self._earlier.add(parsed.block.id)

    def _refusals(self, parsed: Parsed, admission: Admission) -> Iterator[Fault]:
        """Faults in how a block relates to earlier ones, or in a definition."""
        if parsed.procedure is not None:
            yield from filter(None, [admission.admit_procedure(parsed.procedure)])
        if parsed.block is not None:
            yield from filter(None, [admission.admit(parsed.block, parsed.failed)])
            yield from self._unknown_others(parsed.block)

    def _inside(self, block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
        def points(behavior: Behavior) -> Collection[str] | None:
            """The sync points of a behavior, including those of its motion; None if it cannot be planned."""
            unit = rehearsal.units.get(behavior.id) if behavior.open_points else None
            return standard_points(behavior) if unit is None else unit.timing.points

        yield from (problem.fault for problem in check_references(block, points))
        yield from self._unknown_blocks(block)
        yield from self._unknown_predictions(block)
        yield from _unknown_targets(block, self._realizer.world)
        yield from _unknown_behaviors(block)
        yield from _unknown_points(block, rehearsal)

    def _unknown_others(self, block: BehaviorBlock) -> Iterator[Fault]:
        """Unknown blocks that a block joins, interrupts or starts."""
        for attribute in attributes_of(BehaviorBlock):
            names = getattr(block, attribute.field) if isinstance(attribute.type, IdList) else ()
            for name in names:
                if name not in self._earlier:
                    fault = UnknownTargetBlock(attribute=attribute.name, block=name)
                    yield fault.located(block.location.line, block.location.column)

    def _unknown_blocks(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        known = {None, ANTICIPATORS, block.id, *self._named}
        for _, location, ref in references_of(block):
            if ref.block not in known:
                yield unknown_block(ref, block).located(location.line, location.column)

    def _unknown_predictions(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        """References to points that anticipators of the human file do not have."""
        for _, location, ref in references_of(block):
            if ref.block == ANTICIPATORS and ref.behavior is not None and ref.sync is not None:
                try:
                    self._realizer.board.check_point(ref.behavior, ref.sync, str(ref))
                except RealizerError as unknown:
                    yield unknown.fault.located(location.line, location.column)

    def _remote(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        """References to points of anticipators that are not in the human file: clients may predict these."""
        known = self._realizer.anticipators
        for _, location, ref in references_of(block):
            if ref.block == ANTICIPATORS and ref.behavior is not None and ref.behavior not in known:
                fault = NotInHumanFile(reference=str(ref), anticipator=ref.behavior, known=tuple(known))
                yield fault.located(location.line, location.column)


def _unknown_points(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
    """Attributes for sync points that the motion of their behavior does not have."""
    for behavior in block.behaviors:
        unit = rehearsal.units.get(behavior.id)
        for sync, ref in behavior.syncs.items():
            if behavior.open_points and unit is not None and sync not in unit.timing.points:
                known = ", ".join(unit.timing.points)
                fault = UnknownSync(reference=str(ref), behavior=behavior.id, sync=sync, known=known)
                yield fault.located(behavior.location.line, behavior.location.column)


def _foreign_attributes(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
    """Attributes of other namespaces that the engine of their behavior ignores; they are legal BML.

    The attributes of a foreign behavior without an engine are not reported, because only an engine can judge them.
    """
    if isinstance(block, BehaviorBlock):
        yield from _foreign(block.extensions, block.location)
    for behavior in block.behaviors:
        engine = rehearsal.engines.get(behavior.id)
        known = engine.extensions if engine is not None else frozenset()
        if engine is not None or not isinstance(behavior, ForeignBehavior):
            yield from _foreign((name for name in behavior.extensions if name not in known), behavior.location)


def _foreign(attributes: Iterable[tuple[str, str]], place: Location) -> Iterator[Fault]:
    for namespace, name in attributes:
        yield ForeignAttribute(attribute=name, namespace=namespace, line=place.line, column=place.column)


def _unknown_targets(block: BehaviorBlock | DefineProc, world: World) -> Iterator[Fault]:
    for behavior in block.behaviors:
        for target in _targets(behavior):
            if world.position(target) is None:
                fault = NoTarget(target=target, known=tuple(world.targets))
                yield fault.located(behavior.location.line, behavior.location.column)


def _unknown_behaviors(block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
    """Unknown behaviors of the block itself that its parameter changes name."""
    known = {behavior.id for behavior in block.behaviors}
    changes = (each for each in block.behaviors if isinstance(each, ParameterValueChange))
    for change in changes:
        if change.target_block in {None, block.id} and change.target_behavior not in known:
            fault = NoSuchBehavior(block=block.id, behavior=change.target_behavior)
            yield fault.located(change.location.line, change.location.column)


def _targets(behavior: Behavior) -> Iterator[str]:
    """The targets of a behavior that are in the world; targets of other behaviors are blocks and behaviors."""
    attributes = (each for each in attributes_of(type(behavior)) if isinstance(each.type, Target))
    return (getattr(behavior, each.field) for each in attributes)


def _place(fault: Fault) -> tuple[int, int]:
    return fault.line or 1, fault.column or 1
