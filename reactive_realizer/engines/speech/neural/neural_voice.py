"""Voices that are neural networks in a worker process."""

from abc import ABC, abstractmethod
from collections.abc import AsyncIterator, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Any, ClassVar

from reactive_realizer.bml.markup import Markup
from reactive_realizer.engine.tts import Utterance, VoiceCapabilities
from reactive_realizer.engines.speech.espeak_utterance import PronouncedWord
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice, UnknownVoice, VoiceNotInstalled
from reactive_realizer.engines.speech.neural.markup import (
    DICTIONARY,
    FOLLOWED,
    MarkedRate,
    with_phonemes,
    with_stops,
)
from reactive_realizer.engines.speech.neural.pronunciation import Alphabet, Sentence, sentences
from reactive_realizer.engines.speech.neural.timed_sentence import FrameFormat, TimedSentence
from reactive_realizer.engines.speech.neural.utterance import SentenceSound, as_utterance
from reactive_realizer.engines.speech.scripts import unread_scripts
from reactive_realizer.engines.speech.speech_worker import SpeechWorker, VoiceFailed
from reactive_realizer.engines.speech.worker_messages import WorkerMessage
from reactive_realizer.errors import RealizerError
from reactive_realizer.sized_cache import SizedCache

_REMEMBERED_BYTES = 16 * 1024 * 1024
"""Size of the answers of the network that are remembered: almost six minutes of speech."""
_BYTES_OF_TIMES = 2000
"""Size of an answer without sound."""
_EXAMPLES = 20
"""The most names of voices that a message lists; a network may have hundreds."""
_PATIENCE = 60.0
"""Time limit for one answer, s: the longest piece of Kokoro-82M takes 4 s on two processors."""
_FIRST_PIECE, _GROWTH, _LONGEST_PIECE = 0.9, 1.6, 5.0
"""Durations of the first piece and of the longest ones, s, and the ratio of the ones between."""

_Key = tuple[str, float, tuple[int, ...], tuple[int, int] | None]
"""Voice, rate, tokens and, for sound, frames."""


@dataclass(frozen=True, slots=True)
class NetworkVoice:
    """One of the voices of a network.

    Attributes:
        language: the voice of espeak-ng that tells how words are pronounced.
        alphabet: in which sounds are written for the network.
        format: of the frames in which the network counts time.
        stop: silence between two sentences, s, in addition to the pause that the network makes.
    """

    language: str
    alphabet: Alphabet
    format: FrameFormat
    stop: float = 0.0


