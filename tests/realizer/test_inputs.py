"""Inputs: documents that were parsed before they are put, and places of targets."""

from math import inf, nan

import pytest

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.bml.document import parse
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.realizer.inputs import BmlText, TickInputs
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.testing.pilot import block, open_pilot

WAIT = '<wait id="w" duration="1"/>'


async def test_a_parsed_document_enters_as_it_was_parsed() -> None:
    async with open_pilot() as pilot:
        pilot.realizer.put(BmlText("read before", parsed=parse(block("b", WAIT), pilot.realizer.limits)))
        await pilot.advance(2)
        assert pilot.feedback.progress == ["b:start", "b:w:start", "b:w:end", "b:end"]


async def test_the_server_parses_a_document_for_the_realizer_too() -> None:
    entered: list[BmlText] = []
    async with open_scene(SceneOptions(voice="text")) as scene:
        live = LiveScene(scene, ManualClock())

        def note(inputs: TickInputs) -> None:
            entered.extend(each for each in inputs.inputs if isinstance(each, BmlText))

        live.realizer.record(note)
        for name, enter in (("b", Intake(live).document), ("c", Intake(live).blocks)):
            assert (await enter(block(name, WAIT))).blocks == [name]
        await live.step(Tick.following(None, 0))
    assert [[each.block and each.block.id for each in entry.parsed or ()] for entry in entered] == [["b"], ["c"]]


@pytest.mark.parametrize(
    ("position", "orientation", "reason"),
    [
        ((0.0, nan, 1.0), None, "not a finite number"),
        ((0.0, 1.0, inf), (1.0, 0.0, 0.0, 0.0), "not a finite number"),
        ((0.0, 1.0, 1.0), (nan, 0.0, 0.0, 1.0), "not a finite number"),
        ((0.0, 1.0, 1.0), (1.0, -inf, 0.0, 0.0), "not a finite number"),
        ((0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0), "an orientation is a quaternion of length 1, not 0"),
        ((0.0, 1.0, 1.0), (2.0, 0.0, 0.0, 0.0), "an orientation is a quaternion of length 1, not 2"),
    ],
)
async def test_a_place_that_is_none_leaves_a_target_where_it_is(
    position: Vec3, orientation: Quat | None, reason: str, caplog: pytest.LogCaptureFixture
) -> None:
    async with open_pilot() as pilot:
        pilot.move("cup", (1.0, 1.0, 1.0), (0.0, 1.0, 0.0, 0.0))
        pilot.move("cup", position, orientation)
        pilot.move("box", (0.0, 0.0, 1.0), (0.6, 0.0, 0.8, 0.0))
        await pilot.advance(0.1)
        world = pilot.realizer.world
        assert (world.position("cup"), world.orientation("cup")) == ((1.0, 1.0, 1.0), (0.0, 1.0, 0.0, 0.0))
        assert (world.position("box"), world.orientation("box")) == ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8, 0.0))
    assert f"TargetMoved(target='cup', position={position}, orientation={orientation}) is skipped: {reason}" in (
        caplog.text
    )
