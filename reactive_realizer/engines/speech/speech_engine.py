"""The engine of ``speech`` (thesis 8.10)."""

from collections.abc import Awaitable, Collection, Mapping
from types import MappingProxyType

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import WORDS, Speech
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioHeard
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.hearing import Drift
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.speech_audio import SpeechAudio
from reactive_realizer.engines.speech.speech_unit import VOLUME_RANGE, SpeechUnit, wants_words
from reactive_realizer.engines.speech.visemes import VisemeTrack
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.sized_cache import SizedCache


class NothingToSay(CreationFault):
    """A speech without words."""

    code = "nothing-to-say"
    template = "its text contains no words"


_Text = tuple[str, tuple[tuple[str, int], ...]]
"""A text to be synthesized, and its marks: the id of each, and the index of the character that it precedes."""

_REMEMBERED_BYTES = 16 * 1024 * 1024
"""Size of the utterances that are remembered for repetition: six minutes of speech at 22 kHz."""

_BYTES_A_CHARACTER = 50
"""Size of an utterance without its sound: a word takes 200 to 300 bytes."""


class SpeechEngine(DefaultEngine):
    """Speaks with the voice of its character, and provides its lip sync (`LipSyncProvider`)."""

    behaviors = frozenset({Speech})
    extensions = frozenset({WORDS})
    parameters: Mapping[type[Behavior], Mapping[str, Range]] = MappingProxyType({Speech: {"volume": VOLUME_RANGE}})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/speech")
        self._tts = context.tts
        self._voice = context.voice
        self._graph = context.graph
        self._audio = SpeechAudio(context.character)
        # What is said again need not be synthesized again. Utterances are remembered when they are planned, not when
        # they are synthesized: so a replay remembers the same ones at the same ticks.
        self._spoken: SizedCache[_Text, Utterance] = SizedCache(_REMEMBERED_BYTES)
        self._tracks: dict[SpeechUnit, VisemeTrack] = {}

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """The sync points, unless its words are among them: only the voice finds these.

        Raises:
            RealizerError: ``not-a-flag``.
        """
        return None if wants_words(behavior) else behavior.sync_points

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """The synthesis, unless the voice answers at once or the same text was spoken before."""
        spoken = self._speak(behavior)
        return None if isinstance(spoken, Utterance) else spoken

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> SpeechUnit:
        """A unit with the duration of the utterance.

        Raises:
            RealizerError: ``nothing-to-say`` or ``not-a-flag``.
        """
        utterance = self._speak(behavior) if prepared is None else prepared
        if not isinstance(behavior, Speech) or not isinstance(utterance, Utterance):
            raise TypeError(behavior, utterance)
        if not utterance.words:
            raise RealizerError(NothingToSay())
        if prepared is not None:
            text = _text(behavior)
            self._spoken.add(text, utterance, len(utterance.audio) + _BYTES_A_CHARACTER * len(text[0]))
        return SpeechUnit(block, behavior, utterance, self._graph)

    def add(self, unit: PlanUnit) -> None:
        """Take a speech into the plan; a change of its volume wakes the engine."""
        super().add(unit)
        for parameter in unit.parameters.values():
            parameter.cell.observe(lambda _: self.player.note(unit))

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """The changes of sounds since the last call: starts, moves, stops, and changes of their gain."""
        units = (unit for unit in self.player.units if isinstance(unit, SpeechUnit))
        return self._audio.changes(units, tick.time)

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        """Weights of ARKit morphs for the present speech, None without one; an interrupted speech ends at once."""
        for unit in self.player.playing:
            if isinstance(unit, SpeechUnit) and unit.hearing is not None and unit.utterance.phonemes:
                return self._track(unit).weights(unit.position(time))
        return None

    def check_heard(self, heard: AudioHeard) -> bool:
        """Whether a report is about a speech that plays now.

        Raises:
            RealizerError: "outside-sound" or "far-off".
        """
        unit = self._audio.unit(heard.id)
        if unit is None or unit.hearing is None:
            return False
        unit.hearing.check(heard)
        return True

    def hear(self, heard: AudioHeard) -> Drift | None:
        """Take a report of what is heard of a speech; its drift, if its points are to move."""
        unit = self._audio.unit(heard.id)
        if unit is None or unit.hearing is None:
            return None
        try:
            unit.hearing.check(heard)
        except RealizerError:
            return None
        change = unit.hearing.take(heard)
        return Drift(unit, change) if change else None

    def _speak(self, behavior: Behavior) -> Utterance | Awaitable[Utterance]:
        text = _text(behavior)
        return self._spoken.get(text) or self._tts.synthesize(*text, self._voice)

    def _track(self, unit: SpeechUnit) -> VisemeTrack:
        if unit not in self._tracks:
            self._tracks = {unit: VisemeTrack(unit.utterance)}
        return self._tracks[unit]


def _text(behavior: Behavior) -> _Text:
    if not isinstance(behavior, Speech):
        raise TypeError(behavior)
    return behavior.text, tuple((mark.id, mark.char_index) for mark in behavior.marks)
