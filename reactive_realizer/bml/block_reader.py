"""From a top-level element to a block."""

from collections.abc import Iterator
from itertools import chain
from typing import Any, Final

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behavior_reader import read_behavior
from reactive_realizer.bml.block import BehaviorBlock, Parsed, Problem
from reactive_realizer.bml.composition import Joining
from reactive_realizer.bml.constraint import Constraint
from reactive_realizer.bml.constraint_reader import CONSTRAINTS, read_constraint
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.root_builder import Root
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import Tree, children_of, extensions_of, is_continuous, is_core, name_of, shown
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits

_ID, *_OTHERS = attributes_of(BehaviorBlock)
_PLAIN: Final = [each.name for each in (_ID, *_OTHERS) if not each.continuous]
_CONTINUOUS: Final = frozenset(name for each in _OTHERS if each.continuous for name in each.spellings)
_REQUIRED: Final = "required"
_CONSTRAINT: Final = "constraint"


class BlockReader:
    """Reads one block; what of it cannot be read is dropped with a problem."""

    def __init__(self, root: Root, limits: Limits) -> None:
        self._source = Source(root, limits)
        self._tree = root.tree
        self._limits = limits
        self._id = BLOCK
        self._behaviors: dict[str, Behavior] = {}
        self._constraints: list[Constraint] = []
        self._problems: list[Problem] = []
        self._failed = False

    def read(self) -> Parsed:
        """The block and its problems."""
        try:
            self._id = self._read_id()
            attributes = self._read_attributes()
            self._read_children()
        except RealizerError as refused:
            return Parsed(None, (Problem(refused.fault, self._id),))
        block = BehaviorBlock(
            id=self._id,
            **attributes,
            behaviors=tuple(self._behaviors.values()),
            constraints=tuple(self._constraints),
            extensions=extensions_of(self._tree, _CONTINUOUS),
            location=self._source.location(self._tree),
        )
        return Parsed(block, self._ordered_problems(), self._failed)

    def _read_id(self) -> str:
        if not is_core(self._tree) or name_of(self._tree) != "bml":
            raise self._error("not-bml")
        if not self._tree.get("id", "").strip():
            raise self._error("no-block-id")
        return str(self._source.values(self._tree, [_ID])["id"])

    def _read_attributes(self) -> dict[str, Any]:
        """Those that can be read; the others have their defaults."""
        values: dict[str, Any] = {}
        for attribute in _OTHERS:
            try:
                values |= self._source.values(self._tree, [attribute])
            except RealizerError as refused:
                self._report([refused.fault])
        self._report(self._source.unread_attributes(self._tree, _PLAIN))
        joining = values.pop("composition", Joining())
        return values | {
            "composition": joining.composition,
            "append_after": _each_once(joining.append_after, values.get("append_after", ())),
            "chunk_after": _each_once(joining.chunk_after, values.get("chunk_after", ())),
        }

    def _read_children(self) -> None:
        children = list(self._children(self._tree, required=False))
        behaviors = [child for child in children if not _is(child[0], _CONSTRAINT)]
        if len(behaviors) > self._limits.behaviors_per_block:
            raise self._error("too-many-behaviors", size=len(behaviors), limit=self._limits.behaviors_per_block)
        for tree, _ in behaviors:
            if is_continuous(tree) and not tree.get("id"):
                self._source.name(tree)
        for order, (tree, required) in enumerate(behaviors):
            self._read_behavior(tree, order, required)
        for tree, required in children:
            if _is(tree, _CONSTRAINT):
                self._read_constraints(tree, required)

    def _children(self, holder: Tree, required: bool) -> Iterator[tuple[Tree, bool]]:
        """Behaviors and constraints in document order, and whether they are required."""
        self._report(self._source.stray_text(holder))
        for child in holder:
            if _is(child, _REQUIRED):
                self._report(self._source.unread_attributes(child, []))
                yield from self._children(child, required=True)
            else:
                yield child, required

    def _read_behavior(self, tree: Tree, order: int, required: bool) -> None:
        notes: list[Fault] = []
        try:
            behavior = read_behavior(tree, self._source, order, required, notes)
            if behavior.id in self._behaviors:
                raise RealizerError(self._source.fault(tree, "duplicate-id", id=behavior.id))
        except RealizerError as refused:
            self._drop(refused.fault, required, tree.get("id"))
        else:
            self._behaviors[behavior.id] = behavior
            self._report(notes, behavior.id)

    def _read_constraints(self, tree: Tree, required: bool) -> None:
        constraint_id = tree.get("id")
        self._report(self._source.unread(tree, ["id"], CONSTRAINTS), constraint_id)
        for child in children_of(tree, *CONSTRAINTS):
            notes: list[Fault] = []
            try:
                self._constraints.append(read_constraint(child, constraint_id, self._source, required, notes))
            except RealizerError as refused:
                self._drop(refused.fault, required, constraint_id)
            else:
                self._report(notes, constraint_id)

    def _ordered_problems(self) -> tuple[Problem, ...]:
        """In document order, not more than a block may have behaviors."""
        most = self._limits.behaviors_per_block
        first, others = sorted(self._problems, key=_position)[:most], self._problems[most:]
        if others:
            first.append(Problem(self._source.fault(self._tree, "more-problems", number=len(others)), self._id))
        return tuple(first)

    def _error(self, code: str, **details: object) -> RealizerError:
        return RealizerError(self._source.fault(self._tree, code, **details))

    def _drop(self, fault: Fault, required: bool, part: str | None) -> None:
        self._failed |= required
        self._report([fault], part)

    def _report(self, faults: list[Fault], part: str | None = None) -> None:
        """Problems of the block, or of a behavior or constraint in it."""
        name = shown(part or "")
        place = f"{self._id}:{name}" if name else self._id
        self._problems += [Problem(fault, place) for fault in faults]


def _is(tree: Tree, name: str) -> bool:
    return is_core(tree) and name_of(tree) == name


def _each_once(*lists: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(chain(*lists)))


def _position(problem: Problem) -> tuple[int, int]:
    return problem.fault.line or 0, problem.fault.column or 0
