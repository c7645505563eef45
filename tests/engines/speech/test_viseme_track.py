"""What a mouth does while an utterance sounds."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.speech.viseme_steps import CLOSURE, STEP
from reactive_realizer.engines.speech.viseme_track import VisemeTrack
from reactive_realizer.engines.speech.visemes import default_table

FRAME = 0.02
"""s"""
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


def held(phoneme: Phoneme) -> tuple[float, float]:
    """From when until when lips make a sound: a plosive is heard when they part."""
    if phoneme.symbol == "m":
        return phoneme.start, phoneme.start + phoneme.duration
    return phoneme.start - CLOSURE, phoneme.start


def closest(track: VisemeTrack, begin: float, end: float) -> float:
    """How far the lips come together within a time."""
    return max(track.visemes(begin + (end - begin) * part / 50).get("PP", 0.0) for part in range(51))


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
def test_no_weight_changes_by_more_than_three_tenths_from_frame_to_frame(utterance):
    track = VisemeTrack(utterance)
    for before, after in ((track.visemes(time), track.visemes(time + FRAME)) for time in times(utterance)):
        assert all(abs(after.get(name, 0.0) - before.get(name, 0.0)) <= 0.3 for name in before.keys() | after.keys())


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_before_the_start_and_after_the_end_the_mouth_is_at_rest(utterance):
    track = VisemeTrack(utterance)
    for time in [-1.0, -1e-9, 0.0, utterance.duration, utterance.duration + 1.0]:
        assert sum(track.weights(time).values()) == pytest.approx(0.0)


@settings(derandomize=True)
@given(utterances(shortest=0.06))
def test_the_lips_come_together_for_every_p_b_and_m_at_most_a_step_late(utterance):
    track = VisemeTrack(utterance)
    for phoneme in utterance.phonemes:
        if phoneme.symbol in {"p", "b", "m"}:
            begin, end = held(phoneme)
            assert closest(track, begin - FRAME, end + STEP) == pytest.approx(1.0), phoneme


@settings(derandomize=True)
@given(st.tuples(st.sampled_from(SYMBOLS), st.floats(0.12, 0.3)), st.sampled_from("pbm"), st.floats(0.06, 0.3))
def test_the_lips_come_together_in_time_where_there_is_a_sound_before(before, symbol, duration):
    utterance = said(("", 0.1), before, (symbol, duration), ("ə", 0.1))
    begin, end = held(utterance.phonemes[2])
    assert closest(VisemeTrack(utterance), begin, end) == pytest.approx(1.0)


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
    track = VisemeTrack(said(("n", 0.1), ("m", 0.06), ("ɑː", 0.07), ("b", 0.07), ("ɑː", 0.2)))
    together = [track.visemes(0.1 + n * 0.002).get("PP", 0.0) for n in range(66)]
    assert max(together[:30]) == max(together[40:]) == pytest.approx(1.0)
    assert min(together) < 0.6


def test_a_speech_that_begins_with_a_vowel_opens_the_mouth_inside_of_it():
    track = VisemeTrack(said(("ˈɔːɹ", 0.3)))
    assert track.visemes(0.0) == {"sil": 1.0}
    assert track.visemes(FRAME)["oh"] < 0.3
    assert track.visemes(STEP)["oh"] == pytest.approx(1.0)


def test_the_jaw_is_open_in_a_vowel_and_closed_in_a_pause():
    track = VisemeTrack(said(("ɑː", 0.3), ("", 0.4), ("ɑː", 0.3)))
    assert track.weights(0.15) == pytest.approx(default_table().morphs["aa"])
    assert track.weights(0.5).get("jawOpen", 0.0) == pytest.approx(0.0)


def test_a_voice_without_phonemes_leaves_the_mouth_at_rest():
    assert VisemeTrack(TextVoice().synthesize("hello", ())).weights(0.1) == {}
