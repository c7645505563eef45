"""The embedded voice: espeak-ng in a worker process."""

import asyncio
from importlib.util import find_spec

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.espeak_messages import WorkerMessage
from reactive_realizer.engines.speech.espeak_process import EspeakProcess
from reactive_realizer.engines.speech.espeak_utterance import as_utterance, marked_up
from reactive_realizer.errors import CreationFault, RealizerError

_PATIENCE = 10.0
"""Time limit for one utterance, s; the worker itself stops an utterance after 5 s."""


class VoiceNotInstalled(CreationFault):
    """The package with espeak-ng is not installed."""

    code = "voice-not-installed"
    template = "speech requires espeak-ng: pip install 'reactive-realizer[espeak]'"


class UnknownVoice(CreationFault):
    """A name that no voice of espeak-ng has."""

    code = "unknown-voice"
    template = "there is no voice '{voice}'; voices have names such as en-us, en-gb, fr, nl or en-us+f3"
    unknown = "voice"
    voice: str
    known: tuple[str, ...] = ()


class VoiceFailed(CreationFault):
    """The speech worker failed or was killed during synthesis."""

    code = "voice-failed"
    template = "the speech worker failed during synthesis: {reason}"
    reason: str


class EspeakVoice:
    """A `TTSBinding` that uses the speech worker.

    When a worker ends or hangs, the utterances requested of it fail, and the next request starts a new worker. Names of
    voices are those of espeak-ng, in any case, with or without a variant: ``en-us``, ``nl``, ``en-gb+f3``.

    Args:
        default_voice: the voice of characters that name none.
        patience: time limit of the worker for one utterance, s.

    Attributes:
        restarts: number of workers started after the first.
    """

    def __init__(self, default_voice: str = "en-us", patience: float = _PATIENCE) -> None:
        self.restarts = 0
        self._default_voice = default_voice
        self._patience = patience
        self._process: EspeakProcess | None = None
        self._starting = asyncio.Lock()

    @property
    def alive(self) -> bool:
        """Whether a worker is running."""
        return self._process is not None and not self._process.ended.done()

    async def start(self) -> None:
        """Starts the worker.

        Raises:
            RealizerError: espeak-ng is not installed, or its worker ends at once.
        """
        await self._running()

    async def voices(self) -> tuple[str, ...]:
        """The sorted names that `synthesize` takes, without variants.

        Raises:
            RealizerError: as `start`.
        """
        _, hello = await self._running()
        return tuple(sorted(hello.header["voices"]))

    async def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        """Speaks a text; see `TTSBinding.synthesize`."""
        process, hello = await self._running()
        identifier = _identifier(hello, voice or self._default_voice)
        markup = marked_up(text, tuple(index for _, index in marks))
        reply = await process.request({"ssml": markup.ssml, "voice": identifier})
        return as_utterance(_succeeded(reply), text, marks, markup)

    async def close(self) -> None:
        """Ends the worker."""
        if self._process is not None:
            await self._process.close()

    async def _running(self) -> tuple[EspeakProcess, WorkerMessage]:
        """A running worker, and its first message."""
        async with self._starting:
            if self._process is None or self._process.ended.done():
                _require_espeak()
                self.restarts += self._process is not None
                self._process = await EspeakProcess.start(self._patience)
        return self._process, _succeeded(await asyncio.shield(self._process.hello))


def _require_espeak() -> None:
    """Finds the package without importing it: only the worker may."""
    if find_spec("espeakng_loader") is None:
        raise RealizerError(VoiceNotInstalled())


def _succeeded(reply: WorkerMessage) -> WorkerMessage:
    if "failed" in reply.header:
        raise RealizerError(VoiceFailed(reason=reply.header["failed"]))
    return reply


def _identifier(hello: WorkerMessage, voice: str) -> str:
    """The library's identifier of a voice; the library would take an unknown name for the name of a file."""
    voices, variants = hello.header["voices"], hello.header["variants"]
    name, plus, variant = voice.partition("+")
    if name.lower() not in voices:
        raise RealizerError(UnknownVoice(voice=voice, known=tuple(voices)))
    if plus and variant not in variants:
        raise RealizerError(UnknownVoice(voice=voice, known=tuple(f"{name}+{each}" for each in variants)))
    return str(voices[name.lower()]) + plus + variant
