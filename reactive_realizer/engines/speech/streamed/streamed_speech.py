"""Speech whose sound a client streams, as an utterance that grows."""

import logging
from collections.abc import AsyncGenerator, Awaitable, Iterator, Sequence
from dataclasses import replace
from types import MappingProxyType

from reactive_realizer.bml.speech import StreamedSpeech
from reactive_realizer.engine.engine import Part
from reactive_realizer.engine.speech_streams import SoundPiece, SpeechStream
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans
from reactive_realizer.engines.speech.recorded.aligner import CannotAlign, NoAligner
from reactive_realizer.engines.speech.recorded.recordings import Recording
from reactive_realizer.engines.speech.streamed.sound_levels import SoundLevels, SpokenTime
from reactive_realizer.engines.speech.streamed.sound_lips import SoundLips
from reactive_realizer.engines.speech.streamed.stream_aligner import StreamAligner
from reactive_realizer.engines.speech.streamed.word_times import GivenWords, word_begins
from reactive_realizer.errors import CreationFault, Fault, RealizerError

_log = logging.getLogger(__name__)

_AHEAD = 0.3
"""The shortest time from what has arrived to the expected end, s, as long as more may arrive."""


class NoSound(CreationFault):
    """A stream that has ended without sound."""

    code = "no-sound"
    template = "the stream '{stream}' has ended without sound"
    stream: str


class HalfSample(CreationFault):
    """A stream that has ended in the middle of a sample."""

    code = "half-sample"
    template = "the stream '{stream}' has ended in the middle of a sample; is it mono, with 16 bits?"
    stream: str


async def spoken_stream(speech: StreamedSpeech, stream: SpeechStream) -> AsyncGenerator[Part, None]:
    """A streamed speech as slow work: a `Recording` each time that a piece has arrived.

    Raises:
        RealizerError: "stream-silent" or "no-sound".
    """
    growing = _GrowingSpeech(speech)
    try:
        await growing.open()
        last = False
        while not last:
            piece = await stream.next_piece()
            last = piece.last
            recording = await growing.add(piece)
            if last and growing.behind:
                yield Part(recording, last=False)
                recording = await growing.catch_up()
            yield Part(recording, last)
    finally:
        stream.close()
        await growing.close()


class _GrowingSpeech:
    """What is known of a streamed speech.

    The times of words come from the client, or else are found in the sound, or else are estimated. The lips follow the
    sounds of the words that are found, then those that are heard, and elsewhere how loud and bright the sound is.
    """

    def __init__(self, speech: StreamedSpeech) -> None:
        self._speech = speech
        self._name = speech.stream.name
        self._spans = word_spans(speech.text)
        self._words = [speech.text[first:last] for first, last in self._spans]
        self._given = GivenWords(self._name, self._words)
        self._levels = SoundLevels(speech.stream.rate)
        self._lips = SoundLips(self._levels)
        self._audio = b""
        self._aligner: StreamAligner | None = None
        self._listening = False
        """Whether words and sounds are being looked for."""
        self._note: Fault | None = None

    @property
    def behind(self) -> bool:
        """Whether sounds are still being looked for in what has arrived."""
        return self._listening and self._aligner is not None and self._aligner.behind

    async def open(self) -> None:
        """Start to look for sounds, and for the words of the text, if it has any."""
        for words in (self._words, ()) if self._words else ((),):
            try:
                self._aligner = await StreamAligner.start(words, self._speech.stream.rate, self._name)
                self._listening = True
                return
            except RealizerError as problem:
                if words:
                    self._note = problem.fault

    async def close(self) -> None:
        """Stop looking for words and sounds."""
        if self._aligner is not None:
            await self._aligner.close()

    async def add(self, piece: SoundPiece) -> Recording:
        """The speech up to the end of a new piece.

        Raises:
            RealizerError: "no-sound".
        """
        self._audio += piece.samples
        self._levels.add(piece.samples)
        if not self._audio:
            raise RealizerError(NoSound(stream=self._name))
        if self._listening and self._aligner is not None:
            await self._listen(self._aligner.hear(piece.samples, last=piece.last))
            if piece.last and self._finding_words and len(self._aligner.begins) < len(self._words):
                self._note = CannotAlign(file=f"the stream '{self._name}'", reason="the text does not fit it")
        try:
            self._given.add(piece.words)
            if self._given.begins and isinstance(self._note, NoAligner | CannotAlign):
                self._note = None  # their times are not estimated
        except RealizerError as problem:
            self._note = problem.fault
        if piece.cut:
            self._note = HalfSample(stream=self._name)
        return Recording(self._utterance(ended=piece.last), self._note)

    async def catch_up(self) -> Recording:
        """The speech that has ended, with the sounds that were found late."""
        if self._aligner is not None:
            await self._listen(self._aligner.catch_up())
        return Recording(self._utterance(ended=True), self._note)

    async def _listen(self, hearing: Awaitable[None]) -> None:
        try:
            await hearing
        except RealizerError as problem:
            if self._finding_words:
                self._note = problem.fault
            else:
                _log.warning(
                    "the lips of the stream '%s' follow its loudness: the search for sounds failed", self._name
                )
            self._listening = False
            await self.close()

    def _utterance(self, *, ended: bool) -> Utterance:
        made = len(self._audio) / 2 / self._speech.stream.rate
        begins, end = self._begins(made, ended=ended)
        duration = made if ended else max(end, made + _AHEAD)
        words = tuple(
            Word(text, min(start, duration), first, last)
            for text, start, (first, last) in zip(self._words, begins, self._spans, strict=True)
        )
        rate = self._speech.stream.rate
        unmarked = Utterance(self._speech.text, duration, words, {}, tuple(self._phonemes()), self._audio, rate, made)
        marks = {mark.id: unmarked.time_of_character(mark.char_index) for mark in self._speech.marks}
        return replace(unmarked, marks=MappingProxyType(marks))

    def _begins(self, made: float, *, ended: bool) -> tuple[Sequence[float], float]:
        """The starts of all words, and the end of the last one, s."""
        spoken = SpokenTime(self._levels.loudness, made)
        found = self._given.begins or (self._aligner.begins if self._aligner is not None else ())
        begins, end = word_begins(self._words, found, spoken, ended=ended)
        if ended or not (self._given.begins or self._finding_words):
            return begins, end
        # A word that is neither given nor found has not been heard.
        delay = max(0.0, made - (begins[len(found)] if len(found) < len(begins) else end))
        return [*begins[: len(found)], *(begin + delay for begin in begins[len(found) :])], end + delay

    @property
    def _finding_words(self) -> bool:
        return self._listening and self._aligner is not None and self._aligner.with_words

    def _phonemes(self) -> list[Phoneme]:
        found = [] if self._aligner is None else list(_silent_in(self._levels.pauses, self._aligner.phonemes))
        return [*found, *self._lips.phonemes(found[-1].start + found[-1].duration if found else 0.0)]


def _silent_in(pauses: Sequence[tuple[float, float]], phonemes: Sequence[Phoneme]) -> Iterator[Phoneme]:
    """Sounds without what is found in pauses (start and end, s), such as in noise."""
    for phoneme in phonemes:
        at, end = phoneme.start, phoneme.start + phoneme.duration
        for begin, until in pauses:
            if begin < end and at < until:
                if at < begin:
                    yield replace(phoneme, start=at, duration=begin - at)
                start, at = max(at, begin), min(until, end)
                yield Phoneme("", start, at - start)
        if at < end:
            yield replace(phoneme, start=at, duration=end - at)
