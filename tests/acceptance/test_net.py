"""What an engine shows outside of all units may fail: the figure lives on."""

import pytest

from reactive_realizer.engines.animation.gaze.looking import Looking
from reactive_realizer.engines.animation.idle.idle import Idle
from reactive_realizer.engines.animation.posture.footing import Footing
from reactive_realizer.engines.animation.release import Release
from reactive_realizer.testing.pilot import open_pilot


@pytest.mark.parametrize(
    ("part", "method", "what"),
    [
        (Footing, "layers", "where its feet are"),
        (Idle, "layer", "its idle life"),
        (Idle, "eyes", "its idle life"),
        (Idle, "weights", "its idle life"),
        (Looking, "eyes", "its gaze"),
    ],
)
async def test_one_part_of_a_figure_that_fails_is_left_out_and_logged_once(
    monkeypatch, caplog, part, method, what
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
    assert said.count(f"alice/animation: {what} fails, and is left out") == 1


async def test_what_units_have_left_behind_may_fail_and_others_play(monkeypatch) -> None:
    def failing(*args: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(Release, "at", failing)
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
