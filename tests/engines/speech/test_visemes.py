"""The viseme table, and the visemes of an utterance over time."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

import re
from importlib.resources import files

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.speech.visemes import CLOSURE, SILENCE, STEP, VisemeTrack, default_table

TABLE = default_table()
OCULUS = {"sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"}


def test_a_phoneme_has_its_viseme_and_a_diphthong_has_two() -> None:
    visemes = {
        "p": ("PP",),
        "m": ("PP",),
        "v": ("FF",),
        "θ": ("TH",),
        "tʃ": ("CH",),
        "dʒ": ("CH",),
        "ŋ": ("kk",),
        "ˈiː": ("ih",),
        "n̩": ("nn",),
        "aɪ": ("aa", "ih"),
        "ˈoʊ": ("oh", "ou"),
        "ˈɔːɹ": ("oh", "RR"),
        "": (SILENCE,),
        "ʲ": (),
    }
    assert {symbol: TABLE.visemes(symbol) for symbol in visemes} == visemes


def test_the_table_has_the_fifteen_visemes_of_the_oculus_set() -> None:
    assert {SILENCE, *TABLE.morphs} == OCULUS
    assert set(TABLE.phonemes.values()) == OCULUS - {SILENCE}


def test_the_avatars_have_all_blend_shapes_of_the_table() -> None:
    for avatar in ["female", "male"]:
        data = (files("reactive_realizer") / f"assets/avatars/{avatar}.glb").read_bytes()
        names = set(re.findall(rb'"([a-z]+[A-Za-z]+)"', data[: data.index(b"BIN\0")]))
        assert {morph.encode() for shape in TABLE.morphs.values() for morph in shape} <= names


def test_a_blend_is_the_weighted_sum_of_its_visemes() -> None:
    mixed = TABLE.blend({"aa": 0.5, "oh": 0.5})
    assert mixed["jawOpen"] == pytest.approx((TABLE.morphs["aa"]["jawOpen"] + TABLE.morphs["oh"]["jawOpen"]) / 2)
    assert TABLE.blend({SILENCE: 1.0}) == {}


@pytest.mark.speech
async def test_every_phoneme_of_espeak_in_five_languages_has_a_viseme() -> None:
    texts = {
        "en-us": "The quick brown fox jumps over the lazy dog; measure your choice, judge, of thin things that sing.",
        "en-gb": "Pure air, a bare ear, poor tour, a bird, hot tea, my boy goes out there now.",
        "nl": "De snelle bruine vos springt over de luie hond, ik zeg jullie een ui, ja, een heuvel.",
        "de": "Zwölf große Boxkämpfer jagen Viktor quer über den Sylter Deich.",
        "fr": "Portez ce vieux whisky au juge blond qui fume un oignon.",
    }
    voice = EspeakVoice()
    try:
        for name, text in texts.items():
            symbols = {phoneme.symbol for phoneme in (await voice.synthesize(text, (), name)).phonemes}
            assert {symbol for symbol in symbols if not TABLE.visemes(symbol)} == set(), name
    finally:
        await voice.close()


# --- the visemes of an utterance


FRAME = 0.02
"""s"""
SYMBOLS = ["p", "b", "m", "f", "v", "t", "k", "s", "n", "h", "ˈiː", "ə", "aɪ", "ˈɔːɹ", "tʃ", "", "ʲ"]


def said(*sounds: tuple[str, float], pause: float = 0.3) -> Utterance:
    """An utterance of sounds with their durations, s, and a pause at its end."""
    phonemes, time = [], 0.0
    for symbol, duration in [*sounds, ("", pause)]:
        phonemes.append(Phoneme(symbol, time, duration))
        time += duration
    return Utterance("", time, (), {}, tuple(phonemes))


def utterances(shortest: float) -> st.SearchStrategy[Utterance]:
    sounds = st.tuples(st.sampled_from(SYMBOLS), st.floats(shortest, 0.3))
    return st.lists(sounds, max_size=12).map(lambda listed: said(*listed))


def held(phoneme: Phoneme) -> tuple[float, float]:
    """The time in which the lips are closed for a sound: a plosive sounds when they open."""
    if phoneme.symbol == "m":
        return phoneme.start, phoneme.start + phoneme.duration
    return phoneme.start - CLOSURE, phoneme.start


def closest(track: VisemeTrack, begin: float, end: float) -> float:
    """The largest weight of closed lips in a time."""
    return max(track.visemes(begin + (end - begin) * part / 50).get("PP", 0.0) for part in range(51))


def times(utterance: Utterance, step: float = 0.003) -> list[float]:
    return [step * n for n in range(-50, int(utterance.duration / step) + 50)]


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_weights_of_visemes_are_never_negative_and_sum_to_one(utterance: Utterance) -> None:
    track = VisemeTrack(utterance)
    for time in times(utterance):
        weights = track.visemes(time)
        assert min(weights.values()) >= -1e-12
        assert sum(weights.values()) == pytest.approx(1.0)


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_weights_of_morphs_are_between_0_and_1(utterance: Utterance) -> None:
    track = VisemeTrack(utterance)
    for time in times(utterance):
        assert all(-1e-12 <= weight <= 1.0 for weight in track.weights(time).values())


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_no_weight_changes_by_more_than_three_tenths_from_frame_to_frame(utterance: Utterance) -> None:
    track = VisemeTrack(utterance)
    for before, after in ((track.visemes(time), track.visemes(time + FRAME)) for time in times(utterance)):
        assert all(abs(after.get(name, 0.0) - before.get(name, 0.0)) <= 0.3 for name in before.keys() | after.keys())


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_mouth_is_at_rest_before_and_after_the_utterance(utterance: Utterance) -> None:
    track = VisemeTrack(utterance)
    for time in [-1.0, -1e-9, 0.0, utterance.duration, utterance.duration + 1.0]:
        assert sum(track.weights(time).values()) == pytest.approx(0.0)


@settings(derandomize=True)
@given(utterances(shortest=0.06))
def test_the_lips_close_for_every_p_b_and_m_at_most_a_step_late(utterance: Utterance) -> None:
    track = VisemeTrack(utterance)
    for phoneme in utterance.phonemes:
        if phoneme.symbol in {"p", "b", "m"}:
            begin, end = held(phoneme)
            assert closest(track, begin - FRAME, end + STEP) == pytest.approx(1.0), phoneme


@settings(derandomize=True)
@given(st.tuples(st.sampled_from(SYMBOLS), st.floats(0.12, 0.3)), st.sampled_from("pbm"), st.floats(0.06, 0.3))
def test_the_lips_close_in_time_after_another_sound(before: tuple[str, float], symbol: str, duration: float) -> None:
    utterance = said(("", 0.1), before, (symbol, duration), ("ə", 0.1))
    begin, end = held(utterance.phonemes[2])
    assert closest(VisemeTrack(utterance), begin, end) == pytest.approx(1.0)


def test_the_lips_close_before_the_release_of_a_plosive_and_open_at_its_release() -> None:
    track = VisemeTrack(said(("ɑː", 0.3), ("p", 0.05), ("ɑː", 0.3)))
    assert track.visemes(0.3 - CLOSURE)["PP"] == pytest.approx(1.0)
    assert track.visemes(0.3)["PP"] == pytest.approx(1.0)
    assert 0.0 < track.visemes(0.35)["PP"] < 0.6


def test_the_viseme_of_a_long_vowel_is_reached_in_full() -> None:
    assert VisemeTrack(said(("m", 0.1), ("ɑː", 0.3))).visemes(0.25) == pytest.approx({"aa": 1.0})


def test_the_viseme_of_a_short_sound_is_not_reached_in_full() -> None:
    track = VisemeTrack(said(("ɑː", 0.2), ("n", 0.04), ("ɑː", 0.2)))
    assert 0.3 < max(track.visemes(0.2 + part * 0.04)["nn"] for part in (0.25, 0.5, 0.75)) < 0.9


def test_a_diphthong_goes_from_one_viseme_to_the_other() -> None:
    track = VisemeTrack(said(("aɪ", 0.3)))
    assert track.visemes(0.1)["aa"] == pytest.approx(1.0)
    assert track.visemes(0.24)["ih"] == pytest.approx(1.0)


def test_a_short_vowel_between_lip_sounds_opens_the_mouth() -> None:
    track = VisemeTrack(said(("n", 0.1), ("m", 0.06), ("ɑː", 0.07), ("b", 0.07), ("ɑː", 0.2)))
    together = [track.visemes(0.1 + n * 0.002).get("PP", 0.0) for n in range(66)]
    assert max(together[:30]) == max(together[40:]) == pytest.approx(1.0)
    assert min(together) < 0.6


def test_an_initial_vowel_opens_the_mouth_after_its_onset() -> None:
    track = VisemeTrack(said(("ˈɔːɹ", 0.3)))
    assert track.visemes(0.0) == {"sil": 1.0}
    assert track.visemes(FRAME)["oh"] < 0.3
    assert track.visemes(STEP)["oh"] == pytest.approx(1.0)


def test_the_jaw_is_open_in_a_vowel_and_closed_in_a_pause() -> None:
    track = VisemeTrack(said(("ɑː", 0.3), ("", 0.4), ("ɑː", 0.3)))
    assert track.weights(0.15) == pytest.approx(default_table().morphs["aa"])
    assert track.weights(0.5).get("jawOpen", 0.0) == pytest.approx(0.0)


def test_an_utterance_without_phonemes_leaves_the_mouth_at_rest() -> None:
    assert VisemeTrack(TextVoice().synthesize("hello", ())).weights(0.1) == {}
