"""The work of a tick grows with what begins, not with the square of it; work is counted in calls."""

import cProfile
import pstats

import pytest

from reactive_realizer.bml.names import BMLA, OWN
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot


async def test_behaviors_that_begin_together_cost_in_proportion_to_their_number() -> None:
    few, many = [await _calls_to_begin(number) for number in (20, 80)]
    assert many < 5 * few


@pytest.mark.parametrize(
    "behavior",
    [
        '<faceLexeme id="b{0}" lexeme="SMILE"/>',
        '<gaze id="b{0}" target="bluebox"/>',
        '<gesture id="b{0}" lexeme="BEAT"/>',
        '<gesture id="b{0}" lexeme="BEAT" mode="LEFT_HAND"/>',
        '<speech id="b{0}"><text>Well.</text></speech>',
        '<wait id="b{0}" start="first:stroke"/>',
        '<wait id="b{0}" start="last:stroke + 0.1" end="b{1}:end"/>',
        f'<activate xmlns="{BMLA}" id="b{{0}}" target="nothing" start="0.1"/>',
    ],
)
async def test_behaviors_of_which_all_but_one_are_dropped_cost_in_proportion_to_their_number(behavior: str) -> None:
    """They exclude each other, depend on one that is dropped, or name no block."""
    few, many = [await _calls_to_play(behavior, number) for number in (40, 160)]
    assert many < 5 * few


async def test_waits_for_one_point_are_planned_at_a_cost_in_proportion_to_their_number() -> None:
    wait = '<wait id="b{0}" start="0" end="first:stroke"/>'
    few, many = [await _calls_to_play(wait, number) for number in (40, 160)]
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


async def _calls_to_play(behavior: str, number: int) -> int:
    """Calls in the ticks in which behaviors of a block are planned and begin, two of them for the same hand."""
    async with open_pilot() as pilot:
        first, last = (
            '<gesture id="first" lexeme="BEAT"/>',
            '<gesture id="last" lexeme="BEAT" start="first:start + 0.1"/>',
        )
        others = (behavior.format(each, each - 1 if each else each + 1) for each in range(number))
        pilot.block("b", first + last + "".join(others))
        return await _calls(pilot, ticks=100)
