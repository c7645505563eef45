"""The lips of the avatars touch where speech needs it, as seen in frames: at any rate, by any sound, in any mood."""

# ruff: noqa: RUF001 - the letters of the International Phonetic Alphabet are meant

from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.phonetics import CLOSURE
from reactive_realizer.engine.tts import Phoneme, Utterance, Word, completed
from reactive_realizer.engines.face.expressions import Expressions
from reactive_realizer.engines.face.face_unit import MOUTH_MORPHS
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .face_mesh import FaceMesh

ASSETS = Assets()
EXPRESSIONS = Expressions.read(ASSETS("face/lexemes.json"), ASSETS("face/action_units.json"))
LEXEMES = [name for name in EXPRESSIONS.names if any(m.startswith(MOUTH_MORPHS) for m in EXPRESSIONS.lexemes[name])]
Face = tuple[float, dict[str, float]]
"""A time from the start of the speech, s, and the weights of the morph targets."""

VOWELS = ("ɑː", "iː", "uː", "ɔː", "ɛ")
CLOSED = 1e-3
"""Greatest height of the gap between closed lips, m."""
TOUCHING = 1.25e-3
"""Greatest distance of the edge of the lip from the teeth that it touches, m."""


@pytest.fixture(scope="module", params=["female", "male"])
def avatar(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture(scope="module")
def mesh(avatar: str) -> FaceMesh:
    return FaceMesh.read(ASSETS(f"avatars/{avatar}.glb"))


@pytest.fixture
def options(avatar: str, tmp_path: Path) -> SceneOptions:
    human = tmp_path / "human.toml"
    character = f'[character.alice]\navatar = "avatars/{avatar}.glb"\nengines = ["face", "speech"]\n'
    human.write_text(character, encoding="utf-8")
    return SceneOptions(human, "text")


def syllables(consonants: str, rate: float) -> Utterance:
    """Each consonant before each vowel.

    Args:
        consonants: letters.
        rate: sounds a second.
    """
    symbols = [symbol for pair in product(consonants, VOWELS) for symbol in pair]
    phonemes = [Phoneme(symbol, (1 + number) / rate, 1 / rate) for number, symbol in enumerate(symbols)]
    end = phonemes[-1].start + 1 / rate
    return Utterance("la", end + 0.3, (Word("la", 0.0, 0, 2),), {}, (*phonemes, Phoneme("", end, 0.3)))


async def faces(pilot: RealizerPilot, utterance: Utterance, lexeme: str = "NEUTRAL", text: str = "la") -> list[Face]:
    """The faces of a speech during an expression."""
    pilot.watch()
    pilot.block(
        "b",
        f'<faceLexeme id="f" lexeme="{lexeme}" amount="1" start="0" attackPeak="0.3" relax="19" end="19.5"/>'
        f'<speech id="s" start="0.5"><text>{text}</text></speech>',
    )
    await pilot.advance(0.5 + utterance.duration)
    assert pilot.feedback.warnings == []
    start = pilot.feedback.time("b:s:start")
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return [(frame.time - start, dict(zip(morphs, frame.weights, strict=True))) for frame in pilot.frames["alice"]]


def around_contact(phoneme: Phoneme, faces: list[Face]) -> list[dict[str, float]]:
    """The faces from 30 ms before a contact to its end; that of a plosive ends with its release, at most 30 ms late."""
    plosive = phoneme.symbol in ("p", "b")
    start = phoneme.start - CLOSURE if plosive else phoneme.start
    end = phoneme.start + 0.03 if plosive else phoneme.start + phoneme.duration
    return [weights for time, weights in faces if start - 0.03 <= time <= end]


@pytest.mark.parametrize("lexeme", LEXEMES)
async def test_lips_close_for_p_b_and_m_and_touch_the_teeth_for_f_and_v_in_any_mood_in_fast_speech(
    monkeypatch: pytest.MonkeyPatch, options: SceneOptions, mesh: FaceMesh, lexeme: str
) -> None:
    utterance = syllables("pbmfv", rate=20)
    monkeypatch.setattr(TextVoice, "synthesize", lambda *_: utterance)
    async with open_pilot(options) as pilot:
        shown = await faces(pilot, utterance, lexeme)
    for phoneme in utterance.phonemes:
        during = around_contact(phoneme, shown)
        if phoneme.symbol in ("p", "b", "m"):
            assert any(mesh.opening(weights) < CLOSED for weights in during), phoneme
        elif phoneme.symbol in ("f", "v"):
            assert any(mesh.lip_to_teeth(weights) < TOUCHING for weights in during), phoneme


async def test_the_mouth_opens_between_contacts(
    monkeypatch: pytest.MonkeyPatch, options: SceneOptions, mesh: FaceMesh
) -> None:
    utterance = syllables("pbmfv", rate=12)
    monkeypatch.setattr(TextVoice, "synthesize", lambda *_: utterance)
    async with open_pilot(options) as pilot:
        shown = await faces(pilot, utterance)
    for phoneme in utterance.phonemes:
        if phoneme.symbol in ("ɑː", "ɔː"):
            end = phoneme.start + phoneme.duration
            widest = max(mesh.opening(weights) for time, weights in shown if phoneme.start <= time < end)
            assert widest > 2.5e-3, phoneme


@pytest.mark.speech
async def test_lips_close_for_every_p_b_and_m_of_a_voice_while_the_face_opens_the_mouth(
    options: SceneOptions, mesh: FaceMesh
) -> None:
    text = "Pop up, Mum! Bob's big map, a pump, my poem: maybe Pam bumped a lamp by mishap; people jump, move, obey."
    async with open_pilot(replace(options, voice="espeak")) as pilot:
        utterance = await completed(pilot.scene.tts.synthesize(text, (), None))
        shown = await faces(pilot, utterance, "OPEN_MOUTH", text)
    closed = [phoneme for phoneme in utterance.phonemes if phoneme.symbol in ("p", "b", "m")]
    assert len(closed) > 25
    for phoneme in closed:
        assert any(mesh.opening(weights) < CLOSED for weights in around_contact(phoneme, shown)), phoneme
