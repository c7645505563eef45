"""The engine of ``speech`` (thesis 8.10)."""

from collections.abc import AsyncIterator, Collection, Mapping
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import (
    FILLER,
    LIVELINESS,
    RIGID,
    VOICE,
    WORDS,
    RecordedSpeech,
    Speech,
    StreamedSpeech,
)
from reactive_realizer.bml.markup import Markup
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import ReportFall, Request, Warn
from reactive_realizer.engine.engine import Part, SlowWork
from reactive_realizer.engine.sound_engine import SoundEngine
from reactive_realizer.engine.sound_unit import VOLUME_RANGE
from reactive_realizer.engine.tts import MarkupTTSBinding, Utterance
from reactive_realizer.engines.speech.elastic_speech import ElasticSpeech
from reactive_realizer.engines.speech.lip_sync.binding import VisemeBinding
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.engines.speech.recorded.recordings import Recording, Recordings
from reactive_realizer.engines.speech.speech_unit import (
    LIVELINESS_RANGE,
    SpeechUnit,
    holds_floor,
    is_rigid,
    liveliness_of,
    wants_words,
)
from reactive_realizer.engines.speech.streamed.streamed_speech import spoken_stream
from reactive_realizer.errors import CreationFault, Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.sized_cache import SizedCache


class NothingToSay(CreationFault):
    """A speech without words."""

    code = "nothing-to-say"
    template = "its text contains no words"


class MarkupLeftOut(CreationFault):
    """Markup of a speech that its voice cannot follow."""

    code = "markup-left-out"
    template = "the voice cannot do {markup}; the rest of the SSML is followed"
    markup: tuple[str, ...]


class OtherScript(CreationFault):
    """Letters that the voice does not read."""

    code = "other-script"
    template = "the voice does not read {scripts} letters: it spells or skips them"
    scripts: tuple[str, ...]


class _Text(NamedTuple):
    """A text to be synthesized.

    Attributes:
        text: plain.
        marks: the id of each, and the index of the character that it precedes.
        voice: its name; None for the default one.
        markup: of the text.
    """

    text: str
    marks: tuple[tuple[str, int], ...]
    voice: str | None
    markup: tuple[Markup, ...]


_REMEMBERED_BYTES = 16 * 1024 * 1024
"""Size of the utterances that are remembered for repetition: six minutes of speech at 22 kHz."""

_BYTES_A_CHARACTER = 50
"""Size of an utterance without its sound: a word takes 200 to 300 bytes."""


