"""Why a sync point is when it is (docs/time.md)."""

import json
from typing import Any

import pytest

from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot

BLOCK = (
    '<speech id="s"><text>hello <sync id="m"/>there</text></speech>'
    '<head id="n" lexeme="NOD" stroke="s:m+0.1"/><gesture id="g" lexeme="BEAT" stroke="anticipators:user:hit"/>'
)


def explained(pilot: RealizerPilot, point: str) -> Any:
    points: Any = pilot.realizer.scheduler.explain("alice", "b")["points"]
    return points[point]


def names(explanation: Any) -> list[Any]:
    return [explanation["name"], *(name for source in explanation["sources"] for name in names(source))]


async def test_a_point_names_its_constraint_and_what_it_hangs_on(pilot: RealizerPilot) -> None:
    pilot.block("b", BLOCK)
    await pilot.tick()
    stroke = explained(pilot, "b:n:stroke")
    assert "n:stroke = s:m" in stroke["tie"]
    assert stroke["commit"]["cause"] == "plan b"
    assert "b:start" in names(stroke)
    json.dumps(stroke)


async def test_a_point_on_a_prediction_names_the_commit_that_moved_it_last(pilot: RealizerPilot) -> None:
    pilot.predict("user", "hit", 2.0)
    pilot.block("b", BLOCK)
    await pilot.advance(0.5)
    pilot.predict("user", "hit", 2.4)
    await pilot.tick()
    stroke = explained(pilot, "b:g:stroke")
    assert names(stroke)[-1] == "anticipators:user:hit"
    assert stroke["time"] == 2.4
    assert stroke["commit"]["cause"] == "inputs"
    assert stroke["commit"]["time"] == 0.5


async def test_a_point_that_has_fired_still_tells_where_its_time_came_from(pilot: RealizerPilot) -> None:
    pilot.predict("user", "hit", 1.5)
    pilot.block("b", BLOCK)
    await pilot.advance(2.0)
    stroke = explained(pilot, "b:g:stroke")
    assert stroke["state"] == "pinned"
    assert "anticipators:user:hit" in names(stroke)


@pytest.mark.parametrize(("block", "code"), [("old", "block-ended"), ("none", "no-such-block")])
async def test_of_a_block_that_is_not_alive_nothing_can_be_told(pilot: RealizerPilot, block: str, code: str) -> None:
    pilot.block("old")
    await pilot.advance(0.1)
    with pytest.raises(RealizerError) as refused:
        pilot.realizer.scheduler.explain("alice", block)
    assert refused.value.fault.code == code
