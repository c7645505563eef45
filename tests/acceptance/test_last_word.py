"""A speech reports at its end which part of it was heard."""

from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

VOICES = ["text", pytest.param("espeak", marks=pytest.mark.speech)]
SCRIPTS = {
    "Latin": "Café au lait, naïve Zoë said: yes!",
    "Greek": "Καλημέρα σας, κόσμε.",
    "Cyrillic": "Добрый день, мир!",
    "Arabic": "مرحبا بكم في العالم",
    "Devanagari": "नमस्ते दुनिया के लोग",
    "Chinese": "你好 世界 今天天气 很好",
    "emoji": "well 👩‍🚀 done 🚀 there",
}


async def last_word(pilot: RealizerPilot, text: str, at: float, **attributes: Any) -> tuple[Any, ...]:
    """Word, text and heard of a speech that is interrupted at a time."""
    pilot.block("b", f'<speech id="s"><text>{text}</text></speech>')
    how = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    pilot.block("i", f'<bmla:interrupt id="i" target="b" start="b:s:start+{at}" {how}/>')
    await pilot.advance(at + 3)
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    return tuple(end.get(f"{{{OWN}}}{name}") for name in ("word", "text", "heard"))


@pytest.mark.parametrize(
    ("at", "heard"),
    [
        (0.0, ("-1", "", "0")),
        (0.01, ("0", "one", "3")),
        (0.24, ("0", "one", "3")),
        (0.241, ("1", "two", "7")),
        (0.48, ("1", "two", "7")),
        (0.77, ("2", "three", "13")),
    ],
)
async def test_a_word_counts_as_heard_once_it_has_begun(
    pilot: RealizerPilot, at: float, heard: tuple[str, str, str]
) -> None:
    assert await last_word(pilot, "one two three", at) == heard


async def test_marks_and_punctuation_do_not_count_as_words(pilot: RealizerPilot) -> None:
    assert await last_word(pilot, '"One," <sync id="m"/>(two) &#8212; three.', 0.5) == ("1", "two", "11")


async def test_a_speech_that_finishes_its_word_does_not_start_the_next_one(pilot: RealizerPilot) -> None:
    assert await last_word(pilot, "one two three", 0.3, speech="word") == ("1", "two", "7")
    assert pilot.feedback.time("b:s:end") == 0.48


@pytest.mark.parametrize("at", [0.1, 0.5])
async def test_a_speech_that_finishes_its_clause_does_not_start_the_next_one(pilot: RealizerPilot, at: float) -> None:
    assert await last_word(pilot, "one two, three four. Five", at, speech="clause") == ("1", "two", "7")
    assert pilot.feedback.time("b:s:end") == 0.68


async def test_a_speech_in_its_last_clause_ends_normally(pilot: RealizerPilot) -> None:
    assert await last_word(pilot, "one, two three", 0.6, speech="clause") == ("2", "three", "14")
    assert pilot.feedback.status("b") == "DONE"


async def test_a_speech_between_two_words_ends_at_once(pilot: RealizerPilot) -> None:
    assert await last_word(pilot, "one two three", 0.24, speech="word") == ("0", "one", "3")
    assert pilot.feedback.time("b:s:end") == 0.24


async def test_a_speech_in_its_last_word_ends_normally(pilot: RealizerPilot) -> None:
    assert await last_word(pilot, "one two three", 0.5, speech="word") == ("2", "three", "13")
    assert pilot.feedback.time("b:s:end") == pytest.approx(0.78)
    assert pilot.feedback.status("b") == "DONE"


async def test_a_speech_that_ends_by_itself_was_heard_as_a_whole(pilot: RealizerPilot) -> None:
    text = "“One, two\n   (three) ...”"
    assert await last_word(pilot, text, 9.0) == ("2", "three", str(len("“One, two (three) ...”")))
    assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize("voice", VOICES)
@pytest.mark.parametrize("script", SCRIPTS)
@pytest.mark.parametrize("at", [0.15, 0.6])
async def test_the_reported_word_ends_the_heard_part_of_the_text_in_any_script(
    voice: str, script: str, at: float
) -> None:
    text = SCRIPTS[script]
    async with open_pilot(SceneOptions(voice=voice)) as pilot:
        number, word, heard = await last_word(pilot, text, at)
    assert all("it spells or skips them" in each.text for each in pilot.feedback.of("warningFeedback"))
    words = [each.strip(",.!:") for each in text.split()]
    assert word == words[int(number)]
    assert text[: int(heard)].split()[-1] == word
