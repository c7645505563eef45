"""Viseme bindings: the sounds and the mouth shapes of an avatar, from files."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

from pathlib import Path

import pytest

from reactive_realizer.binding.mouth_shapes import SILENCE, VISEMES
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.engine.tts import completed
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.errors import RealizerError

from .conftest import ARKIT, OCULUS, bound, said


def test_a_phoneme_has_its_viseme_and_a_diphthong_has_two(binding: VisemeBinding) -> None:
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
    assert {symbol: binding.visemes(symbol) for symbol in visemes} == visemes


@pytest.mark.speech
async def test_every_phoneme_of_espeak_in_five_languages_has_a_viseme(binding: VisemeBinding) -> None:
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
            symbols = {phoneme.symbol for phoneme in (await completed(voice.synthesize(text, (), name))).phonemes}
            assert {symbol for symbol in symbols if not binding.visemes(symbol)} == set(), name
    finally:
        await voice.close()


def test_every_viseme_but_silence_has_a_shape_on_the_default_avatars(binding: VisemeBinding) -> None:
    assert set(binding.phonemes.values()) | {SILENCE} == set(VISEMES)
    assert [viseme for viseme in VISEMES if not binding.shapes[viseme].morphs] == [SILENCE]


def test_an_avatar_with_the_visemes_of_oculus_as_morph_targets_is_bound_to_them() -> None:
    oculus = bound(morphs=OCULUS)
    weights = LipSyncTrack(said(("ɑː", 0.3), ("p", 0.1), ("uː", 0.4)), oculus).weights
    assert weights(0.15)["viseme_aa"] == pytest.approx(1.0, abs=0.01)
    assert weights(0.29) == {"viseme_PP": 1.0}
    assert weights(0.6)["viseme_U"] == pytest.approx(1.0, abs=0.01)


def test_an_avatar_with_the_vowels_of_vrm_is_bound_to_them_unless_it_has_another_set() -> None:
    vowels = ("aa", "ih", "ou", "ee", "oh")
    weights = LipSyncTrack(said(("ɑː", 0.3), ("p", 0.1), ("uː", 0.4)), bound(morphs=vowels)).weights
    assert weights(0.15)["aa"] == pytest.approx(0.75, abs=0.01)
    assert not any(weights(0.29).values())
    assert weights(0.6)["ou"] == pytest.approx(0.9, abs=0.01)
    assert "viseme_aa" in bound(morphs=(*vowels, *OCULUS)).articulators["mouth"].morphs
    assert "jaw" in bound(morphs=(*vowels, *ARKIT)).articulators


def test_an_avatar_without_the_morph_targets_of_a_mouth_does_not_move_it() -> None:
    assert LipSyncTrack(said(("ɑː", 0.3)), bound(morphs=("browInnerUp",))).weights(0.15) == {}


def test_a_file_takes_precedence_over_later_ones_and_leaves_what_it_does_not_mention(tmp_path: Path) -> None:
    own, avatars = tmp_path / "own.toml", tmp_path / "female.visemes.toml"
    own.write_text('[phonemes]\noh = ["a"]\n[visemes.aa]\nmorphs = {jawOpen = 0.3}\n')
    avatars.write_text("[visemes.aa]\nmorphs = {jawOpen = 0.7}\n[visemes.E]\nmorphs = {jawOpen = 0.1}\n")
    mixed, standard = bound(own, avatars), bound()
    assert mixed.visemes("aɪ") == ("oh", "ih")
    assert [mixed.shapes[viseme].morphs for viseme in ("aa", "E")] == [{"jawOpen": 0.3}, {"jawOpen": 0.1}]
    assert mixed.shapes["ou"] == standard.shapes["ou"]


def test_a_file_with_articulators_describes_all_visemes(tmp_path: Path) -> None:
    own = tmp_path / "puppet.toml"
    own.write_text(
        '[articulators.beak]\nmorphs = ["open"]\nbefore = 0.03\nafter = 0.03\n[visemes.aa]\nmorphs = {open = 1}\n'
    )
    puppet = bound(own, morphs=("open", "jawOpen"))
    assert LipSyncTrack(said(("ɑː", 0.3)), puppet).weights(0.15)["open"] == pytest.approx(1.0, abs=0.02)
    assert puppet.visemes("uː") == ("ou",)
    assert LipSyncTrack(said(("uː", 0.3)), puppet).weights(0.15) == {}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("[visemes", r"own\.toml: the file: .*declaration"),
        ("[viseme.aa]", r"the file: 'viseme' is not known; did you mean 'visemes'\?"),
        ("visemes = 1", r"visemes: expected a table"),
        ("[visemes.AA]", r"visemes: 'AA' is not known; did you mean 'aa'\?"),
        ("[visemes.aa]\nmorf = {}", r"visemes\.aa: 'morf' is not known"),
        ("[visemes.aa]\nmorphs = {jawOpne = 1}", r"visemes\.aa\.morphs: 'jawOpne' is not .* did you mean 'jawOpen'\?"),
        ("[visemes.aa]\nmorphs = {jawOpen = 1.5}", r"visemes\.aa\.morphs\.jawOpen: 1\.5 is not a number from 0 to 1"),
        ("[visemes.aa]\nmorphs = {jawOpen = nan}", r"nan is not a number"),
        ("[visemes.aa]\nmorphs = {jawOpen = true}", r"True is not a number"),
        ("[visemes.aa]\nmorphs = {cheekPuff = 1}", r"visemes\.aa: no articulator moves 'cheekPuff'"),
        ("[visemes.aa]\ndominance = {jaw = 0}", r"visemes\.aa\.dominance\.jaw: 0 is not a number from 0\.001 to 1"),
        ("[visemes.aa]\ndominance = {jow = 1}", r"visemes\.aa: 'jow' is not an articulator"),
        ('[visemes.aa]\ncontact = ["lip"]', r"visemes\.aa: 'lip' is not an articulator; did you mean 'lips'\?"),
        ("[visemes.aa]\ncontact = true", r"visemes\.aa\.contact: expected a list of names"),
        ('[phonemes]\nQQ = ["q"]', r"phonemes: 'QQ' is not known"),
        ('[phonemes]\naa = ["abc"]', r"phonemes\.aa: 'abc' is not one letter or two"),
        ('[phonemes]\naa = ["a"]\nE = ["a"]', r"phonemes\.E: 'a' is also listed under aa"),
        ("[articulators.a]\nbefore = 1\nafter = 1", r"articulators\.a: it has neither morphs nor joints"),
        (
            '[articulators.a]\njoints = ["jaw"]\nbefore = 1\nafter = 1',
            r"articulators\.a\.joints: 'jaw' is not a joint of",
        ),
        (
            "[visemes.aa]\njoints = {temporomandibular = [9, 0, 0]}",
            r"joints: 'temporomandibular' is not a joint of the av",
        ),
        ('[articulators.a]\nmorphs = ["jawOpen"]\nbefore = 0.1', r"articulators\.a\.after: None is not a number"),
        (
            "".join(f'[articulators.{n}]\nmorphs = ["jawOpen"]\nbefore = 1\nafter = 1\n' for n in "ab"),
            r"articulators\.b\.morphs: 'jawOpen' also belongs to a",
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_refused_with_its_entry(tmp_path: Path, content: str, message: str) -> None:
    own = tmp_path / "own.toml"
    own.write_text(content)
    with pytest.raises(RealizerError, match=message):
        bound(own)
