"""Each of these voices breaks its contract in one way, and the test for that fails."""

import asyncio
from collections.abc import AsyncIterator
from dataclasses import replace
from itertools import count

import pytest

from reactive_realizer.bml.markup import MarkupKind
from reactive_realizer.engine.tts import Utterance, VoiceCapabilities
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.tts_contract import Speaker, TTSContract

from .conftest import broken

Marks = tuple[tuple[str, int], ...]


class Shifted(TextVoice):
    """Counts characters from 1."""

    def synthesize(self, text: str, marks: Marks, voice: str | None = None) -> Utterance:
        said = super().synthesize(text, marks, voice)
        return replace(said, words=tuple(replace(word, first=word.first + 1) for word in said.words))


class Backward(TextVoice):
    """Lists the words in reverse order."""

    def synthesize(self, text: str, marks: Marks, voice: str | None = None) -> Utterance:
        said = super().synthesize(text, marks, voice)
        return replace(said, words=said.words[::-1])


class Markless(TextVoice):
    """Omits marks at the end."""

    def synthesize(
        self,
        text: str,
        marks: Marks,
        voice: str | None = None,
    ) -> Utterance:
        return super().synthesize(text, tuple(mark for mark in marks if mark[1] < len(text)), voice)


class Tired(TextVoice):
    """Speaks more slowly every time."""

    spoken = count(1)

    def synthesize(self, text: str, marks: Marks, voice: str | None = None) -> Utterance:
        said = super().synthesize(text, marks, voice)
        return replace(said, duration=said.duration * next(self.spoken))


class Short(TextVoice):
    """Has too little audio."""

    def synthesize(self, text: str, marks: Marks, voice: str | None = None) -> Utterance:
        return replace(super().synthesize(text, marks, voice), audio=bytes(100))


class Confused(TextVoice):
    """Answers every request with the last text."""

    async def synthesize(  # type: ignore[override]  # a voice may be asynchronous
        self, text: str, marks: Marks, voice: str | None = None
    ) -> AsyncIterator[Utterance]:
        self.asked = text
        await asyncio.sleep(0)
        yield super().synthesize(self.asked, marks, voice)


class Fickle(TextVoice):
    """Gives the first words other times when the rest is made."""

    async def synthesize(  # type: ignore[override]  # a voice may be asynchronous
        self, text: str, marks: Marks, voice: str | None = None
    ) -> AsyncIterator[Utterance]:
        whole = super().synthesize(text, marks, voice)
        words = tuple(replace(word, start=word.start / 2) for word in whole.words)
        yield replace(whole, made=whole.duration / 2, words=words)
        yield whole


class Boastful(TextVoice):
    """Says that it can do more than it can."""

    claims = VoiceCapabilities(sound=True)

    async def capabilities(self) -> VoiceCapabilities:
        return self.claims


class Learned(Boastful):
    """Says that it follows markup."""

    claims = VoiceCapabilities(sound=False, markup=frozenset({MarkupKind.RATE}))


class Rigid(Boastful):
    """Says that it can be stretched."""

    claims = VoiceCapabilities(sound=False, stretch=(0.5, 2.0))


class Unsorted(TextVoice):
    """Lists its voices in arbitrary order."""

    async def voices(self) -> tuple[str, ...]:
        return ("b", "a")


class Mute(TextVoice):
    """Fails after a request for an unknown voice."""

    refused = False

    async def voices(self) -> tuple[str, ...]:
        return ("a",)

    def synthesize(self, text: str, marks: Marks, voice: str | None = None) -> Utterance:
        self.refused |= voice not in (None, "a")
        if self.refused:
            raise AssertionError("nobody's")
        return super().synthesize(text, marks, voice)


@pytest.mark.parametrize(
    ("voice", "test"),
    [
        (Shifted, "test_words_are_in_the_text_and_their_times_in_its_order"),
        (Backward, "test_words_are_in_the_text_and_their_times_in_its_order"),
        (Markless, "test_marks_at_all_indices_have_times_in_their_order"),
        (Tired, "test_the_same_text_gives_the_same_utterance_after_another_one"),
        (Tired, "test_canceling_a_request_does_not_affect_the_next_one"),
        (Short, "test_audio_and_phonemes_last_as_long_as_the_utterance"),
        (Confused, "test_concurrent_requests_are_not_mixed_up"),
        (Fickle, "test_what_is_made_stays_and_the_last_part_completes_the_utterance"),
        (Boastful, "test_it_does_what_its_capabilities_say_and_nothing_else"),
        (Learned, "test_it_does_what_its_capabilities_say_and_nothing_else"),
        (Rigid, "test_it_does_what_its_capabilities_say_and_nothing_else"),
        (Unsorted, "test_the_listed_voices_are_sorted_and_can_speak"),
        (Mute, "test_an_unknown_voice_raises_an_error_and_does_not_affect_the_next_text"),
    ],
)
def test_a_voice_that_breaks_its_contract_is_found(voice: type[TextVoice], test: str) -> None:
    with asyncio.Runner() as runner:
        contract = type("OfThisVoice", (TTSContract,), {"tts": lambda _: voice()})
        broken(contract, test, Speaker(voice(), runner))
