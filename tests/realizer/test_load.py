"""The work of a tick grows with what begins, not with the square of it; work is counted in calls."""

import cProfile
import pstats

from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot


async def test_behaviors_that_begin_together_cost_in_proportion_to_their_number() -> None:
    few, many = [await _calls_to_begin(number) for number in (20, 80)]
    assert many < 5 * few


async def test_a_behavior_that_begins_costs_the_same_however_many_play() -> None:
    few, many = [await _calls_beside(block("b", _waits(number))) for number in (20, 80)]
    assert many < 1.1 * few


async def test_a_block_that_accompanies_another_costs_the_same_however_many_do() -> None:
    few, many = [
        await _calls_beside(block("b", _waits(1)), *(_accompanying(f"a{i}", f"part{i}") for i in range(number)))
        for number in (10, 40)
    ]
    assert many < 1.1 * few


async def _calls_beside(*blocks: str) -> int:
    """Calls in the ticks in which a behavior begins that accompanies others, while the behaviors of blocks play."""
    async with open_pilot() as pilot:
        for each in blocks:
            pilot.perform(each)
        await pilot.advance(0.5)
        pilot.perform(_accompanying("last", "w"))
        return await _calls(pilot, ticks=3)


def _accompanying(id_: str, behavior: str) -> str:
    text = block(id_, f'<wait id="{behavior}" duration="9"/>', composition="APPEND")
    return text.replace("<bml ", f'<bml xmlns:rr="{OWN}" rr:accompanies="b" ')


def _waits(number: int) -> str:
    return "".join(f'<wait id="w{i}" duration="9"/>' for i in range(number))


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
