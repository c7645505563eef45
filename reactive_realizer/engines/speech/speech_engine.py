"""The engine of ``speech`` (thesis 8.10)."""

from collections.abc import Awaitable, Mapping

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Speech
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engines.speech.announcer import Announcer
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.speech.tts import TTSBinding, Utterance
from reactive_realizer.engines.speech.viseme_track import VisemeTrack
from reactive_realizer.pegboard.peg_key import BlockKey


class SpeechEngine(DefaultEngine):
    """Speaks with the voice of its character; offers what the mouth does (`LipSyncProvider`)."""

    behaviors = frozenset({Speech})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/speech")
        self._tts: TextVoice | TTSBinding = context.tts
        self._voice = context.voice
        self._announcer = Announcer(context.character)
        self._tracks: dict[SpeechUnit, VisemeTrack] = {}

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Synthesis, unless the voice answers at once."""
        if isinstance(self._tts, TextVoice) or not isinstance(behavior, Speech):
            return None
        return self._tts.synthesize(behavior.text, _marks(behavior), self._voice)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> SpeechUnit:
        """A unit as long as the utterance is."""
        if not isinstance(behavior, Speech):
            raise TypeError(behavior)
        if isinstance(self._tts, TextVoice):
            return SpeechUnit(block, behavior, self._tts.speak(behavior.text, _marks(behavior)))
        if not isinstance(prepared, Utterance):
            raise TypeError(prepared)
        return SpeechUnit(block, behavior, prepared)

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """What became audible, moved or fell silent."""
        return self._announcer.changes(unit for unit in self.player.units if isinstance(unit, SpeechUnit))

    def mouth(self, time: GlobalTime) -> Mapping[str, float]:
        """Weights of ARKit morphs for what is being said; the mouth closes by itself when a speech is cut."""
        for unit in self.player.playing:
            if isinstance(unit, SpeechUnit) and unit.started is not None:
                return self._track(unit).weights(time - unit.started)
        return {}

    def _track(self, unit: SpeechUnit) -> VisemeTrack:
        if unit not in self._tracks:
            self._tracks = {unit: VisemeTrack(unit.utterance)}
        return self._tracks[unit]


def _marks(behavior: Speech) -> tuple[tuple[str, int], ...]:
    return tuple((mark.id, mark.char_index) for mark in behavior.marks)
