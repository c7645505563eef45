"""Names and values of parameters may be written in any case."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        pilot.watch()
        yield pilot


async def raised(pilot: RealizerPilot, name: str, value: str = "0.5") -> list[float]:
    """How high the right wrist is in a gesture that has a parameter, m."""
    parameter = f'<bmlt:parameter name="{name}" value="{value}"/>'
    pilot.block("b", f'<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND">{parameter}</gesture>')
    await pilot.advance(1.5)
    return [float(height) for height in pilot.path("r_wrist")[:, 1]]


async def test_the_amount_of_a_gesture_may_be_in_any_case() -> None:
    heights = []
    for name, value in (("amount", "0.5"), ("AMOUNT", "0.5"), ("amount", "1")):
        async with open_pilot() as pilot:
            pilot.watch()
            heights.append(await raised(pilot, name, value))
            assert not pilot.feedback.warnings
    smaller, same, full = heights
    assert smaller == same
    assert max(full) > max(smaller) + 0.05


@pytest.mark.parametrize(("hand", "wrist"), [("left_hand", "l_wrist"), ("Right-Hand", "r_wrist")])
async def test_the_hand_that_points_may_be_in_any_case(pilot: RealizerPilot, hand: str, wrist: str) -> None:
    pilot.move("t", (0.0, 1.4, 2.0))
    parameter = f'<bmlt:parameter name="Hand" value="{hand}"/>'
    pilot.block("b", f'<pointing id="p" target="t">{parameter}</pointing>')
    await pilot.advance(1.5)
    assert not pilot.feedback.warnings
    up = {joint: pilot.path(joint)[-1][1] - pilot.path(joint)[0][1] for joint in ("l_wrist", "r_wrist")}
    assert max(up, key=up.__getitem__) == wrist


async def test_a_transition_may_be_in_any_case(pilot: RealizerPilot) -> None:
    pilot.block("b", '<bmlt:transition id="t" class="HERMITETRANSITION" start="0" end="1"/>')
    await pilot.advance(1.5)
    assert not pilot.feedback.warnings


async def test_an_unknown_parameter_is_reported_as_it_was_written(pilot: RealizerPilot) -> None:
    await raised(pilot, "AMOUNTS")
    assert "AMOUNTS" in pilot.feedback.of("warningFeedback")[0].text
