"""The embedded voice: espeak-ng in a worker process."""

from collections.abc import AsyncIterator
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import Utterance, VoiceCapabilities
from reactive_realizer.engines.speech.espeak_ssml import FOLLOWED, SsmlDocument, ssml_document
from reactive_realizer.engines.speech.espeak_utterance import (
    PronouncedWord,
    as_utterance,
    pronounced_words,
)
from reactive_realizer.engines.speech.scripts import unread_scripts
from reactive_realizer.engines.speech.speech_worker import SpeechWorker
from reactive_realizer.engines.speech.worker_messages import WorkerMessage
from reactive_realizer.errors import CreationFault, RealizerError

_EXAMPLES = "en-us, en-gb, fr, nl or en-us+f3"
_PATIENCE = 10.0
"""Time limit for one utterance, s; the worker itself stops an utterance after 5 s."""


class VoiceNotInstalled(CreationFault):
    """The packages of a voice are not installed."""

    code = "voice-not-installed"
    template = "this voice requires packages that are not installed: pip install 'reactive-realizer[{extra}]'"
    extra: str


class UnknownVoice(CreationFault):
    """A name that no voice has."""

    code = "unknown-voice"
    template = "there is no voice '{voice}'; voices have names such as {examples}"
    unknown = "voice"
    voice: str
    examples: str
    known: tuple[str, ...] = ()


class EspeakVoice:
    """A `TTSBinding` that uses the espeak worker.

    Names of voices are those of espeak-ng, in any case, with or without a variant: ``en-us``, ``nl``, ``en-gb+f3``.

    Args:
        default_voice: the voice of characters that name none.
        patience: time limit of the worker for one utterance, s.

    Attributes:
        worker: makes the utterances.
    """

    def __init__(self, default_voice: str = "en-us", patience: float = _PATIENCE) -> None:
        self.worker = SpeechWorker("reactive_realizer.engines.speech.espeak_worker", patience)
        self._default_voice = default_voice

    async def start(self) -> None:
        """Starts the worker.

        Raises:
            RealizerError: espeak-ng is not installed, or its worker ends at once.
        """
        await self._hello()

    async def voices(self) -> tuple[str, ...]:
        """The sorted names that `synthesize` takes, without variants.

        Raises:
            RealizerError: as `start`.
        """
        return tuple(sorted((await self._hello())["voices"]))

    async def capabilities(self) -> VoiceCapabilities:
        """Its voices are named after their languages.

        Raises:
            RealizerError: as `start`.
        """
        return VoiceCapabilities(sound=True, languages=await self.voices(), markup=FOLLOWED)

    def synthesize(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> AsyncIterator[Utterance]:
        """Speaks a text; see `TTSBinding.synthesize`."""
        return self.synthesize_markup(text, marks, voice, ())

    async def synthesize_markup(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None, markup: tuple[Markup, ...]
    ) -> AsyncIterator[Utterance]:
        """Speaks a text with markup; see `MarkupTTSBinding.synthesize_markup`."""
        voices = (await self._hello())["voices"]
        document = ssml_document(text, [index for _, index in marks], markup, voices)
        utterance = as_utterance(await self._spoken(document, voice), text, marks, document)
        unread = unread_scripts(_in_own_language(text, document, markup), (voice or self._default_voice).lower())
        yield replace(utterance, unread=unread)

    async def pronounce(
        self, text: str, voice: str | None, markup: tuple[Markup, ...] = ()
    ) -> tuple[PronouncedWord, ...]:
        """The words of a text with their sounds, for voices without a dictionary.

        Raises:
            RealizerError: as `synthesize`.
        """
        document = ssml_document(text, (), markup)
        return pronounced_words(await self._spoken(document, voice), text, document)

    async def close(self) -> None:
        """Ends the worker."""
        await self.worker.close()

    async def _spoken(self, document: SsmlDocument, voice: str | None) -> WorkerMessage:
        identifier = _identifier(await self._hello(), voice or self._default_voice)
        return await self.worker.request({"ssml": document.ssml, "voice": identifier})

    async def _hello(self) -> dict[str, Any]:
        if find_spec("espeakng_loader") is None:  # only the worker may import it
            raise RealizerError(VoiceNotInstalled(extra="espeak"))
        return await self.worker.hello()


def _in_own_language(text: str, document: SsmlDocument, markup: tuple[Markup, ...]) -> str:
    """The characters of a text for which markup names no other voice or language."""
    kinds = {MarkupKind.VOICE, MarkupKind.LANGUAGE}
    others = [each for each in markup if each.kind in kinds and each not in document.left_out]
    outside = (index for index in range(len(text)) if not any(each.first <= index < each.last for each in others))
    return "".join(text[index] for index in outside)


def _identifier(hello: dict[str, Any], voice: str) -> str:
    """The library's identifier of a voice; the library would take an unknown name for the name of a file."""
    voices, variants = hello["voices"], hello["variants"]
    name, plus, variant = voice.partition("+")
    if name.lower() not in voices:
        raise RealizerError(UnknownVoice(voice=voice, examples=_EXAMPLES, known=tuple(voices)))
    if plus and variant not in variants:
        raise RealizerError(
            UnknownVoice(voice=voice, examples=_EXAMPLES, known=tuple(f"{name}+{each}" for each in variants))
        )
    return str(voices[name.lower()]) + plus + variant
