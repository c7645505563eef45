"""The embedded voice: espeak-ng in a worker process."""

import asyncio
from importlib.util import find_spec

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.espeak_process import EspeakProcess
from reactive_realizer.engines.speech.espeak_reply import as_utterance
from reactive_realizer.engines.speech.messages import Message
from reactive_realizer.engines.speech.ssml import marked_up
from reactive_realizer.errors import error

_PATIENCE = 10.0
"""s; the worker itself ends after 5 s what the library does not come to an end with."""


class EspeakVoice:
    """A `TTSBinding` over the speech worker.

    A worker that ended, for whatever reason, or hangs costs the utterances it was asked for; the next request starts
    another.
    Names of voices are those of espeak-ng, upper or lower case, with or without a variant: ``en-us``, ``nl``,
    ``en-gb+f3``.

    Args:
        default_voice: what speaks where a character names no voice.
        patience: how long the worker may take over one utterance, s.

    Attributes:
        restarts: how many workers were started after the first.
    """

    def __init__(self, default_voice: str = "en-us", patience: float = _PATIENCE) -> None:
        self.restarts = 0
        self._default_voice = default_voice
        self._patience = patience
        self._process: EspeakProcess | None = None
        self._starting = asyncio.Lock()

    @property
    def alive(self) -> bool:
        """Whether a worker runs."""
        return self._process is not None and not self._process.ended.done()

    async def start(self) -> None:
        """Starts the worker.

        Raises:
            RealizerError: if espeak-ng is not installed or its worker ends at once.
        """
        await self._running()

    async def voices(self) -> tuple[str, ...]:
        """The names that `synthesize` takes, without variants, sorted.

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

    async def _running(self) -> tuple[EspeakProcess, Message]:
        """A worker that runs, and what it said first."""
        async with self._starting:
            if self._process is None or self._process.ended.done():
                _require_espeak()
                self.restarts += self._process is not None
                self._process = await EspeakProcess.start(self._patience)
        return self._process, _succeeded(await asyncio.shield(self._process.hello))


def _require_espeak() -> None:
    """Looks for the package without importing it: that is for the worker alone."""
    if find_spec("espeakng_loader") is None:
        raise error("voice-not-installed")


def _succeeded(reply: Message) -> Message:
    if "failed" in reply.header:
        raise error("voice-failed", reason=reply.header["failed"])
    return reply


def _identifier(hello: Message, voice: str) -> str:
    """The library's identifier of a voice; no other name reaches the library, which would look for a file of it."""
    name, plus, variant = voice.partition("+")
    if name.lower() not in hello.header["voices"] or (plus and variant not in hello.header["variants"]):
        raise error("unknown-voice", voice=voice)
    return str(hello.header["voices"][name.lower()]) + plus + variant
