"""Procedures: behaviors that are defined once and played many times (thesis 6.6.2)."""

from dataclasses import dataclass, field, replace

from reactive_realizer.bml.block import BehaviorBlock, DefineProc
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.preparation import BackgroundWork, Preparation


@dataclass(slots=True)
class _Procedure:
    """A definition, and the preparation for it by character."""

    definition: DefineProc
    prepared: dict[str, Preparation] = field(default_factory=dict)


class Procedures:
    """Keeps definitions with their preparations: each use after the first finds the slow work done.

    Attributes:
        sizes: the numbers of behaviors of the procedures that are defined, by id.
    """

    def __init__(self, routing: EngineRouting, background: BackgroundWork) -> None:
        self._routing = routing
        self._background = background
        self._procedures: dict[str, _Procedure] = {}
        self.sizes: dict[str, int] = {}

    def define(self, definition: DefineProc) -> None:
        """Keep a definition, which replaces one of the same id, and prepare it for the first character."""
        self._procedures[definition.id] = procedure = _Procedure(definition)
        self.sizes[definition.id] = len(definition.behaviors)
        self._prepare(procedure, self._routing.characters[0])

    def expand(self, block: BehaviorBlock) -> BehaviorBlock:
        """A block with the behaviors and constraints of its procedure, if it uses one."""
        if block.procedure is None:
            return block
        definition = self._procedures[block.procedure].definition
        behaviors, constraints, unread = definition.behaviors, definition.constraints, definition.unread
        return replace(block, behaviors=behaviors, constraints=constraints, unread=unread)

    def preparation(self, character: str, block: BehaviorBlock) -> Preparation | None:
        """The preparation of the procedure that a block uses; None for other blocks."""
        procedure = self._procedures.get(block.procedure or "")
        return None if procedure is None else self._prepare(procedure, character)

    def _prepare(self, procedure: _Procedure, character: str) -> Preparation:
        if character not in procedure.prepared:
            routed = self._routing.route(character, procedure.definition.behaviors)
            procedure.prepared[character] = Preparation(routed, self._background, kept=True)
        return procedure.prepared[character]
