"""Reads the content of a block or procedure: behaviors and constraints."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behavior_reader import read_behavior
from reactive_realizer.bml.behaviors import Gaze, Posture
from reactive_realizer.bml.block import Constraint, Order, OrderKind, Problem, Synchronize
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.drafts import modernize
from reactive_realizer.bml.emitters import replace_emitter
from reactive_realizer.bml.extensions import Noise, lasts
from reactive_realizer.bml.faults import DuplicateId, MissingElement, MoreProblems, TooManyBehaviors
from reactive_realizer.bml.smartbody.behaviors import adapt, is_of_smartbody
from reactive_realizer.bml.speech_faults import LipsLeftOut
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import Tree, children_of, is_continuous, is_core, name_of, namespace_of
from reactive_realizer.errors import Fault, RealizerError, quoted

_REQUIRED: Final = "required"
_CONSTRAINT: Final = "constraint"
_LIPS: Final = frozenset({"lips", "curves"})
_SPEECH: Final = "speech"
_SYNCHRONIZE: Final = "synchronize"
_ENDING: Final = frozenset({"relax", "end"})
_CONSTRAINTS: Final = (_SYNCHRONIZE, *OrderKind)
"""The elements that a ``<constraint>`` may contain."""


class ContentReader:
    """Reads the content of a block; a behavior or constraint that cannot be read is dropped with a problem.

    Attributes:
        failed: whether a dropped one was required.
    """

    def __init__(self, source: BlockSource, id_: str) -> None:
        self.failed = False
        self._source = source
        self._id = id_
        self._behaviors: dict[str, Behavior] = {}
        self._drafts: list[str] = []
        self._constraints: list[Constraint] = []
        self._unread: set[str] = set()
        self._problems: list[Problem] = []

    @property
    def behaviors(self) -> tuple[Behavior, ...]:
        """In document order."""
        return tuple(self._behaviors.values())

    @property
    def constraints(self) -> tuple[Constraint, ...]:
        """In document order."""
        return tuple(self._constraints)

    @property
    def unread(self) -> frozenset[str]:
        """Ids of the behaviors that cannot be read."""
        return frozenset(self._unread.difference(self._behaviors))

    @property
    def problems(self) -> tuple[Problem, ...]:
        """In document order, not more than the limit, and one for the rest."""
        most = self._source.limits.reported_problems
        first, others = sorted(self._problems, key=_position)[:most], self._problems[most:]
        if others:
            more = self._source.located(self._source.tree, MoreProblems(number=len(others)))
            first.append(Problem(more, self._id))
        return tuple(first)

    def read(self) -> None:
        """Reads everything.

        Raises:
            RealizerError: ``too-many-behaviors``, or ``too-many-bytes`` in the copies kept of them.
        """
        children = self._without_lips(list(self._children(self._source.tree, required=False)))
        constraints = [child for child in children if _is(child[0], _CONSTRAINT)]
        behaviors = [child for child in children if not _is(child[0], _CONSTRAINT)]
        self._check_number(len(behaviors))
        for tree, _ in behaviors:
            if (is_continuous(tree) or self._source.ids.draft) and not tree.get("id"):
                self._source.ids.give(tree)
        for order, (tree, required) in enumerate(behaviors):
            self._read_behavior(tree, order, required)
        for tree, required in constraints:
            self._read_constraints(tree, required)
        for behavior in self._persistent():
            self._behaviors[behavior.id] = replace(behavior, persistent=True)

    def _without_lips(self, children: list[tuple[Tree, bool]]) -> list[tuple[Tree, bool]]:
        """The children except shapes of the mouth, which speech files of SmartBody list beside the speech."""
        lips = [child for child, _ in children if _is_draft(child) and name_of(child) in _LIPS]
        if lips and not any(name_of(child) == _SPEECH for child, _ in children):
            names = tuple(dict.fromkeys(map(name_of, lips)))
            self.report([self._source.located(lips[0], LipsLeftOut(elements=names))])
        return [child for child in children if child[0] not in lips]

    def _persistent(self) -> list[Behavior]:
        """The persistent behaviors, those that last, and gazes, postures and noise of drafts, if their end is not tied.

        Thesis 6.3 and C.4.
        """
        tied = (ref for tie in self._constraints if isinstance(tie, Synchronize) for ref in tie.refs)
        ended = {ref.behavior for ref in tied if ref.block is None and ref.sync in _ENDING}
        may = [each for each in self._behaviors.values() if lasts(each) or self._is_draft_pose(each)]
        return [each for each in may if each.id not in ended and not _ENDING & set(each.syncs)]

    def _is_draft_pose(self, behavior: Behavior) -> bool:
        """Return whether a behavior of a draft persists without an end: a gaze, a posture or noise, but not a shift."""
        return behavior.id in self._drafts and type(behavior) in (Gaze, Posture, Noise)

    def report(self, faults: list[Fault], part: str | None = None) -> None:
        """Adds problems of the block, or of the behavior or constraint with an id."""
        name = quoted(part or "")
        place = f"{self._id}:{name}" if name else self._id
        self._problems += [Problem(fault, place) for fault in faults]

    def _check_number(self, size: int) -> None:
        limit = self._source.limits.behaviors_per_block
        if size > limit:
            raise RealizerError(self._source.located(self._source.tree, TooManyBehaviors(size=size, limit=limit)))

    def _children(self, holder: Tree, required: bool) -> Iterator[tuple[Tree, bool]]:
        """The elements of behaviors and constraints in document order, and whether each is required."""
        self.report(self._source.stray_text(holder))
        for child in holder:
            if _is(child, _REQUIRED):
                self.report(self._source.unknown_attributes(child, []))
                yield from self._children(child, required=True)
            else:
                yield child, required

    def _read_behavior(self, tree: Tree, order: int, required: bool) -> None:
        notes: list[Fault] = []
        draft = is_of_smartbody(tree)
        try:
            if draft:
                notes += [*adapt(tree, self._source), *modernize(tree, self._source)]
            replace_emitter(tree, self._source)
            behavior = read_behavior(tree, self._source, order, required, notes)
            if behavior.id in self._behaviors:
                raise RealizerError(self._source.located(tree, DuplicateId(element=name_of(tree), id=behavior.id)))
        except RealizerError as refused:
            self._unread.add(tree.get("id", ""))
            self._drop(refused.fault, required, tree.get("id"))
        else:
            self._behaviors[behavior.id] = behavior
            if draft:
                self._drafts.append(behavior.id)
            self.report(notes, behavior.id)

    def _read_constraints(self, tree: Tree, required: bool) -> None:
        constraint_id = tree.get("id")
        self.report(self._source.unknown_content(tree, ["id"], _CONSTRAINTS), constraint_id)
        for child in children_of(tree, *_CONSTRAINTS):
            notes: list[Fault] = []
            try:
                if _is_draft(child):
                    notes += modernize(child, self._source)
                self._constraints.append(_read_constraint(child, constraint_id, self._source, required, notes))
            except RealizerError as refused:
                self._drop(refused.fault, required, constraint_id)
            else:
                self.report(notes, constraint_id)

    def _drop(self, fault: Fault, required: bool, part: str | None) -> None:
        self.failed |= required
        self.report([fault], part)


def _read_constraint(
    tree: Tree, constraint_id: str | None, source: BlockSource, required: bool, notes: list[Fault]
) -> Constraint:
    """The constraint in a child of a ``<constraint>``.

    Args:
        tree: the child, one of `_CONSTRAINTS`.
        constraint_id: of the ``<constraint>`` around it.
        source: its block.
        required: whether the block fails without it.
        notes: receives the faults that do not prevent reading it.

    Raises:
        RealizerError: a reference is missing or bad.
    """
    location = source.location(tree)
    if name_of(tree) == _SYNCHRONIZE:
        notes += source.unknown_content(tree, [], ["sync"])
        refs = _refs(tree, 2, source, notes)
        return Synchronize(id=constraint_id, refs=refs, required=required, location=location)
    notes += source.unknown_content(tree, ["ref"], ["sync"])
    return Order(
        kind=OrderKind(name_of(tree)),
        id=constraint_id,
        ref=source.ref(tree, "ref"),
        refs=_refs(tree, 1, source, notes),
        required=required,
        location=location,
    )


def _refs(tree: Tree, least: int, source: BlockSource, notes: list[Fault]) -> tuple[SyncRef, ...]:
    syncs = children_of(tree, "sync")
    if len(syncs) < least:
        raise RealizerError(
            source.located(tree, MissingElement(element=name_of(tree), children=" and ".join(["<sync>"] * least)))
        )
    for sync in syncs:
        notes += source.unknown_content(sync, ["ref"])
    return tuple(source.ref(sync, "ref") for sync in syncs)


def _is(tree: Tree, name: str) -> bool:
    return is_core(tree) and name_of(tree) == name


def _is_draft(tree: Tree) -> bool:
    return namespace_of(tree) == ""


def _position(problem: Problem) -> tuple[int, int]:
    return problem.fault.line or 0, problem.fault.column or 0