class NeuralVoice(ABC):
    """A `TTSBinding` with the voices of a network; base class.

    espeak-ng, in a worker of its own, tells how words are pronounced. The network predicts the times of whole
    sentences, and speaks them in pieces. Of several texts, the one of which less has been made goes first. What was
    made is not made again.

    Attributes:
        module: what the worker runs; it calls `network_worker.run`.
        packages: what has to be installed.
        extra: of this package, which installs them.
        worker: runs the network.
    """

    module: ClassVar[str]
    packages: ClassVar[Sequence[str]]
    extra: ClassVar[str]

    def __init__(self) -> None:
        self.worker = SpeechWorker(self.module, _PATIENCE)
        self._dictionary = EspeakVoice()
        self._replies: SizedCache[_Key, WorkerMessage] = SizedCache(_REMEMBERED_BYTES)

    @abstractmethod
    def network_voices(self, networks: Sequence[Mapping[str, Any]]) -> Mapping[str, NetworkVoice]:
        """The voices by their names, of which the first one is the default.

        Args:
            networks: the properties of each network, from the worker.
        """

    @classmethod
    def installed(cls) -> bool:
        """Whether the packages of the voice are installed."""
        return all(find_spec(package) is not None for package in cls.packages)

    async def start(self) -> None:
        """Starts both workers, which loads the network.

        Raises:
            RealizerError: packages are missing, or the network cannot be used.
        """
        if not self.installed():
            raise RealizerError(VoiceNotInstalled(extra=self.extra))
        languages = {each.language for each in (await self._known()).values()}
        for unknown in languages.difference(await self._dictionary.voices()):
            raise RealizerError(VoiceFailed(reason=f"espeak-ng has no voice '{unknown}'"))

    async def close(self) -> None:
        """Ends both workers."""
        await self._dictionary.close()
        await self.worker.close()

    async def voices(self) -> tuple[str, ...]:
        """The sorted names that `synthesize` takes.

        Raises:
            RealizerError: as `start`.
        """
        return tuple(sorted(await self._known()))

    async def capabilities(self) -> VoiceCapabilities:
        """The languages are those of its voices.

        Raises:
            RealizerError: as `start`.
        """
        languages = {each.language for each in (await self._known()).values()}
        return VoiceCapabilities(sound=True, languages=tuple(sorted(languages)), markup=FOLLOWED)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> AsyncIterator[Utterance]:
        """Speaks a text; see `TTSBinding.synthesize`."""
        return self.synthesize_markup(text, marks, voice, ())

    async def synthesize_markup(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None, markup: tuple[Markup, ...]
    ) -> AsyncIterator[Utterance]:
        """Speaks a text with markup; see `MarkupTTSBinding.synthesize_markup`."""
        name, own = _named(await self._known(), voice)
        rate = own.format.rate
        words, written = await self._write(text, markup, own)
        left_out = tuple(each for each in markup if each.kind not in FOLLOWED)
        unread = unread_scripts(text, own.language)
        timed: list[TimedSentence] = []
        lengths, audio, step = piece_lengths(), b"", 0
        for number in range(len(written)):
            await self._predict(written, timed, number + 1, own.format, name, step)
            sound, pieces = SentenceSound(rate), timed[number].pieces(lengths)
            for index, piece in enumerate(pieces, 1):
                if step == 2:  # the first two pieces are urgent
                    await self._predict(written, timed, len(written), own.format, name, step)
                spoken = await self._ask(written[number], name, step, piece.frames)
                audio += sound.add(piece, spoken.body, last=index == len(pieces))
                if index == len(pieces):
                    audio += bytes(2 * round(written[number].silence * rate))
                step += 1
                made = as_utterance(text, words, marks, estimated(written, timed, own.format), audio, rate)
                yield replace(made, left_out=left_out, unread=unread)
        if not written:
            yield replace(as_utterance(text, words, marks, (), b"", rate), left_out=left_out, unread=unread)

    async def _known(self) -> Mapping[str, NetworkVoice]:
        return self.network_voices((await self.worker.hello())["networks"])

    async def _write(
        self, text: str, markup: tuple[Markup, ...], voice: NetworkVoice
    ) -> tuple[tuple[PronouncedWord, ...], list[Sentence]]:
        """The words of a text with their sounds, and the sentences that the network gets."""
        stopped = with_stops(text, markup)
        dictionary = tuple(each for each in markup if each.kind in DICTIONARY)
        pronounced = await self._dictionary.pronounce(stopped, voice.language, dictionary)
        words = with_phonemes(pronounced, markup, voice.alphabet)
        return words, list(
            sentences(stopped, words, voice.alphabet, MarkedRate(markup) if markup else None, voice.stop)
        )

    async def _predict(
        self,
        written: Sequence[Sentence],
        timed: list[TimedSentence],
        count: int,
        format_: FrameFormat,
        voice: str,
        step: int,
    ) -> None:
        """Find the times of the first sentences of a text that have none."""
        for sentence in written[len(timed) : count]:
            reply = await self._ask(sentence, voice, step)
            durations = tuple(reply.header["durations"])
            timed.append(TimedSentence(sentence, durations, sentence is written[-1], format_))

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


def piece_lengths() -> Iterator[float]:
    """How long the pieces of a speech are to be, s: each one can be made while the one before it sounds."""
    length = _FIRST_PIECE
    while True:
        yield length
        length = min(length * _GROWTH, _LONGEST_PIECE)


def estimated(written: Sequence[Sentence], timed: Sequence[TimedSentence], format_: FrameFormat) -> list[TimedSentence]:
    """All sentences of a text; those without times are spoken as fast as the others."""
    tokens = sum(len(each.sentence.tokens) for each in timed)
    pace = sum(sum(each.durations[1:-1]) for each in timed) / max(tokens, 1)
    rest = written[len(timed) :]
    guessed = ((0.0, *[pace] * len(each.tokens), 0.0) for each in rest)
    untimed = [
        TimedSentence(each, durations, each is rest[-1], format_) for each, durations in zip(rest, guessed, strict=True)
    ]
    return [*timed, *untimed]


def _named(known: Mapping[str, NetworkVoice], name: str | None) -> tuple[str, NetworkVoice]:
    """A voice with its name; the default one if no name is given."""
    if not name:
        return next(iter(known.items()))
    if name not in known:
        names = tuple(sorted(known))
        raise RealizerError(UnknownVoice(voice=name, examples=", ".join(names[:_EXAMPLES]), known=names))
    return name, known[name]
