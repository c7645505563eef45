"""Behaviors that are written once and played many times (thesis 6.6.2)."""

from dataclasses import dataclass, field, replace

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.scheduler.cast import Cast
from reactive_realizer.scheduler.preparation import Preparation
from reactive_realizer.scheduler.workshop import Workshop


@dataclass(slots=True)
class _Procedure:
    """A definition, and what engines prepared for it, by character."""

    definition: DefineProc
    prepared: dict[str, Preparation] = field(default_factory=dict)


class Procedures:
    """Keeps definitions with the slow part of their planning: no use after the first asks an engine for it again."""

    def __init__(self, cast: Cast, workshop: Workshop) -> None:
        self._cast = cast
        self._workshop = workshop
        self._procedures: dict[str, _Procedure] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """The ids of those that are defined."""
        return tuple(self._procedures)

    def define(self, definition: DefineProc) -> None:
        """Keep a definition, in the place of one of the same name, and prepare it for the first character."""
        self._procedures[definition.id] = procedure = _Procedure(definition)
        self._prepare(procedure, self._cast.characters[0])

    def expand(self, block: BehaviorBlock) -> BehaviorBlock:
        """A block with the behaviors and constraints of the procedure that it uses, if it uses one."""
        if block.procedure is None:
            return block
        definition = self._procedures[block.procedure].definition
        return replace(
            block,
            behaviors=definition.behaviors,
            constraints=definition.constraints,
            unread=definition.unread,
        )

    def preparation(self, character: str, block: BehaviorBlock) -> Preparation | None:
        """What is prepared for a use of a procedure; None for other blocks."""
        procedure = self._procedures.get(block.procedure or "")
        return None if procedure is None else self._prepare(procedure, character)

    def _prepare(self, procedure: _Procedure, character: str) -> Preparation:
        if character not in procedure.prepared:
            engines = self._cast.engines_for(character, procedure.definition.behaviors)
            procedure.prepared[character] = Preparation(engines, self._workshop)
            procedure.prepared[character].begin()
        return procedure.prepared[character]
