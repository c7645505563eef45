"""What a speaker does with a phrase."""

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, word_spans
from reactive_realizer.liveliness.movement import SOONEST, Movement
from reactive_realizer.liveliness.phrase_planner import PhrasePlanner
from reactive_realizer.liveliness.prosody import phrases_of, with_prominence
from reactive_realizer.liveliness.word_classes import read_word_classes
from reactive_realizer.planunit.body_parts import BodyPart

CLASSES = read_word_classes(PACKAGE_ASSETS / "liveliness" / "english.toml")
WORDS = [
    "not",
    "very",
    "Hello",
    "but",
    "you",
    "there",
    "all",
    "maybe",
    "red",
    "house",
    "and",
    "the",
    "?",
    ".",
    ",",
    "\u2013",
    "\u0438",
]


@st.composite
def utterances(draw: st.DrawFn) -> Utterance:
    """Utterances of which the voice gives words at any distance, and perhaps phonemes."""
    text = " ".join(draw(st.lists(st.sampled_from(WORDS), min_size=1, max_size=40)))
    words, time = [], 0.0
    for first, last in word_spans(text):
        words.append(Word(text[first:last], time, first, last))
        time += draw(st.floats(0.0, 1.0))
    phonemes = [Phoneme(draw(st.sampled_from(["a", "\u02c8a", ""])), word.start, 0.1) for word in words]
    return Utterance(text, time, tuple(words), {}, tuple(phonemes) if draw(st.booleans()) else ())


def planned(utterance: Utterance, liveliness: float, seed: str = "s") -> list[list[Movement]]:
    phrases = phrases_of(utterance, CLASSES.function_words)
    planner = PhrasePlanner(CLASSES, seed, "viewer")
    phrases = [with_prominence(phrase, utterance, ()) for phrase in phrases]
    return [planner.plan(phrases, index, liveliness, lambda _: False) for index in range(len(phrases))]


@given(utterances(), st.floats(0.01, 1.0))
def test_no_movement_is_too_early_or_too_large_whatever_is_said(utterance: Utterance, liveliness: float) -> None:
    for each in (each for own in planned(utterance, liveliness) for each in own):
        times = [anchor.word.start + anchor.offset for anchor in each.anchors.values()]
        assert min(times) >= SOONEST - 1e-9
        assert each.amount is None or 0.0 <= each.amount <= 1.0


@given(utterances())
def test_movements_of_one_kind_do_not_overlap(utterance: Utterance) -> None:
    for own in planned(utterance, 1.0):
        short = [each for each in own if not each.lasting and "NOD" in each.attributes.values()]
        assert not any(one.overlaps(other.span) for one, other in combinations(short, 2))


@given(utterances())
def test_a_part_that_is_busy_is_left_alone(utterance: Utterance) -> None:
    phrases = [with_prominence(each, utterance, ()) for each in phrases_of(utterance, CLASSES.function_words)]
    planner = PhrasePlanner(CLASSES, "s", "viewer")
    for index in range(len(phrases)):
        made = planner.plan(phrases, index, 1.0, lambda each: BodyPart.HEAD in each.parts)
        assert not any(BodyPart.HEAD in each.parts for each in made)


@given(utterances())
def test_the_same_words_are_planned_alike(utterance: Utterance) -> None:
    assert planned(utterance, 0.5) == planned(utterance, 0.5)


@given(utterances())
def test_more_liveliness_makes_more_and_larger_movements(utterance: Utterance) -> None:
    little, much = (
        sum(each.amount or 0.0 for own in planned(utterance, level) for each in own) for level in (0.1, 0.9)
    )
    assert little <= much
