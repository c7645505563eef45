"""Expressions and the mouth, as seen in frames."""

import os
import signal

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.speech_engine import SpeechEngine
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import weight

SMILE = (
    '<faceLexeme id="f" lexeme="RAISE_MOUTH_CORNERS" amount="{amount}" start="0" attackPeak="0.5" relax="1.5" end="2"/>'
)


async def test_a_face_is_held_from_its_attack_peak_to_its_relax_and_is_gone_at_its_end(pilot: RealizerPilot) -> None:
    pilot.block("b", SMILE.format(amount=1))
    await pilot.advance(3)
    smile = weight(pilot, "mouthSmileLeft")
    assert smile[0] == 0
    assert smile[25:75] == pytest.approx(smile.max())
    assert smile.max() > 0.3
    assert smile[101:] == pytest.approx(0, abs=0.01)
    assert np.abs(np.diff(smile)).max() < 0.1


async def test_the_amount_scales_a_face(pilot: RealizerPilot) -> None:
    pilot.block("b", SMILE.format(amount=1))
    await pilot.advance(3)
    full = weight(pilot, "mouthSmileLeft").max()
    pilot.frames.clear()
    pilot.block("c", SMILE.format(amount=0.5))
    await pilot.advance(3)
    assert weight(pilot, "mouthSmileLeft").max() == pytest.approx(full / 2, rel=0.01)


async def test_an_interrupted_face_fades_without_a_jump(pilot: RealizerPilot) -> None:
    pilot.block("b", SMILE.format(amount=1))
    await pilot.advance(1)
    pilot.block("stop", composition="REPLACE")
    await pilot.advance(1)
    smile = weight(pilot, "mouthSmileLeft")
    assert pilot.feedback.time("b:f:end") == 1.0
    assert np.abs(np.diff(smile)).max() < 0.1
    assert smile[-1] == 0


async def test_of_two_faces_that_need_the_mouth_one_is_dropped_and_brows_play_along(pilot: RealizerPilot) -> None:
    faces = ("RAISE_MOUTH_CORNERS", "LOWER_MOUTH_CORNERS", "RAISE_BROWS")
    pilot.block("b", "".join(f'<faceLexeme id="f{i}" lexeme="{name}"/>' for i, name in enumerate(faces)))
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:f1", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.reached("b:f2:end")


