"""The engine of ``speech`` (thesis 8.10)."""

from collections.abc import Collection, Mapping
from types import MappingProxyType

from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.speech import FILLER, LIVELINESS, RIGID, VOICE, WORDS, RecordedSpeech, Speech, StreamedSpeech
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import ReportFall, Request, Warn
from reactive_realizer.engine.engine import SlowWork
from reactive_realizer.engine.sound_engine import SoundEngine
from reactive_realizer.engine.sound_unit import VOLUME_RANGE
from reactive_realizer.engine.tts import PITCH_RANGE, RATE_RANGE, Utterance
from reactive_realizer.engines.speech.elastic_speech import ElasticSpeech
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.engines.speech.recorded.recordings import Recording, Recordings
from reactive_realizer.engines.speech.speech_options import (
    LIVELINESS_RANGE,
    holds_floor,
    is_rigid,
    liveliness_of,
    wants_words,
)
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.engines.speech.streamed.streamed_speech import spoken_stream
from reactive_realizer.engines.speech.synthesis import Synthesis, check_words
from reactive_realizer.errors import CreationFault, Fault
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState


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


class SpeechEngine(SoundEngine):
    """Speaks with the voice of its character, and provides its lip sync (`LipSyncProvider`)."""

    behaviors = frozenset({Speech, RecordedSpeech, StreamedSpeech})
    extensions = frozenset({WORDS, VOICE, LIVELINESS, FILLER, RIGID})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(context, "speech")
        self._synthesis = Synthesis(context.tts, context.voice)
        self._liveliness = context.liveliness
        live = {} if context.liveliness is None else {LIVELINESS[1]: LIVELINESS_RANGE}
        ranges = {"volume": VOLUME_RANGE, "rate": RATE_RANGE, "pitch": PITCH_RANGE, **live}
        self.parameters = MappingProxyType({Speech: ranges})
        self._graph = context.graph
        self._recordings = Recordings(context.asset, context.limits.sound_seconds)
        self._streams = context.speech_streams
        self._notes = _SpeechNotes()
        files = context.bindings.get("visemes", ())
        self._visemes = VisemeBinding.of(context.humanoid.face, files, context.asset, context.speech_binding)
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
        spoken = self._synthesis.speak(_speech(behavior))
        return None if isinstance(spoken, Utterance) else spoken

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> SpeechUnit:
        """A unit with the duration of the utterance.

        Raises:
            RealizerError: ``nothing-to-say``, ``not-a-flag`` or ``bad-liveliness``.
        """
        holds_floor(behavior)
        speech = _speech(behavior)
        if isinstance(prepared, Recording):
            return SpeechUnit(block, speech, prepared.utterance, self._graph, self._liveliness, prepared.note)
        utterance = self._synthesis.speak(speech) if prepared is None else prepared
        if not isinstance(utterance, Utterance):
            raise TypeError(behavior, utterance)
        check_words(utterance)
        if prepared is not None:
            self._synthesis.remember(speech, utterance)
        left_out = self._synthesis.left_out(speech, utterance)
        note = MarkupLeftOut(markup=left_out) if left_out else None
        make = SpeechUnit if utterance.stretch is None or utterance.audio else ElasticSpeech
        return make(block, speech, utterance, self._graph, self._liveliness, note)

    def extend(self, unit: PlanUnit, prepared: object, now: GlobalTime) -> None:
        """Have a speech take its utterance when more of it is made."""
        if isinstance(unit, SpeechUnit) and isinstance(prepared, Recording):
            unit.extend(prepared.utterance, now)
            self._notes.tell(unit, prepared.note)
            return
        if not isinstance(unit, SpeechUnit) or not isinstance(prepared, Utterance):
            raise TypeError(unit, prepared)
        unit.extend(prepared, now)
        self._synthesis.remember(unit.speech, prepared)

    def add(self, unit: PlanUnit) -> None:
        """Take a speech into the plan."""
        super().add(unit)
        if isinstance(unit, SpeechUnit):
            self._notes.add(unit)

    def warnings(self) -> tuple[Warn | ReportFall, ...]:
        """The warnings about speeches since the last call."""
        return self._notes.take()

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """The requests that points come when their sounds do."""
        requests: list[Request] = []
        for unit in self._attention.units:
            if not isinstance(unit, SpeechUnit):
                continue
            unit.steer(tick.time)
            if unit.state in (UnitState.LURKING, UnitState.IN_EXEC) and (request := unit.misplaced(tick.time)):
                requests.append(request)
        return tuple(requests)

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        """Weights of morph targets for the present speech, None without one; an interrupted speech ends at once."""
        for unit in self.player.playing:
            if isinstance(unit, SpeechUnit) and unit.hearing is not None and unit.utterance.phonemes:
                utterance, position = unit.reading(time)
                return self._track_of(utterance).weights(position)
        return None

    def _track_of(self, utterance: Utterance) -> LipSyncTrack:
        if self._track is None or self._track.utterance is not utterance:
            self._track = LipSyncTrack(utterance, self._visemes)
        return self._track


class _SpeechNotes:
    """Collects the warnings about the speeches of a character: each once, but one about markup for each speech."""

    def __init__(self) -> None:
        self._notes: list[Warn] = []
        self._told: set[Fault] = set()

    def add(self, unit: SpeechUnit) -> None:
        """Note the warnings about a speech that is planned."""
        self.tell(unit, unit.note)
        self.tell(unit, OtherScript(scripts=unit.utterance.unread) if unit.utterance.unread else None)

    def tell(self, unit: SpeechUnit, fault: Fault | None) -> None:
        """Note a fault, if there is one."""
        if fault is not None and (fault not in self._told or isinstance(fault, MarkupLeftOut)):
            self._told.add(fault)
            self._notes.append(Warn(unit, fault))

    def take(self) -> tuple[Warn, ...]:
        """What was noted since the last call."""
        notes, self._notes = tuple(self._notes), []
        return notes


def _speech(behavior: Behavior) -> Speech:
    if not isinstance(behavior, Speech):
        raise TypeError(behavior)
    return behavior
