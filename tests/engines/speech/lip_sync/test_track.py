"""The mouth of an utterance over time: co-articulation, contacts, and rest before and after it."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.engine.phonetics import CLOSURE
from reactive_realizer.engine.tts import Phoneme, Utterance
from reactive_realizer.engines.speech.lip_sync.contacts import APPROACH
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.engines.speech.text_voice import TextVoice

from .conftest import OCULUS, bound, said

ARKIT_BINDING, OCULUS_BINDING = bound(), bound(morphs=OCULUS)
FRAME = 0.02
"""s"""
SYMBOLS = ["p", "b", "m", "f", "v", "t", "k", "s", "n", "h", "ˈiː", "ə", "aɪ", "ˈɔːɹ", "uː", "tʃ", "", "ʲ"]


def utterances(shortest: float, symbols: Sequence[str] = SYMBOLS) -> st.SearchStrategy[Utterance]:
    sounds = st.tuples(st.sampled_from(symbols), st.floats(shortest, 0.3))
    return st.lists(sounds, max_size=12).map(lambda listed: said(*listed))


def times(utterance: Utterance, step: float = 0.003) -> list[float]:
    return [step * n for n in range(-20, int(utterance.duration / step) + 20)]


def touch(symbol: str, track: LipSyncTrack, time: float) -> float:
    """How far lips, or lip and teeth, are together for a sound: 1 while they touch (Oculus binding)."""
    return track.weights(time).get("viseme_FF" if symbol in ("f", "v") else "viseme_PP", 0.0)


def contact(phoneme: Phoneme) -> tuple[float, float]:
    """The time in which the lips are together for a sound: a plosive sounds when they open."""
    if phoneme.symbol in ("p", "b"):
        return phoneme.start - CLOSURE, phoneme.start
    return phoneme.start, phoneme.start + phoneme.duration


@settings(derandomize=True)
@given(utterances(shortest=0.0), st.sampled_from([ARKIT_BINDING, OCULUS_BINDING]))
def test_weights_are_between_0_and_1(utterance: Utterance, binding: VisemeBinding) -> None:
    track = LipSyncTrack(utterance, binding)
    for time in times(utterance):
        assert all(0.0 <= weight <= 1.0 + 1e-9 for weight in track.weights(time).values())


# From closed lips straight to the teeth, there may be less time.
ONE_CONTACT = st.sampled_from(["pbm", "fv"]).flatmap(
    lambda left_out: utterances(0.04, [symbol for symbol in SYMBOLS if not symbol or symbol not in left_out])
)


@settings(derandomize=True)
@given(ONE_CONTACT)
def test_no_weight_changes_by_more_than_four_tenths_from_frame_to_frame(utterance: Utterance) -> None:
    track = LipSyncTrack(utterance, ARKIT_BINDING)
    for before, after in ((track.weights(time), track.weights(time + FRAME)) for time in times(utterance)):
        assert all(abs(after.get(name, 0.0) - before.get(name, 0.0)) <= 0.4001 for name in before.keys() | after.keys())


@settings(derandomize=True)
@given(utterances(shortest=0.0))
def test_the_mouth_is_at_rest_before_and_after_the_utterance(utterance: Utterance) -> None:
    track = LipSyncTrack(utterance, ARKIT_BINDING)
    for time in [-1.0, -1e-9, 0.0, utterance.duration, utterance.duration + 1.0]:
        assert sum(track.weights(time).values()) == pytest.approx(0.0)


@settings(derandomize=True)
@given(utterances(shortest=0.04))
def test_a_frame_shows_every_contact_at_most_a_step_late(utterance: Utterance) -> None:
    track = LipSyncTrack(utterance, OCULUS_BINDING)
    for phoneme in utterance.phonemes:
        if phoneme.symbol in {"p", "b", "m", "f", "v"}:
            begin, end = contact(phoneme)
            shown = [n * FRAME for n in range(int((begin - APPROACH) / FRAME), int((end + APPROACH) / FRAME) + 1)]
            assert max(touch(phoneme.symbol, track, time) for time in shown) == pytest.approx(1.0), phoneme


@settings(derandomize=True)
@given(st.tuples(st.sampled_from(SYMBOLS), st.floats(0.12, 0.3)), st.sampled_from("pbmfv"), st.floats(0.06, 0.3))
def test_a_contact_comes_in_time_after_a_longer_sound(before: tuple[str, float], symbol: str, duration: float) -> None:
    utterance = said(("", 0.1), before, (symbol, duration), ("ə", 0.1))
    begin, end = contact(utterance.phonemes[2])
    track = LipSyncTrack(utterance, OCULUS_BINDING)
    assert max(touch(symbol, track, begin + (end - begin) * n / 20) for n in range(21)) == pytest.approx(1.0)


def test_the_lips_close_before_the_release_of_a_plosive_and_open_at_its_release() -> None:
    track = LipSyncTrack(said(("ɑː", 0.3), ("p", 0.05), ("ɑː", 0.3)), OCULUS_BINDING)
    assert [touch("p", track, 0.3 - early) for early in (CLOSURE, 0.0)] == pytest.approx([1.0, 1.0])
    assert touch("p", track, 0.3 - CLOSURE - APPROACH) < 0.1
    assert 0.0 < touch("p", track, 0.35) < 0.6


def test_a_short_vowel_between_lip_sounds_opens_the_mouth() -> None:
    track = LipSyncTrack(said(("n", 0.1), ("m", 0.06), ("ɑː", 0.07), ("b", 0.07), ("ɑː", 0.2)), OCULUS_BINDING)
    together = [touch("m", track, 0.1 + n * 0.002) for n in range(66)]
    assert max(together[:30]) == max(together[40:]) == pytest.approx(1.0)
    assert min(together) < 0.6


def test_a_long_vowel_has_its_shape_and_a_short_sound_with_little_dominance_takes_that_of_its_neighbors() -> None:
    track = LipSyncTrack(said(("ɑː", 0.3), ("h", 0.06), ("ɑː", 0.3)), ARKIT_BINDING)
    jaw = {viseme: ARKIT_BINDING.shapes[viseme].morphs["jawOpen"] for viseme in ("aa", "kk")}
    assert track.weights(0.15)["jawOpen"] == pytest.approx(jaw["aa"], abs=0.01)
    assert (jaw["aa"] + jaw["kk"]) / 2 < track.weights(0.33)["jawOpen"] < jaw["aa"]


def test_lips_are_rounded_for_a_vowel_already_in_the_consonants_before_it() -> None:
    spread, rounded = (
        LipSyncTrack(said(("s", 0.1), ("t", 0.08), (vowel, 0.3)), ARKIT_BINDING) for vowel in ("iː", "uː")
    )
    assert rounded.weights(0.15)["mouthPucker"] > 0.4
    assert spread.weights(0.15).get("mouthPucker", 0.0) == 0.0


def test_a_diphthong_goes_from_one_viseme_to_the_other() -> None:
    track = LipSyncTrack(said(("aɪ", 0.3)), OCULUS_BINDING)
    assert track.weights(0.1)["viseme_aa"] > 0.8
    assert track.weights(0.24)["viseme_I"] > 0.8


def test_an_initial_vowel_opens_the_mouth_after_its_onset() -> None:
    track = LipSyncTrack(said(("ˈɔː", 0.3)), OCULUS_BINDING)
    assert [track.weights(time).get("viseme_O", 0.0) for time in (0.0, 0.02)] == [0.0, pytest.approx(0.3, abs=0.1)]
    assert track.weights(0.15)["viseme_O"] == pytest.approx(1.0, abs=0.01)


def test_the_mouth_closes_in_a_pause_but_not_in_the_break_within_a_word() -> None:
    pause, break_ = (LipSyncTrack(said(("ɑː", 0.3), ("", gap), ("ɑː", 0.3)), ARKIT_BINDING) for gap in (0.4, 0.04))
    assert pause.weights(0.5).get("jawOpen", 0.0) < 0.01
    assert break_.weights(0.32)["jawOpen"] == pytest.approx(ARKIT_BINDING.shapes["aa"].morphs["jawOpen"])


def test_an_utterance_without_phonemes_leaves_the_mouth_at_rest() -> None:
    assert LipSyncTrack(TextVoice().synthesize("hello", ()), ARKIT_BINDING).weights(0.1) == {}
