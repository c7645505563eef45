"""Plutchik's wheel of emotions."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.engines.face.emotion_wheel import EmotionWheel
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import weight
from .test_face_lexemes import ASSETS, OURS

WHEEL = EmotionWheel.read(ASSETS / "face" / "emotion_wheel.json", OURS)


@pytest.mark.parametrize(
    ("emotion", "angle", "activation"), [("FEAR", 45, 4.9), ("ANGER", 225, 4.2), ("ACCEPTANCE", 360, 3.4)]
)
def test_a_tabulated_place_has_the_face_of_its_lexeme(emotion: str, angle: float, activation: float) -> None:
    assert nonzero(WHEEL.weights(angle, activation)) == pytest.approx(OURS[emotion])


def test_a_place_between_two_emotions_has_a_share_of_both_and_the_activation_scales_it() -> None:
    face = WHEEL.weights(270 + 15, 2.0)  # a third of the way from anticipation to joy
    assert face["browInnerUp"] == pytest.approx(2 / 3 * 2.0 / 3.9 * OURS["INTEREST"]["browInnerUp"])
    assert face["cheekSquintLeft"] == pytest.approx(1 / 3 * 2.0 / 5.4 * OURS["JOY"]["cheekSquintLeft"])


@given(st.floats(0, 360), st.floats(0, 7), st.floats(-0.01, 0.01))
def test_faces_change_gradually_around_the_wheel_and_are_possible(angle: float, activation: float, step: float) -> None:
    here, there = WHEEL.weights(angle, activation), WHEEL.weights((angle + step) % 360, activation)
    assert all(0.0 <= weight <= 1.0 for weight in here.values())
    for morph in here.keys() | there.keys():
        assert there.get(morph, 0.0) == pytest.approx(here.get(morph, 0.0), abs=0.002)


async def test_an_emotion_plays_at_its_intensity(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:faceplutchik id="f" angle="315" activation="5.4" intensity="0.5"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == []
    assert weight(pilot, "mouthSmileLeft").max() == pytest.approx(0.5 * OURS["JOY"]["mouthSmileLeft"])
    assert weight(pilot, "cheekSquintLeft").max() > 0.2, "a smile reaches the eyes"


@pytest.mark.parametrize(
    ("emotions", "message"),
    [
        ({}, "<emotions>: there are none"),
        ({"JOY": {"angle": "0", "activation": 1}}, "<JOY>: an emotion has an angle and an activation"),
        ({"JOY": {"angle": 360, "activation": 1}}, "<JOY>: the angle is from 0 to 360"),
        ({"MIRTH": {"angle": 0, "activation": 1}}, "<MIRTH>: there is no such lexeme"),
    ],
)
def test_an_invalid_wheel_is_refused(tmp_path: Path, emotions: object, message: str) -> None:
    path = tmp_path / "wheel.json"
    path.write_text(json.dumps({"emotions": emotions}))
    with pytest.raises(RealizerError, match=message):
        EmotionWheel.read(path, OURS)


def nonzero(weights: dict[str, float]) -> dict[str, float]:
    return {morph: weight for morph, weight in weights.items() if weight}
