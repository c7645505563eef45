"""Texts that cannot be spoken, or only in part: what is told, and that nothing else is lost."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

pytestmark = pytest.mark.speech

NOD = '<head id="nod" lexeme="NOD"/>'
SSML = '<description priority="1" type="application/ssml+xml"><speak xmlns="http://www.w3.org/2001/10/synthesis">{}</speak></description>'


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        yield pilot


async def warnings(pilot: RealizerPilot, speech: str) -> list[str]:
    """The warnings about a speech, beside which a nod plays to its end."""
    pilot.feedback.clear()
    pilot.sounds.clear()
    pilot.block("b", speech + NOD)
    await pilot.advance(12.0)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.reached("b:nod:end")
    return [warning.text.partition(": ")[2] for warning in pilot.feedback.of("warningFeedback")]


def captions(pilot: RealizerPilot) -> list[str]:
    starts = (change for change in pilot.sounds if isinstance(change, AudioStart))
    return [start.clip.caption.text for start in starts if start.clip.caption is not None]


@pytest.mark.parametrize("text", ["", " \n ", "... !?"])
async def test_a_text_without_words_is_told_and_the_rest_plays(pilot: RealizerPilot, text: str) -> None:
    assert await warnings(pilot, f'<speech id="s"><text>{text}</text></speech>') == ["its text contains no words"]
    assert captions(pilot) == []


async def test_a_text_of_100_000_characters_is_told_and_the_rest_plays(pilot: RealizerPilot) -> None:
    told = await warnings(pilot, f'<speech id="s"><text>{"word " * 20_000}</text></speech>')
    assert told == ["the text has more than 5000 characters"]


async def test_an_unknown_voice_or_language_is_told_with_known_ones(pilot: RealizerPilot) -> None:
    (told,) = await warnings(pilot, '<speech id="s" bmlt:voice="tlh"><text>Hello.</text></speech>')
    assert "there is no voice 'tlh'; voices have names such as" in told


@pytest.mark.parametrize(
    ("text", "scripts"),
    [
        ("Hello \u4e16\u754c.", "Chinese"),
        ("\u0645\u0631\u062d\u0628\u0627", "Arabic"),
        ("\u041f\u0440\u0438\u0432\u0435\u0442 \u03b1", "Cyrillic, Greek"),
    ],
)
async def test_letters_that_the_voice_does_not_read_are_told_once(
    pilot: RealizerPilot, text: str, scripts: str
) -> None:
    speech = f'<speech id="s"><text>{text}</text></speech>'
    assert await warnings(pilot, speech) == [f"the voice does not read {scripts} letters: it spells or skips them"]
    assert captions(pilot)[0] == text
    assert await warnings(pilot, speech) == [], "not again"


@pytest.mark.parametrize("text", ["\U0001f600 \U0001f469\u200d\U0001f467", "caf\u00e9 \u00b5m \u202eb\u0301\u0301"])
async def test_emoji_and_signs_are_no_letters_of_another_script(pilot: RealizerPilot, text: str) -> None:
    assert await warnings(pilot, f'<speech id="s"><text>{text} and more</text></speech>') == []
    assert captions(pilot)


async def test_a_mark_that_does_not_exist_is_told_with_those_that_do(pilot: RealizerPilot) -> None:
    speech = '<speech id="s"><text>Hello <sync id="m"/>you.</text></speech><head id="h" lexeme="NOD" start="s:n"/>'
    (told,) = await warnings(pilot, speech)
    assert "'s' has no sync point 'n'; it has start, m, end" in told
    assert captions(pilot)[0] == "Hello you."


@pytest.mark.parametrize("ssml", ["", '<break time="1s"/>', "..."])
async def test_ssml_that_says_nothing_leaves_the_plain_text(pilot: RealizerPilot, ssml: str) -> None:
    (told,) = await warnings(pilot, f'<speech id="s"><text>Plain text.</text>{SSML.format(ssml)}</speech>')
    assert "its text contains no words" in told
    assert captions(pilot)[0] == "Plain text."


async def test_a_mistake_in_ssml_is_told_and_the_rest_is_spoken(pilot: RealizerPilot) -> None:
    wrong = '<say-as interpret-as="">One</say-as> <sub>two</sub> <break time="soon"/>three.'
    told = await warnings(pilot, f'<speech id="s"><text>Plain text.</text>{SSML.format(wrong)}</speech>')
    assert [element for element in ("<say-as>", "<sub>", "<break>") if any(element in each for each in told)] == [
        "<say-as>",
        "<sub>",
        "<break>",
    ]
    assert captions(pilot)[0] == "One two three."


@pytest.mark.kokoro
async def test_the_natural_voice_answers_alike() -> None:
    async with open_pilot(SceneOptions(voice="kokoro")) as pilot:
        await test_a_text_without_words_is_told_and_the_rest_plays(pilot, "... !?")
        await test_a_text_of_100_000_characters_is_told_and_the_rest_plays(pilot)
        await test_an_unknown_voice_or_language_is_told_with_known_ones(pilot)
        await test_letters_that_the_voice_does_not_read_are_told_once(pilot, "Hello \u4e16\u754c.", "Chinese")
        await test_emoji_and_signs_are_no_letters_of_another_script(pilot, "\U0001f600")
        await test_ssml_that_says_nothing_leaves_the_plain_text(pilot, "")
        await test_a_mistake_in_ssml_is_told_and_the_rest_is_spoken(pilot)
