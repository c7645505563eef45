"""From the inside of a block or procedure to behaviors and constraints."""

from collections.abc import Iterator
from typing import Final

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behavior_reader import read_behavior
from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.constraint import Constraint
from reactive_realizer.bml.constraint_reader import CONSTRAINTS, read_constraint
from reactive_realizer.bml.drafts.persistence import persisting
from reactive_realizer.bml.drafts.rewriting import modernize
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import Tree, children_of, is_continuous, is_core, name_of, namespace_of, shown
from reactive_realizer.errors import Fault, RealizerError

_REQUIRED: Final = "required"
_CONSTRAINT: Final = "constraint"


class ContentReader:
    """Reads what stands inside; what of it cannot be read is dropped with a problem.

    Attributes:
        failed: whether something dropped was required.
    """

    def __init__(self, source: Source, id_: str) -> None:
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
        """In document order, not more than a block may have behaviors."""
        most = self._source.limits.behaviors_per_block
        first, others = sorted(self._problems, key=_position)[:most], self._problems[most:]
        if others:
            more = self._source.fault(self._source.tree, "more-problems", number=len(others))
            first.append(Problem(more, self._id))
        return tuple(first)

    def read(self) -> None:
        """Read everything.

        Raises:
            RealizerError: ``too-many-behaviors``, or the texts to be kept of them are too long.
        """
        children = list(self._children(self._source.tree, required=False))
        behaviors = [child for child in children if not _is(child[0], _CONSTRAINT)]
        self._check_number(len(behaviors))
        for tree, _ in behaviors:
            if is_continuous(tree) and not tree.get("id"):
                self._source.names.give(tree)
        for order, (tree, required) in enumerate(behaviors):
            self._read_behavior(tree, order, required)
        for tree, required in children:
            if _is(tree, _CONSTRAINT):
                self._read_constraints(tree, required)
        for behavior in persisting([self._behaviors[id_] for id_ in self._drafts], self._constraints):
            self._behaviors[behavior.id] = behavior

    def report(self, faults: list[Fault], part: str | None = None) -> None:
        """Take problems of the block, or of a behavior or constraint in it."""
        name = shown(part or "")
        place = f"{self._id}:{name}" if name else self._id
        self._problems += [Problem(fault, place) for fault in faults]

    def _check_number(self, size: int) -> None:
        limit = self._source.limits.behaviors_per_block
        if size > limit:
            raise RealizerError(self._source.fault(self._source.tree, "too-many-behaviors", size=size, limit=limit))

    def _children(self, holder: Tree, required: bool) -> Iterator[tuple[Tree, bool]]:
        """Behaviors and constraints in document order, and whether they are required."""
        self.report(self._source.stray_text(holder))
        for child in holder:
            if _is(child, _REQUIRED):
                self.report(self._source.unread_attributes(child, []))
                yield from self._children(child, required=True)
            else:
                yield child, required

    def _read_behavior(self, tree: Tree, order: int, required: bool) -> None:
        notes: list[Fault] = []
        try:
            if _is_draft(tree):
                modernize(tree, self._source)
            behavior = read_behavior(tree, self._source, order, required, notes)
            if behavior.id in self._behaviors:
                raise RealizerError(self._source.fault(tree, "duplicate-id", id=behavior.id))
        except RealizerError as refused:
            self._unread.add(tree.get("id", ""))
            self._drop(refused.fault, required, tree.get("id"))
        else:
            self._behaviors[behavior.id] = behavior
            if _is_draft(tree):
                self._drafts.append(behavior.id)
            self.report(notes, behavior.id)

    def _read_constraints(self, tree: Tree, required: bool) -> None:
        constraint_id = tree.get("id")
        self.report(self._source.unread(tree, ["id"], CONSTRAINTS), constraint_id)
        for child in children_of(tree, *CONSTRAINTS):
            notes: list[Fault] = []
            try:
                if _is_draft(child):
                    modernize(child, self._source)
                self._constraints.append(read_constraint(child, constraint_id, self._source, required, notes))
            except RealizerError as refused:
                self._drop(refused.fault, required, constraint_id)
            else:
                self.report(notes, constraint_id)

    def _drop(self, fault: Fault, required: bool, part: str | None) -> None:
        self.failed |= required
        self.report([fault], part)


def _is(tree: Tree, name: str) -> bool:
    return is_core(tree) and name_of(tree) == name


def _is_draft(tree: Tree) -> bool:
    return namespace_of(tree) == ""


def _position(problem: Problem) -> tuple[int, int]:
    return problem.fault.line or 0, problem.fault.column or 0