class SpeechEngine(SoundEngine):
    """Speaks with the voice of its character, and provides its lip sync (`LipSyncProvider`)."""

    behaviors = frozenset({Speech, RecordedSpeech, StreamedSpeech})
    extensions = frozenset({WORDS, VOICE, LIVELINESS, FILLER, RIGID})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(context, "speech")
        self._tts = context.tts
        self._voice = context.voice
        self._liveliness = context.liveliness
        live = {} if context.liveliness is None else {LIVELINESS[1]: LIVELINESS_RANGE}
        self.parameters = MappingProxyType({Speech: {"volume": VOLUME_RANGE, **live}})
        self._graph = context.graph
        # What is said again need not be synthesized again. Utterances are remembered when they are planned or
        # extended, not when they are synthesized: so a replay remembers the same ones at the same ticks.
        self._spoken: SizedCache[_Text, Utterance] = SizedCache(_REMEMBERED_BYTES)
        self._recordings = Recordings(context.asset, context.limits.sound_seconds)
        self._streams = context.speech_streams
        self._notes: list[Warn] = []
        self._told: set[Fault] = set()
        avatar = context.humanoid.avatar
        files = context.bindings.get("visemes", ())
        self._visemes = VisemeBinding.read(files, avatar.morphs, context.asset, avatar.skeleton.joints)
        self._track: LipSyncTrack | None = None

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """The sync points, unless its words are among them: only the voice finds these.

        Raises:
            RealizerError: ``not-a-flag``, ``bad-liveliness``; of a recorded speech, ``no-asset``, ``forbidden-path``.
        """
        if isinstance(behavior, RecordedSpeech):
            self._recordings.file(behavior)
        liveliness_of(behavior, None)
        holds_floor(behavior)
        is_rigid(behavior)
        return None if wants_words(behavior) else behavior.sync_points

    def prepare(self, behavior: Behavior) -> SlowWork | None:
        """The synthesis, unless the voice answers at once or the same text was spoken before.

        Of a recorded speech, the reading of its file and the search for its words; of a streamed one, the search for
        words in what arrives.

        Raises:
            RealizerError: of a streamed speech, "stream-taken" or "too-many-streams".
        """
        if isinstance(behavior, RecordedSpeech):
            return self._recordings.read(behavior)
        if isinstance(behavior, StreamedSpeech):
            return spoken_stream(behavior, self._streams.claim(behavior.stream))
        spoken = self._speak(behavior)
        return None if isinstance(spoken, Utterance) else _parts(spoken)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> SpeechUnit:
        """A unit with the duration of the utterance.

        Raises:
            RealizerError: ``nothing-to-say``, ``not-a-flag`` or ``bad-liveliness``.
        """
        holds_floor(behavior)
        if isinstance(prepared, Recording) and isinstance(behavior, Speech):
            return SpeechUnit(block, behavior, prepared.utterance, self._graph, self._liveliness, prepared.note)
        utterance = self._speak(behavior) if prepared is None else prepared
        if not isinstance(behavior, Speech) or not isinstance(utterance, Utterance):
            raise TypeError(behavior, utterance)
        if not utterance.words:
            raise RealizerError(NothingToSay())
        if prepared is not None:
            self._remember(behavior, utterance)
        make = SpeechUnit if utterance.stretch is None or utterance.audio else ElasticSpeech
        return make(block, behavior, utterance, self._graph, self._liveliness, self._left_out(behavior, utterance))

    def extend(self, unit: PlanUnit, prepared: object, now: GlobalTime) -> None:
        """Have a speech take its utterance when more of it is made."""
        if isinstance(unit, SpeechUnit) and isinstance(prepared, Recording):
            unit.extend(prepared.utterance, now)
            self._tell(unit, prepared.note)
            return
        if not isinstance(unit, SpeechUnit) or not isinstance(prepared, Utterance):
            raise TypeError(unit, prepared)
        unit.extend(prepared, now)
        self._remember(unit.speech, prepared)

    def add(self, unit: PlanUnit) -> None:
        """Take a speech into the plan; what is to be told of it is told once, and of its markup for each speech."""
        super().add(unit)
        if isinstance(unit, ElasticSpeech):
            unit.follow()
        if not isinstance(unit, SpeechUnit):
            return
        unread = OtherScript(scripts=unit.utterance.unread) if unit.utterance.unread else None
        for fault in (unit.note, unread):
            self._tell(unit, fault)

    def remove(self, unit: PlanUnit) -> None:
        """Take a speech out of the plan."""
        super().remove(unit)
        if isinstance(unit, ElasticSpeech):
            unit.leave()

    def warnings(self) -> tuple[Warn | ReportFall, ...]:
        """What is to be told of speeches, since the last call."""
        notes, self._notes = tuple(self._notes), []
        return notes

    def audio(self, tick: Tick) -> tuple[AudioChange, ...]:
        """The changes of sounds since the last call, with the sound of stretched speeches that is heard soon."""
        for unit in self.player.units:
            if isinstance(unit, SpeechUnit) and unit.loose:
                unit.make_sound(tick.time)
        return super().audio(tick)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """That points come when their sounds do."""
        playing = (unit for unit in self.player.playing if isinstance(unit, SpeechUnit))
        return tuple(each for unit in playing for each in unit.misplaced(tick.time))

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        """Weights of morph targets for the present speech, None without one; an interrupted speech ends at once."""
        for unit in self.player.playing:
            if isinstance(unit, SpeechUnit) and unit.hearing is not None and unit.utterance.phonemes:
                utterance, position = unit.reading(time)
                return self._track_of(utterance).weights(position)
        return None

    def _tell(self, unit: SpeechUnit, fault: Fault | None) -> None:
        """Have clients told of a fault, once."""
        if fault is not None and (fault not in self._told or isinstance(fault, MarkupLeftOut)):
            self._told.add(fault)
            self._notes.append(Warn(unit, fault))

    def _speak(self, behavior: Behavior) -> Utterance | AsyncIterator[Utterance]:
        text = self._text(behavior)
        spoken = self._spoken.get(text)
        if spoken is not None:
            return spoken
        if text.markup and isinstance(self._tts, MarkupTTSBinding):
            return self._tts.synthesize_markup(*text)
        return self._tts.synthesize(text.text, text.marks, text.voice)

    def _text(self, behavior: Behavior) -> _Text:
        if not isinstance(behavior, Speech):
            raise TypeError(behavior)
        marks = tuple((mark.id, mark.char_index) for mark in behavior.marks)
        return _Text(behavior.text, marks, behavior.extensions.get(VOICE, self._voice), behavior.markup)

    def _left_out(self, speech: Speech, utterance: Utterance) -> Fault | None:
        """The markup of a speech that the voice does not follow, each kind once."""
        left_out = utterance.left_out if isinstance(self._tts, MarkupTTSBinding) else speech.markup
        written = tuple(dict.fromkeys(each.written for each in left_out))
        return MarkupLeftOut(markup=written) if written else None

    def _remember(self, speech: Speech, utterance: Utterance) -> None:
        if utterance.complete:
            size = len(utterance.audio) + _BYTES_A_CHARACTER * len(utterance.text)
            self._spoken.add(self._text(speech), utterance, size)

    def _track_of(self, utterance: Utterance) -> LipSyncTrack:
        if self._track is None or self._track.utterance is not utterance:
            self._track = LipSyncTrack(utterance, self._visemes)
        return self._track


async def _parts(spoken: AsyncIterator[Utterance]) -> AsyncIterator[Part]:
    """An utterance as slow work, each time that more of it is made.

    Raises:
        RealizerError: ``nothing-to-say``, so that the next form of the speech is made.
    """
    async for utterance in spoken:
        if not utterance.words:
            raise RealizerError(NothingToSay())
        yield Part(utterance, utterance.complete)
