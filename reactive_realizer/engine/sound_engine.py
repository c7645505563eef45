"""An engine of behaviors that are heard."""

from dataclasses import replace

from reactive_realizer.clock.ticker import Tick
from reactive_realizer.embodiment.audio import AudioChange, AudioHeard
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.hearing import Drift, Hearing, OutsideSound
from reactive_realizer.engine.sound_announcer import SoundAnnouncer
from reactive_realizer.engine.sound_attention import SoundAttention
from reactive_realizer.engine.sound_unit import SoundUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.plan_unit import PlanUnit


class SoundEngine(DefaultEngine):
    """Announces the sounds of its units, and has the units follow what clients hear of them (`HearingEngine`)."""

    def __init__(self, context: EngineContext, modality: str) -> None:
        super().__init__(f"{context.character}/{modality}")
        self._announcer = SoundAnnouncer(context.character, f"{context.character}-{modality}")
        self._attention = SoundAttention(self.player)

    def add(self, unit: PlanUnit) -> None:
        """Take a sound into the plan; a change of its volume wakes the engine."""
        if isinstance(unit, SoundUnit):
            self._attention.add(unit)
        super().add(unit)
        for parameter in unit.parameters.values():
            parameter.cell.observe(lambda _: self.player.note(unit))

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """The changes of sounds since the last call: starts, moves, stops, and changes of their gain."""
        self._attention.take()
        for unit in self._attention.units:
            unit.make_sound(tick.time)
        return self._announcer.changes(self._attention.units, tick.time)

    def check_heard(self, heard: AudioHeard) -> bool:
        """Whether a report is about a sound that plays now.

        Raises:
            RealizerError: "outside-sound" or "far-off".
        """
        return self._found(heard) is not None

    def hear(self, heard: AudioHeard) -> Drift | None:
        """Take a report of what is heard of a sound; its drift, if its points are to move."""
        try:
            found = self._found(heard)
        except RealizerError:
            return None
        if found is None:
            return None
        unit, hearing, heard = found
        change = hearing.take(heard)
        if change and unit.loose:
            self.player.note(unit)
            return None
        return Drift(unit, change) if change else None

    def _found(self, heard: AudioHeard) -> tuple[SoundUnit, Hearing, AudioHeard] | None:
        """The unit that a report is about, if it plays, and the report with the position in the unit.

        Raises:
            RealizerError: "outside-sound" or "far-off".
        """
        found = self._announcer.find(heard.id)
        if found is None or found[0].hearing is None:
            return None
        unit, part = found
        sound = part.sound
        if not 0.0 <= heard.position <= sound.duration:
            raise RealizerError(OutsideSound(position=heard.position, id=heard.id, duration=sound.duration))
        in_unit = replace(heard, position=part.begin + heard.position)
        found[0].hearing.check(in_unit)
        return unit, found[0].hearing, in_unit
