"""What a mouth does while an utterance sounds."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.speech.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.viseme_steps import CLOSURE, SHORTEST_STEP
from reactive_realizer.engines.speech.viseme_track import VisemeTrack
from reactive_realizer.engines.speech.visemes import default_table

FASTEST = 1.5 / SHORTEST_STEP
"""Greatest change of a weight, 1/s: the slope in the middle of a smooth step of the shortest width."""
SYMBOLS = ["p", "b", "m", "f", "v", "t", "k", "s", "n", "h", "ˈiː", "ə", "aɪ", "ˈɔːɹ", "tʃ", "", "ʲ"]


def said(*sounds: tuple[str, float], pause: float = 0.3) -> Utterance:
    """An utterance of sounds with their durations, s, and a pause after it."""
    phonemes, time = [], 0.0
    for symbol, duration in [*sounds, ("", pause)]:
        phonemes.append(Phoneme(symbol, time, duration))
        time += duration
    return Utterance("", time, (), {}, tuple(phonemes))


def utterances(shortest: float) -> st.SearchStrategy[Utterance]:
    sounds = st.tuples(st.sampled_from(SYMBOLS), st.floats(shortest, 0.3))
    return st.lists(sounds, max_size=12).map(lambda listed: said(*listed))


def times(utterance: Utterance, step: float = 0.003) -> list[float]:
    return [step * n for n in range(-50, int(utterance.duration / step) + 50)]


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_weights_of_visemes_are_never_negative_and_sum_to_one(utterance):
    track = VisemeTrack(utterance)
    for time in times(utterance):
        weights = track.visemes(time)
        assert min(weights.values()) >= -1e-12
        assert sum(weights.values()) == pytest.approx(1.0)


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_weights_of_morphs_stay_between_nothing_and_all(utterance):
    track = VisemeTrack(utterance)
    for time in times(utterance):
        assert all(-1e-12 <= weight <= 1.0 for weight in track.weights(time).values())


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_mouth_never_jumps(utterance):
    track, step = VisemeTrack(utterance), 0.003
    for before, after in pairwise(track.visemes(time) for time in times(utterance, step)):
        for viseme in before.keys() | after.keys():
            assert abs(after.get(viseme, 0.0) - before.get(viseme, 0.0)) <= FASTEST * step + 1e-9


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_before_the_start_and_after_the_end_the_mouth_is_at_rest(utterance):
    track = VisemeTrack(utterance)
    for time in [-1.0, -1e-9, 0.0, utterance.duration, utterance.duration + 1.0]:
        assert sum(track.weights(time).values()) == pytest.approx(0.0)


@settings(derandomize=True)
@given(utterances(shortest=0.06))
def test_the_lips_come_together_for_every_p_b_and_m(utterance):
    track = VisemeTrack(utterance)
    for phoneme in utterance.phonemes:
        if phoneme.symbol in {"p", "b"} and phoneme.start >= CLOSURE:
            closed = [phoneme.start - CLOSURE * part / 10 for part in range(11)]
        elif phoneme.symbol == "m":
            closed = [phoneme.start + phoneme.duration * part / 10 for part in range(11)]
        else:
            continue
        assert max(track.visemes(time).get("PP", 0.0) for time in closed) == pytest.approx(1.0), phoneme


def test_the_lips_close_before_the_release_of_a_plosive_and_open_at_it():
    track = VisemeTrack(said(("ɑː", 0.3), ("p", 0.05), ("ɑː", 0.3)))
    assert track.visemes(0.3 - CLOSURE)["PP"] == pytest.approx(1.0)
    assert track.visemes(0.3)["PP"] == pytest.approx(1.0)
    assert 0.0 < track.visemes(0.35)["PP"] < 0.6


def test_a_long_vowel_is_reached_in_full():
    assert VisemeTrack(said(("m", 0.1), ("ɑː", 0.3))).visemes(0.25) == pytest.approx({"aa": 1.0})


def test_a_sound_that_is_too_short_is_not_reached_in_full():
    track = VisemeTrack(said(("ɑː", 0.2), ("n", 0.04), ("ɑː", 0.2)))
    assert 0.3 < max(track.visemes(0.2 + part * 0.04)["nn"] for part in (0.25, 0.5, 0.75)) < 0.9


def test_a_diphthong_goes_from_one_viseme_to_the_other():
    track = VisemeTrack(said(("aɪ", 0.3)))
    assert track.visemes(0.1)["aa"] == pytest.approx(1.0)
    assert track.visemes(0.24)["ih"] == pytest.approx(1.0)


def test_a_short_vowel_between_lip_sounds_opens_the_mouth():
    track = VisemeTrack(said(("m", 0.06), ("ɑː", 0.07), ("b", 0.07), ("ɑː", 0.2)))
    assert max(track.visemes(0.06 + n * 0.002)["PP"] for n in range(35)) == pytest.approx(1.0)
    assert min(track.visemes(0.06 + n * 0.002)["PP"] for n in range(35)) < 0.6


def test_the_jaw_is_open_in_a_vowel_and_closed_in_a_pause():
    track = VisemeTrack(said(("ɑː", 0.3), ("", 0.4), ("ɑː", 0.3)))
    assert track.weights(0.15) == pytest.approx(default_table().morphs["aa"])
    assert track.weights(0.5).get("jawOpen", 0.0) == pytest.approx(0.0)


def test_a_voice_without_phonemes_leaves_the_mouth_at_rest():
    assert VisemeTrack(TextVoice().speak("hello", ())).weights(0.1) == {}
