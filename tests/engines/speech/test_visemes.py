"""The table from phonemes to visemes to the blend shapes of a face."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

import re
from importlib.resources import files

import pytest

from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.visemes import SILENCE, default_table

TABLE = default_table()
OCULUS = {"sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"}


@pytest.mark.parametrize(
    ("symbol", "visemes"),
    [
        ("p", ("PP",)),
        ("m", ("PP",)),
        ("v", ("FF",)),
        ("θ", ("TH",)),
        ("tʃ", ("CH",)),
        ("dʒ", ("CH",)),
        ("ŋ", ("kk",)),
        ("ˈiː", ("ih",)),
        ("n̩", ("nn",)),
        ("aɪ", ("aa", "ih")),
        ("ˈoʊ", ("oh", "ou")),
        ("ˈɔːɹ", ("oh", "RR")),
        ("", (SILENCE,)),
        ("ʲ", ()),
    ],
)
def test_a_phoneme_has_its_visemes_a_diphthong_two(symbol, visemes):
    assert TABLE.visemes(symbol) == visemes


def test_there_are_the_fifteen_visemes_of_the_oculus_set():
    assert {SILENCE, *TABLE.morphs} == OCULUS
    assert set(TABLE.phonemes.values()) == OCULUS - {SILENCE}


def test_every_shape_is_made_of_blend_shapes_that_the_avatars_have():
    for avatar in ["female", "male"]:
        data = (files("reactive_realizer") / f"assets/avatars/{avatar}.glb").read_bytes()
        names = set(re.findall(rb'"([a-z]+[A-Za-z]+)"', data[: data.index(b"BIN\0")]))
        assert {morph.encode() for shape in TABLE.morphs.values() for morph in shape} <= names


def test_a_mixture_is_the_weighted_sum_of_its_visemes():
    mixed = TABLE.blend({"aa": 0.5, "oh": 0.5})
    assert mixed["jawOpen"] == pytest.approx((TABLE.morphs["aa"]["jawOpen"] + TABLE.morphs["oh"]["jawOpen"]) / 2)
    assert TABLE.blend({SILENCE: 1.0}) == {}


@pytest.mark.speech
async def test_every_sound_that_the_voice_makes_in_the_languages_around_us_has_a_viseme():
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
