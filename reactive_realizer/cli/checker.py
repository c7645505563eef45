"""What is wrong with the blocks of a document, and what of them could not be played."""

from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

from reactive_realizer.bml.attribute_types import Names, Target
from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import ANTICIPATORS, Location
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.references import check_references, references_of, standard_points, unknown_block
from reactive_realizer.cli.rehearsal import Rehearsal, rehearse
from reactive_realizer.embodiment.world import World
from reactive_realizer.errors import Fault, WarningType
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.admission import Admission
from reactive_realizer.scheduler.cast import Cast

_UNPLAYABLE = WarningType.CANNOT_CREATE_BEHAVIOR
"""What else an engine refuses is a mistake, and found before it is asked."""


class Findings(NamedTuple):
    """What is to be said of a document, in its order.

    Attributes:
        mistakes: of whoever wrote it.
        notes: what is no mistake, and cannot be made of what this scene has, or means nothing in it.
    """

    mistakes: list[Fault]
    notes: list[Fault]


class Checker:
    """Reads documents one after the other.

    A block may refer to all blocks of its document and of earlier ones; it joins, interrupts or starts those before it.
    """

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._cast = Cast({character.id: character.engines for character in realizer.characters.values()})
        self._earlier: set[str] = set()
        self._named: set[str] = set()
        self._procedures: dict[str, None] = {}

    async def check(self, text: bytes) -> Findings:
        """What is wrong with a document."""
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
                rehearsal = await rehearse(written, self._cast)
                mistakes += self._inside(written, rehearsal)
                notes += (fault for fault in rehearsal.faults if fault.kind.warning is _UNPLAYABLE)
                notes += _foreign_attributes(written, rehearsal)
            self._remember(parsed)
        return Findings(sorted(mistakes, key=_place), sorted(notes, key=_place))

    def _remember(self, parsed: Parsed) -> None:
        if parsed.procedure is not None:
            self._procedures[parsed.procedure.id] = None
        if parsed.block is not None:
            self._earlier.add(parsed.block.id)

    def _refusals(self, parsed: Parsed, admission: Admission) -> Iterator[Fault]:
        """What is wrong with how a block joins those before it, or a procedure."""
        if parsed.procedure is not None:
            yield from filter(None, [admission.define(parsed.procedure)])
        if parsed.block is not None:
            yield from filter(None, [admission.take(parsed.block, parsed.failed)])
            yield from self._unknown_others(parsed.block)

    def _inside(self, block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
        def points(behavior: Behavior) -> Collection[str] | None:
            """Its sync points, those of what would play it among them; None where nothing would."""
            unit = rehearsal.units.get(behavior.id) if behavior.OPEN_POINTS else None
            return standard_points(behavior) if unit is None else unit.timing.points

        yield from (problem.fault for problem in check_references(block, points))
        yield from self._unknown_blocks(block)
        yield from _unknown_targets(block, self._realizer.world)
        yield from _unknown_behaviors(block)
        yield from _unknown_points(block, rehearsal)

    def _unknown_others(self, block: BehaviorBlock) -> Iterator[Fault]:
        """Blocks that it joins, interrupts or starts."""
        for attribute in attributes_of(BehaviorBlock):
            names = getattr(block, attribute.field) if isinstance(attribute.type, Names) else ()
            for name in names:
                if name not in self._earlier:
                    details = {"attribute": attribute.name, "block": name}
                    yield Fault("unknown-target-block", details, block.location.line, block.location.column)

    def _unknown_blocks(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        known = {None, ANTICIPATORS, block.id, *self._named}
        for _, location, ref in references_of(block):
            if ref.block not in known:
                yield unknown_block(ref, block).located(location.line, location.column)


def _unknown_points(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
    """Attributes that tie points which what plays their behavior has not."""
    for behavior in block.behaviors:
        unit = rehearsal.units.get(behavior.id)
        for sync, ref in behavior.syncs.items():
            if behavior.OPEN_POINTS and unit is not None and sync not in unit.timing.points:
                known = ", ".join(unit.timing.points)
                details = {"behavior": behavior.id, "sync": sync, "reference": str(ref), "known": known}
                yield Fault("unknown-sync", details, behavior.location.line, behavior.location.column)


def _foreign_attributes(block: BehaviorBlock | DefineProc, rehearsal: Rehearsal) -> Iterator[Fault]:
    """Attributes of other namespaces that who plays their behavior does not know; they are legal BML.

    Whoever plays a behavior of another namespace may know those that it has; if nobody does, nobody here can judge.
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
        yield Fault("foreign-attribute", {"attribute": name, "namespace": namespace}, place.line, place.column)


def _unknown_targets(block: BehaviorBlock | DefineProc, world: World) -> Iterator[Fault]:
    for behavior in block.behaviors:
        for target in _targets(behavior):
            if world.position(target) is None:
                details = {"target": target, "known": ", ".join(world.targets)}
                yield Fault("no-target", details, behavior.location.line, behavior.location.column)


def _unknown_behaviors(block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
    """Behaviors of the block itself of which something is to be changed."""
    known = {behavior.id for behavior in block.behaviors}
    changes = (each for each in block.behaviors if isinstance(each, ParameterValueChange))
    for change in changes:
        if change.target_block in {None, block.id} and change.target_behavior not in known:
            details = {"block": block.id, "behavior": change.target_behavior}
            yield Fault("no-such-behavior", details, change.location.line, change.location.column)


def _targets(behavior: Behavior) -> Iterator[str]:
    """Those in the world: others are blocks and behaviors."""
    attributes = (each for each in attributes_of(type(behavior)) if isinstance(each.type, Target))
    return (getattr(behavior, each.field) for each in attributes)


def _place(fault: Fault) -> tuple[int, int]:
    return fault.line or 1, fault.column or 1
