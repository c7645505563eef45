"""A gaze that a shift covered becomes visible again after the shift."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .seen import at, between, miss, put, sight, speeds

SHIFTS = (
    '<headDirectionShift id="s" target="right"/>',
    '<gazeShift id="s" target="right"/>',
    '<gazeShift id="s" target="right" influence="WAIST"/>',
)


@pytest.mark.parametrize("shift", SHIFTS)
@pytest.mark.parametrize("influence", ["SHOULDER", "WAIST"])
async def test_the_head_returns_smoothly_to_a_continuing_gaze_when_a_shift_ends(
    pilot: RealizerPilot, influence: str, shift: str
) -> None:
    left = put(pilot, "left", 35, -10)
    put(pilot, "right", -35, 5)
    pilot.block("a", f'<gaze id="g" target="left" start="0" end="9" influence="{influence}"/>')
    await pilot.advance(4)
    pilot.block("b", shift)
    await pilot.advance(3)
    end, shown = at(pilot, pilot.feedback.time("b:s:end")), pilot.bodies()
    before, turned, after = (sight(shown[number], "skullbase") for number in (at(pilot, 3.9), end, -1))
    assert between(before, turned) > 50
    assert between(before, after) < 1.5  # an idle head moves by about a degree
    assert max(speeds(shown, "skullbase")[end - 2 : end + 4]) < 1
    assert max(speeds(shown, "skullbase")) < 6
    assert miss(shown[-1], left) < 0.5
