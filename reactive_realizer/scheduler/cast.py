"""Who plays: the characters and their engines."""

from collections.abc import Iterable, Mapping, Sequence

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.engine.engine import Engine
from reactive_realizer.planunit.plan_unit import PlanUnit


class Cast:
    """The engines of each character, in their rank order.

    Args:
        engines: by character id; the first character takes what names none.
    """

    def __init__(self, engines: Mapping[str, Sequence[Engine]]) -> None:
        self._engines = {character: tuple(own) for character, own in engines.items()}
        self._playing: dict[PlanUnit, Engine] = {}
        self._units: dict[Engine, dict[PlanUnit, None]] = {engine: {} for engine in self.engines}
        self._stirred = set(self.engines)

    @property
    def characters(self) -> tuple[str, ...]:
        """Their ids."""
        return tuple(self._engines)

    @property
    def engines(self) -> tuple[Engine, ...]:
        """All engines, in rank order."""
        return tuple(engine for own in self._engines.values() for engine in own)

    def engines_for(self, character: str, behaviors: Iterable[Behavior]) -> dict[str, tuple[Behavior, Engine]]:
        """Behaviors by id with the engine that plays each; those that nobody plays are not among them."""
        found = ((behavior, self._engine_for(character, behavior)) for behavior in behaviors)
        return {behavior.id: (behavior, engine) for behavior, engine in found if engine is not None}

    def _engine_for(self, character: str, behavior: Behavior) -> Engine | None:
        """The first engine of a character that plays the best form of a behavior."""
        engines = self._engines[character]
        return next((engine for form in behavior.forms for engine in engines if engine.supports(form)), None)

    def give(self, unit: PlanUnit, engine: Engine) -> None:
        """Have an engine play a unit that has its pegs."""
        self._playing[unit] = engine
        self._units[engine][unit] = None
        engine.add(unit)

    def reset(self, character: str, time: GlobalTime) -> None:
        """Have a character's engines forget what behaviors have left behind."""
        self._stirred.update(self._engines[character])
        for engine in self._engines[character]:
            engine.reset(time)

    def take(self, unit: PlanUnit) -> None:
        """Take a unit from the engine that plays it; one that nobody plays is no mistake."""
        engine = self._playing.pop(unit, None)
        if engine is not None:
            del self._units[engine][unit]
            self._stirred.add(engine)
            engine.remove(unit)
            unit.parameters.clear()  # they lead back to it: only the garbage collector would find them

    def awake(self, engine: Engine) -> bool:
        """Whether an engine is to play now, frames aside: it has units, or something was taken from it meanwhile.

        Whoever asks has it play then.
        """
        return self._take_stirred(engine) or bool(self._units[engine])

    def called(self, engine: Engine, now: GlobalTime) -> bool:
        """Whether an engine that has played in this tick is to play once more: something of it has become due."""
        points = (point for unit in self._units[engine] for point in unit.points)
        return self._take_stirred(engine) or any(p.fired is None and is_due(p.peg.value, now) for p in points)

    def _take_stirred(self, engine: Engine) -> bool:
        stirred = engine in self._stirred
        self._stirred.discard(engine)
        return stirred
