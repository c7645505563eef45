"""SSML for espeak-ng: the document, and what is heard of it."""

from collections.abc import AsyncIterator

import numpy as np
import pytest

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import Utterance, completed
from reactive_realizer.engines.speech.espeak_ssml import ssml_document
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice

TEXT = "Give me the big book now"


def markup(kind: MarkupKind, part: str, number: float = 1.0, text: str = "") -> Markup:
    first = TEXT.index(part)
    return Markup(kind, first, first if kind is MarkupKind.BREAK else first + len(part), f"<{kind}>", number, text)


RATE = markup(MarkupKind.RATE, "big book", 0.5)
LOUD = markup(MarkupKind.VOLUME, "big", 2.0)
SUB = markup(MarkupKind.SUB, "big", text="large & heavy")
BREAK = markup(MarkupKind.BREAK, "book", 1.0)
DUTCH = markup(MarkupKind.VOICE, "book", text="NL")


def test_elements_are_nested_and_close_where_their_parts_end() -> None:
    document = ssml_document(TEXT, [TEXT.index("book")], [RATE, LOUD, BREAK, DUTCH], {"nl": "gmw/nl"})
    assert document.ssml == (
        '<speak>Give me the <prosody rate="50%"><prosody volume="200%">big</prosody> <break time="1000ms"/>'
        '<mark name="m0"/><voice name="gmw/nl">book</voice></prosody> now</speak>'
    )
    assert document.left_out == ()


def test_every_character_belongs_to_one_of_the_text_also_where_something_else_is_spoken() -> None:
    document = ssml_document(TEXT, [], [SUB])
    assert document.ssml == "<speak>Give me the large &amp; heavy book now</speak>"
    assert {document.origin(1 + document.ssml.index(word)) for word in ("large", "heavy")} == {TEXT.index("big")}
    assert document.origin(1 + document.ssml.index("book")) == TEXT.index("book")


def test_what_espeak_cannot_follow_is_left_out() -> None:
    sounds, strange = markup(MarkupKind.PHONEME, "big", text="b"), markup(MarkupKind.VOICE, "book", text="klingon")
    document = ssml_document(TEXT, [], [sounds, strange], {"nl": "gmw/nl"})
    assert document.ssml == f"<speak>{TEXT}</speak>"
    assert document.left_out == (sounds, strange)


@pytest.fixture
async def voice() -> AsyncIterator[EspeakVoice]:
    voice = EspeakVoice()
    yield voice
    await voice.close()


async def spoken(voice: EspeakVoice, *said: Markup) -> Utterance:
    return await completed(voice.synthesize_markup(TEXT, (("now", TEXT.index("now")),), None, said))


def times(utterance: Utterance) -> dict[str, float]:
    """The time from the start of each word to that of the next one, s."""
    starts = [*(word.start for word in utterance.words), utterance.duration]
    return dict(zip(TEXT.split(), np.diff(starts).tolist(), strict=True))


@pytest.mark.speech
async def test_rate_stretches_its_words_only(voice: EspeakVoice) -> None:
    plain, slow = times(await spoken(voice)), times(await spoken(voice, RATE))
    assert slow["big"] + slow["book"] > 1.5 * (plain["big"] + plain["book"])
    assert slow["Give"] == pytest.approx(plain["Give"], abs=0.02)


@pytest.mark.speech
async def test_a_break_moves_the_mark_behind_it(voice: EspeakVoice) -> None:
    plain, late = await spoken(voice), await spoken(voice, BREAK)
    assert late.marks["now"] - plain.marks["now"] == pytest.approx(1.0, abs=0.15)
    assert late.marks["now"] == late.words[-1].start


@pytest.mark.speech
async def test_volume_and_pitch_are_heard(voice: EspeakVoice) -> None:
    everything = Markup(MarkupKind.VOLUME, 0, len(TEXT), "<>", 0.5)
    plain, soft = [np.frombuffer(each.audio, "<i2") for each in (await spoken(voice), await spoken(voice, everything))]
    assert np.std(soft) == pytest.approx(np.std(plain) / 2, rel=0.1)
    high = Markup(MarkupKind.PITCH, 0, len(TEXT), "<>", 1.5)
    raised = np.frombuffer((await spoken(voice, high)).audio, "<i2")
    assert frequency(raised) > 1.2 * frequency(plain)


@pytest.mark.speech
async def test_a_word_for_which_something_else_is_spoken_lasts_as_long_as_that(voice: EspeakVoice) -> None:
    plain, replaced = times(await spoken(voice)), times(await spoken(voice, SUB))
    assert replaced["big"] > 2 * plain["big"]
    assert replaced["book"] == pytest.approx(plain["book"], abs=0.05)


def frequency(samples: np.ndarray) -> float:
    """The median of the fundamental frequency, Hz, by autocorrelation."""
    found = []
    for start in range(0, len(samples) - 2048, 1024):
        window = samples[start : start + 2048] - samples[start : start + 2048].mean()
        similar = np.correlate(window, window, "full")[2047:]
        lags = slice(22_050 // 400, 22_050 // 50)
        best = lags.start + int(similar[lags].argmax())
        if similar[best] > 0.5 * similar[0] > 0:
            found.append(22_050 / best)
    return float(np.median(found))
