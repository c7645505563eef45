"""The engines of each character, and which engine plays which behavior."""

from collections.abc import Iterable, Mapping, Sequence

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.engine import Engine
from reactive_realizer.planunit.plan_unit import PlanUnit


class EngineRouting:
    """Chooses an engine for each behavior, and knows which engines have something to play.

    Args:
        engines: by character id, in rank order; the first character takes blocks that name none.
    """

    def __init__(self, engines: Mapping[str, Sequence[Engine]]) -> None:
        self._engines = {character: tuple(own) for character, own in engines.items()}
        self._engine_of: dict[PlanUnit, Engine] = {}
        self._units: dict[Engine, dict[PlanUnit, None]] = {engine: {} for engine in self.engines}
        self._changed = set(self.engines)

    @property
    def characters(self) -> tuple[str, ...]:
        """The ids of the characters."""
        return tuple(self._engines)

    @property
    def engines(self) -> tuple[Engine, ...]:
        """All engines, in rank order."""
        return tuple(engine for own in self._engines.values() for engine in own)

    def engines_for(self, character: str, behaviors: Iterable[Behavior]) -> dict[str, tuple[Behavior, Engine]]:
        """Behaviors by id, with the engine that plays each; a behavior that no engine supports is left out."""
        found = ((behavior, self._engine_for(character, behavior)) for behavior in behaviors)
        return {behavior.id: (behavior, engine) for behavior, engine in found if engine is not None}

    def assign(self, unit: PlanUnit, engine: Engine) -> None:
        """Have an engine play a unit that has its pegs."""
        self._engine_of[unit] = engine
        self._units[engine][unit] = None
        engine.add(unit)

    def unassign(self, unit: PlanUnit) -> None:
        """Take a unit from its engine, if it has one."""
        engine = self._engine_of.pop(unit, None)
        if engine is not None:
            del self._units[engine][unit]
            self._changed.add(engine)
            engine.remove(unit)

    def reset(self, character: str, time: GlobalTime) -> None:
        """Have a character's engines forget what behaviors have left behind."""
        self._changed.update(self._engines[character])
        for engine in self._engines[character]:
            engine.reset(time)

    def take_active(self, engine: Engine) -> bool:
        """Whether an engine has units, or lost one or was reset since the last call; the caller has it play then."""
        return self._take_changed(engine) or bool(self._units[engine])

    def take_due(self, engine: Engine, now: GlobalTime) -> bool:
        """Whether an engine that has played in this tick has to play again: `take_active`, but only for due points."""
        points = (point for unit in self._units[engine] for point in unit.points)
        return self._take_changed(engine) or any(not p.fired and is_due(p.peg.value, now) for p in points)

    def _engine_for(self, character: str, behavior: Behavior) -> Engine | None:
        """The first engine of a character that supports the best form of a behavior."""
        engines = self._engines[character]
        return next((engine for form in behavior.forms for engine in engines if engine.supports(form)), None)

    def _take_changed(self, engine: Engine) -> bool:
        changed = engine in self._changed
        self._changed.discard(engine)
        return changed
