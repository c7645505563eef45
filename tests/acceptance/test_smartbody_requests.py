"""Requests as SmartBody gets them: the example of its paper, and what its elements do in frames."""

import numpy as np

from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

SPEECH_23 = """vrAgentBML request Alice Bob SPEECH_23
<act><bml><speech id="s"><text>You told me that we should meet here at noon, and that you would bring the map.</text>
</speech></bml></act>"""

SPEECH_24 = """vrAgentBML request Alice Bob SPEECH_24
<?xml version="1.0" encoding="UTF-8"?>
<act> <bml>
  <speech id="b1">
    <text>
      Wait! That's <tm id="not"> not what I mean.
    </text>
  </speech>
  <sbm:interrupt id="b2" act="SPEECH_23"
    start="b1:start" />
  <gaze id="b3" target="Bob" start="b2:start" />
  <head id="b4" type="SHAKE" stroke="b1:not" />
</bml> </act>
"""
"""Table 1 of Thiebaux and others (2008)."""

BOB = (-0.8, 1.6, 1.0)


async def test_alice_interrupts_what_she_says_looks_at_bob_and_shakes_her_head_on_not(pilot: RealizerPilot) -> None:
    pilot.move("Bob", BOB)
    pilot.perform(SPEECH_23)
    await pilot.advance(2)
    pilot.perform(SPEECH_24)
    await pilot.advance(5)
    told = pilot.feedback
    assert told.warnings == []
    assert (told.status("SPEECH_23"), told.time("SPEECH_23:end")) == ("INTERRUPTED", 2.0)
    begun = [told.time(f"SPEECH_24:{point}") for point in ("b1:start", "b2:start", "b3:start")]
    assert begun == [2.0] * 3
    assert told.time("SPEECH_24:b4:stroke") == told.time("SPEECH_24:b1:not") > 2.5
    assert told.time("SPEECH_24:b1:end") > told.time("SPEECH_24:b4:stroke")


INTERRUPT = '<sbm:interrupt id="b2" act="SPEECH_23"\n    start="b1:start" />'


async def test_she_keeps_looking_at_bob_and_shakes_her_head_from_there(open_still: OpenStill) -> None:
    async with open_still() as pilot:
        pilot.move("Bob", BOB)
        pilot.perform(SPEECH_24.replace(INTERRUPT, "").replace(' start="b2:start"', ""))
        await pilot.advance(6)
        shake = [pilot.feedback.time(f"SPEECH_24:b4:{point}") for point in ("start", "end")]
        times = [frame.time for frame in pilot.frames["alice"]]
        turned = [body.transform("skullbase").rotation for body in pilot.bodies()]
    assert pilot.feedback.warnings == []
    yaw = dict(zip(times, np.degrees([2.0 * np.arctan2(y, w) for w, _, y, _ in turned]), strict=True))
    shaking = [angle for time, angle in yaw.items() if shake[0] < time < shake[1]]
    after = [angle for time, angle in yaw.items() if time > 4.0]
    assert max(after) < -20.0
    assert max(after) - min(after) < 1.0
    assert max(shaking) - min(shaking) > 8.0