async def test_the_warning_of_an_unknown_lexeme_lists_the_known_ones(pilot: RealizerPilot) -> None:
    pilot.block("b", '<faceLexeme id="f" lexeme="SMIRK"/><wait id="w" duration="0.1"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:f", "CANNOT_CREATE_BEHAVIOR")]
    assert "RAISE_BROWS" in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.reached("b:w:end")


@pytest.mark.speech
async def test_the_mouth_opens_during_speech_and_closes_softly_when_it_is_interrupted() -> None:
    async with open_pilot(SceneOptions()) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s"><text>Bananas, papayas and apples are all on the table.</text></speech>')
        await pilot.advance(1)
        assert weight(pilot, "jawOpen").max() > 0.2
        pilot.block("stop", composition="REPLACE")
        await pilot.advance(1)
        jaw = weight(pilot, "jawOpen")
        assert np.abs(np.diff(jaw))[49:].max() < 0.1
        assert jaw[-1] == 0


@pytest.mark.speech
@pytest.mark.parametrize("cut", [0.3, 0.45, 0.6, 0.75, 0.9, None])
async def test_the_mouth_is_at_rest_within_150_ms_of_any_end(pilot: RealizerPilot, cut: float | None) -> None:
    pilot.block("b", '<speech id="s"><text>Bananas, papayas.</text></speech>')
    await pilot.advance(cut or 3)
    pilot.block("stop", composition="REPLACE")
    await pilot.advance(0.5)
    rest = round(50 * (pilot.feedback.time("b:s:end") + 0.15))
    mouth = [weight(pilot, morph) for morph in ("jawOpen", "mouthFunnel", "mouthPucker", "mouthClose")]
    assert max(morph.max() for morph in mouth) > 0.1
    assert max(morph[rest:].max() for morph in mouth) == pytest.approx(0.0, abs=0.005)


@pytest.mark.speech
@pytest.mark.parametrize("method", ["hear", "mouth"])
async def test_the_mouth_closes_when_speech_or_its_lip_sync_fails_and_a_face_stays(
    monkeypatch: pytest.MonkeyPatch, method: str
) -> None:
    frown = '<faceLexeme id="f" lexeme="LOWER_BROWS" start="0" end="3"/>'
    async with open_pilot(SceneOptions()) as pilot:
        pilot.watch()
        pilot.block("b", f'<speech id="s"><text>Bananas, papayas and apples are here.</text></speech>{frown}')
        await pilot.advance(1)
        monkeypatch.setattr(SpeechEngine, method, lambda self, _: 1 / 0)
        (sound,) = (change for change in pilot.sounds if isinstance(change, AudioStart))
        pilot.heard(sound.clip.id, 0.9, pilot.now)
        await pilot.advance(2.5)
        jaw = weight(pilot, "jawOpen")
        assert jaw[:50].max() > 0.2
        assert jaw[70:].max() == 0
        assert weight(pilot, "browDownLeft")[70:100].min() > 0.2
        assert pilot.feedback.reached("b:f:end")


@pytest.mark.speech
@pytest.mark.parametrize("answer", [7, {"jawOpen": float("nan")}, {"jawOpen": "wide"}])
async def test_lip_sync_that_gives_no_weights_leaves_the_mouth_closed_and_faces_as_they_are(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, answer: object
) -> None:
    monkeypatch.setattr(SpeechEngine, "mouth", lambda self, time: answer)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.block("b", SMILE.format(amount=1))
        await pilot.advance(2.5)
        assert pilot.feedback.warnings == []
        assert weight(pilot, "mouthSmileLeft").max() > 0.2
        assert weight(pilot, "jawOpen").max() == 0
    assert caplog.text.count("lip sync failed") == 1


@pytest.mark.speech
async def test_a_smile_has_half_its_mouth_during_the_whole_speech_and_never_jumps() -> None:
    async with open_pilot(SceneOptions()) as pilot:
        pilot.watch()
        smile = (
            '<faceLexeme id="f" lexeme="RAISE_MOUTH_CORNERS" amount="1" start="0" attackPeak="1" relax="6.5" end="7"/>'
        )
        said = 'Bananas, <sync id="m"/>papayas. Soft, warm apples: all of them are there.'
        pilot.block("b", f'{smile}<speech id="s" start="1.5"><text>{said}</text></speech>')
        await pilot.advance(7)
        assert pilot.feedback.time("b:s:end") < 6.2, "the smile is held longer than the speech"
        for morph in ("mouthSmileLeft", "mouthSmileRight", "mouthUpperUpLeft", "cheekSquintLeft"):
            assert np.abs(np.diff(weight(pilot, morph))).max() < 0.12
        smiling, end = weight(pilot, "mouthSmileLeft"), round(50 * pilot.feedback.time("b:s:end"))
        assert smiling[74] == pytest.approx(smiling.max())
        during = smiling[87 : end - 1]
        assert during == pytest.approx(0.5 * smiling[74], abs=0.02)
        assert smiling[end + 11] == pytest.approx(smiling[74], rel=0.05), "after the speech the smile has all its mouth"


@pytest.mark.speech
async def test_killing_the_speech_worker_drops_only_the_speech() -> None:
    async with open_pilot(SceneOptions()) as pilot:
        voice = pilot.scene.tts
        assert isinstance(voice, EspeakVoice)
        process = voice.worker.process
        assert process
        os.kill(process.pid, signal.SIGSTOP)  # so that the request of the speech is open when it is killed
        pilot.patient = False
        pilot.block("b", '<speech id="s"><text>Never heard.</text></speech><head id="h" lexeme="NOD"/>')
        while not process.busy:
            await pilot.tick()
        os.kill(process.pid, signal.SIGKILL)
        pilot.patient = True
        await pilot.advance(2)
        assert pilot.feedback.warnings == [("b:s", "CANNOT_CREATE_BEHAVIOR")]
        assert pilot.feedback.reached("b:h:end")
        pilot.block("c", '<speech id="s"><text>Here again.</text></speech>')
        await pilot.advance(2)
        assert pilot.feedback.reached("c:s:end")
        assert voice.worker.restarts == 1
