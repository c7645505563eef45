"""The contract of voices finds what breaks it: each of these is wrong in one way, and the test that says so fails."""

import asyncio
from dataclasses import replace
from itertools import count

import pytest

from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.tts_contract import Speaker, TTSContract

from .conftest import broken

TEXT = "Please put the red box on the green table, Dr. Smith."


class Shifted(TextVoice):
    """Counts characters from one."""

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, words=tuple(replace(word, first=word.first + 1) for word in said.words))


class Backward(TextVoice):
    """Says the last word first."""

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, words=said.words[::-1])


class Markless(TextVoice):
    """Leaves out the marks at the end."""

    def synthesize(self, text, marks, voice=None):
        return super().synthesize(text, tuple(mark for mark in marks if mark[1] < len(text)), voice)


class Tired(TextVoice):
    """Speaks ever slower."""

    spoken = count(1)

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, duration=said.duration * next(self.spoken))


class Short(TextVoice):
    """Has too little sound."""

    def synthesize(self, text, marks, voice=None):
        return replace(super().synthesize(text, marks, voice), audio=bytes(100))


class Confused(TextVoice):
    """Answers with what was asked for last."""

    async def synthesize(self, text, marks, voice=None):
        self.asked = text
        await asyncio.sleep(0)
        return super().synthesize(self.asked, marks, voice)


class Unsorted(TextVoice):
    """Lists its voices as they come."""

    async def voices(self):
        return ("b", "a")


class Mute(TextVoice):
    """Never speaks again after it did not know a voice."""

    refused = False

    async def voices(self):
        return ("a",)

    def synthesize(self, text, marks, voice=None):
        self.refused |= voice not in (None, "a")
        if self.refused:
            raise AssertionError("nobody's")
        return super().synthesize(text, marks, voice)


@pytest.mark.parametrize(
    ("voice", "test", "arguments"),
    [
        (Shifted, "test_words_stand_in_the_text_in_its_order_and_begin_in_time", (TEXT,)),
        (Backward, "test_words_stand_in_the_text_in_its_order_and_begin_in_time", (TEXT,)),
        (Markless, "test_a_mark_at_every_place_has_a_time_in_their_order", (TEXT,)),
        (Tired, "test_the_same_text_is_the_same_utterance_whatever_was_said_between", ()),
        (Tired, "test_a_speech_that_is_called_off_leaves_the_next_one_alone", ()),
        (Short, "test_sound_and_sounds_last_as_long_as_the_utterance", (TEXT,)),
        (Confused, "test_what_is_asked_for_at_once_is_not_mixed_up", ()),
        (Unsorted, "test_the_names_of_voices_are_sorted_and_speak", ()),
        (Mute, "test_an_unknown_voice_is_named_in_an_error_and_the_next_text_is_spoken", ()),
    ],
)
def test_a_voice_that_breaks_its_contract_is_found(voice, test, arguments) -> None:
    with asyncio.Runner() as runner:
        broken(TTSContract, test, Speaker(voice(), runner), *arguments)
