"""The work of a tick grows with what begins, not with the square of it; work is counted in calls."""

import cProfile
import pstats

from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


async def test_behaviors_that_begin_together_cost_in_proportion_to_their_number() -> None:
    few, many = [await _calls_to_begin(number) for number in (20, 80)]
    assert many < 5 * few


async def _calls_to_begin(number: int) -> int:
    """Calls in the ticks in which behaviors that were planned before are activated and begin."""
    async with open_pilot() as pilot:
        waits = "".join(f'<wait id="w{i}" duration="1"/>' for i in range(number))
        pilot.block("b", waits, **{"bmla:preplan": "true"})
        await pilot.advance(0.1)
        pilot.block("go", **{"bmla:onStart": "b"})
        return await _calls(pilot, ticks=3)


async def _calls(pilot: RealizerPilot, ticks: int) -> int:
    profile = cProfile.Profile()
    profile.enable()
    for _ in range(ticks):
        await pilot.tick()
    profile.disable()
    return int(pstats.Stats(profile).total_calls)  # type: ignore[attr-defined]
