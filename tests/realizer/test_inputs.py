"""Inputs: a document that was parsed before it is put is not parsed again."""

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.bml.document import parse
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.ticker import Tick
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
