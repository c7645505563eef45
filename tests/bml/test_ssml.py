"""SSML in the description of a speech: what is read, and what is refused, with its place."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.markup import MarkupKind
from reactive_realizer.bml.speech import Speech
from reactive_realizer.limits import Limits

NAMESPACE = "http://www.w3.org/2001/10/synthesis"
BLOCK = '<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="b"><speech id="s">{}</speech></bml>'
TEXT = "<text>Plain text.</text>"


def read(ssml: str, text: str = TEXT, limits: Limits | None = None) -> tuple[Speech, tuple[Problem, ...]]:
    """The best form of a speech with SSML inside ``<speak>``, which begins in line 2, and the problems."""
    speak = f'<speak xmlns="{NAMESPACE}">{ssml}</speak>'
    description = f'<description priority="1" type="application/ssml+xml">\n{speak}</description>'
    (parsed,) = parse(BLOCK.format(text + description), limits or Limits())
    assert parsed.block is not None
    best = parsed.block.behaviors[0].forms[0]
    assert isinstance(best, Speech)
    return best, parsed.problems


def markup(ssml: str) -> list[tuple[MarkupKind, str, float, str]]:
    """The markup of SSML without problems: kind, the part of the text, number, text."""
    speech, problems = read(ssml)
    assert problems == ()
    return [(each.kind, speech.text[each.first : each.last], each.number, each.text) for each in speech.markup]


@pytest.mark.parametrize(
    ("ssml", "expected"),
    [
        ('a <break time="250ms"/>b', (MarkupKind.BREAK, "", 0.25, "")),
        ('a <break strength="strong"/>b', (MarkupKind.BREAK, "", 0.4, "")),
        ('<prosody rate="80%">a</prosody>', (MarkupKind.RATE, "a", 0.8, "")),
        ('<prosody rate="+20%">a</prosody>', (MarkupKind.RATE, "a", 1.2, "")),
        ('<prosody pitch="-12st">a</prosody>', (MarkupKind.PITCH, "a", 0.5, "")),
        ('<prosody volume="+6dB">a</prosody>', (MarkupKind.VOLUME, "a", 1.995, "")),
        ('<prosody volume="silent">a</prosody>', (MarkupKind.VOLUME, "a", 0.0, "")),
        ("<emphasis>a</emphasis>", (MarkupKind.EMPHASIS, "a", 1.0, "moderate")),
        ('<sub alias="of a kind">a</sub>', (MarkupKind.SUB, "a", 1.0, "of a kind")),
        ('<say-as interpret-as="spell-out">a</say-as>', (MarkupKind.SAY_AS, "a", 1.0, "characters")),
        ('<say-as interpret-as="date">a</say-as>', (MarkupKind.OTHER, "a", 1.0, "date")),
        ('<phoneme ph="i">a</phoneme>', (MarkupKind.PHONEME, "a", 1.0, "i")),
        ('<voice name="nl">a</voice>', (MarkupKind.VOICE, "a", 1.0, "nl")),
        ('<lang xml:lang="nl">a</lang>', (MarkupKind.LANGUAGE, "a", 1.0, "nl")),
        ("<s>a</s>", (MarkupKind.SENTENCE, "a", 1.0, "")),
        ('<prosody pitch="200Hz">a</prosody>', (MarkupKind.OTHER, "a", 1.0, "")),
        ('<audio src="x.wav">a</audio>', (MarkupKind.OTHER, "a", 1.0, "")),
    ],
)
def test_elements_say_how_a_part_of_the_text_is_spoken(ssml: str, expected: tuple[object, ...]) -> None:
    ((kind, part, number, text),) = markup(ssml + " and so on")
    assert (kind, part, number, text) == (*expected[:2], pytest.approx(expected[2], abs=1e-3), expected[3])


def test_the_text_has_single_spaces_and_no_text_of_metadata_and_marks_are_in_their_places() -> None:
    speech, problems = read(
        "<metadata><a>b</a></metadata> I <emphasis>do\n  mean</emphasis><mark name='it'/> it.<p>Yes</p><s>No</s>"
    )
    assert problems == ()
    assert speech.text == "I do mean it. Yes No"
    assert [(mark.id, mark.char_index) for mark in speech.marks] == [("it", 9)]


@pytest.mark.parametrize(
    ("ssml", "code", "about"),
    [
        ('<prosody rate="soon">a</prosody>', "bad-attribute", "rate='soon' of <prosody>"),
        ('<break time="12h"/>', "bad-attribute", "time='12h' of <break>"),
        ('<break time="11s"/>', "bad-attribute", "time='11s' of <break>"),
        ('<emphasis level="much">a</emphasis>', "bad-attribute", "level='much' of <emphasis>"),
        ('<prosody volume="1e999dB">a</prosody>', "bad-attribute", "of <prosody>: it must be"),
        (f'<prosody pitch="+{"9" * 500}st">a</prosody>', "bad-attribute", "of <prosody>: it must be"),
        ("<sub>a</sub>", "missing-attribute", "<sub>"),
        ("<mark/>", "missing-attribute", "<mark>"),
        ('<mark name="m n"/>', "bad-attribute", "name='m n' of <mark>"),
        ('<mark name="end"/>', "duplicate-id", "<mark>"),
        ('<prosody speed="fast">a</prosody>', "unknown-attribute", "<prosody>"),
    ],
)
def test_a_mistake_is_told_with_its_element_and_line_and_the_rest_is_spoken(ssml: str, code: str, about: str) -> None:
    speech, (problem,) = read(f"one\n {ssml} two")
    assert speech.text.startswith("one ")
    assert speech.text.endswith(" two")
    assert (problem.id, problem.fault.code, problem.fault.line) == ("b:s", code, 3)
    assert about in problem.fault.sentence


@pytest.mark.parametrize(
    ("ssml", "code"),
    [
        ("word " * 2_000, "utterance-too-long"),
        (f'<sub alias="{"word " * 2_000}">a</sub>', "utterance-too-long"),
        ("<emphasis>a</emphasis>" * 1_001, "too-much-markup"),
        ('<break time="10s"/>' * 7, "too-much-silence"),
        ("no mark", "missing-marks"),
    ],
)
def test_a_description_that_cannot_be_spoken_leaves_the_plain_text(ssml: str, code: str) -> None:
    speech, problems = read(ssml, '<text>Plain <sync id="m"/>text.</text>')
    assert speech.text == "Plain text."
    assert [problem.fault.code for problem in problems] == [code]


def test_a_description_without_speak_is_refused() -> None:
    description = '<description priority="1" type="application/ssml+xml">Hello.</description>'
    (parsed,) = parse(BLOCK.format(TEXT + description), Limits())
    assert [problem.fault.code for problem in parsed.problems] == ["missing-element"]


_TREES = st.recursive(
    st.text(st.characters(codec="ascii", categories=["L"]), max_size=5).map(lambda word: f"{word} "),
    lambda inside: st.builds(
        lambda element, parts: f"<{element}>{''.join(parts)}</{element.split()[0]}>",
        st.sampled_from(["p", "s", "emphasis", 'prosody rate="90%" pitch="+5%"', 'sub alias="x"', "other"]),
        st.lists(inside, max_size=3),
    ),
    max_leaves=12,
)


@settings(derandomize=True)
@given(_TREES)
def test_parts_lie_within_the_text_and_are_nested(ssml: str) -> None:
    speech, problems = read(f"a {ssml} b")
    assert problems == ()
    parts = [(each.first, each.last) for each in speech.markup]
    assert all(0 <= first <= last <= len(speech.text) for first, last in parts)
    assert all(not a < c < b < d for a, b in parts for c, d in parts)
