"""Isolation of failures outside of plan units."""

from typing import Any

import pytest

from reactive_realizer.engines.animation.fade_out import FadeOut
from reactive_realizer.engines.animation.gaze.eye_controller import EyeController
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.posture.foot_planting import FootPlanting
from reactive_realizer.testing.pilot import open_pilot


@pytest.mark.parametrize(
    ("part", "method", "what"),
    [
        (FootPlanting, "layers", "foot planting"),
        (Idle, "layer", "idle animation"),
        (Idle, "eyes", "idle animation"),
        (Idle, "blinks", "idle animation"),
        (EyeController, "eyes", "gaze"),
    ],
)
async def test_a_failing_part_of_the_animation_engine_is_left_out_and_logged_once(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, part: Any, method: str, what: str
) -> None:
    def failing(*args: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(part, method, failing)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.block("b", '<gesture id="g" lexeme="BEAT"/><gaze id="z" target="bluebox"/>')
        await pilot.advance(3)
        assert pilot.feedback.progress[-1] == "b:end"
        assert pilot.feedback.warnings == []
        assert len(pilot.frames["alice"]) == 150
    said = [record.getMessage() for record in caplog.records if record.levelname == "ERROR"]
    assert said.count(f"alice/animation: {what} failed and is left out") == 1


async def test_other_motions_play_when_fading_motion_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*args: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(FadeOut, "at", failing)
    async with open_pilot() as pilot:
        pilot.watch()
        pilot.block("a", '<gesture id="g" lexeme="BEAT"/>')
        await pilot.advance(0.6)
        pilot.block("b", composition="REPLACE")
        await pilot.advance(0.1)
        pilot.block("c", '<head id="n" lexeme="NOD"/>')
        await pilot.advance(2)
        assert "c:n:end" in pilot.feedback.progress
        assert pilot.feedback.warnings == []
