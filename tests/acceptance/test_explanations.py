"""Explanations of the times of sync points (docs/time.md)."""

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
    points: Any = dict(pilot.realizer.scheduler.explain("alice", "b")[1])
    return points[point]


def names(explanation: Any) -> list[Any]:
    return [explanation["name"], *(name for source in explanation["sources"] for name in names(source))]


async def test_an_explanation_has_the_constraint_of_a_point_and_its_source(pilot: RealizerPilot) -> None:
    pilot.block("b", BLOCK)
    await pilot.tick()
    stroke = explained(pilot, "b:n:stroke")
    assert "n:stroke = s:m" in stroke["tie"]
    assert stroke["commit"]["cause"] == "plan b"
    assert "b:start" in names(stroke)
    json.dumps(stroke)


async def test_an_explanation_has_the_last_commit_that_moved_the_point(pilot: RealizerPilot) -> None:
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


async def test_a_point_that_has_fired_keeps_its_explanation(pilot: RealizerPilot) -> None:
    pilot.predict("user", "hit", 1.5)
    pilot.block("b", BLOCK)
    await pilot.advance(2.0)
    stroke = explained(pilot, "b:g:stroke")
    assert stroke["state"] == "pinned"
    assert "anticipators:user:hit" in names(stroke)


@pytest.mark.parametrize(("block", "code"), [("old", "block-ended"), ("none", "no-such-block")])
async def test_a_block_that_is_not_alive_has_no_explanation(pilot: RealizerPilot, block: str, code: str) -> None:
    pilot.block("old")
    await pilot.advance(0.1)
    with pytest.raises(RealizerError) as refused:
        pilot.realizer.scheduler.explain("alice", block)
    assert refused.value.fault.code == code
