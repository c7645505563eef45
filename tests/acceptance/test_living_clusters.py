"""Clusters of tied behaviors stay together and in order while their outer times move."""

from collections.abc import AsyncIterator
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_order, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import BEAT, GO, HIT, after, moves, nod, synchronize, syncs, texts, wait

GAZE = f'<gaze id="p" target="bluebox" relax="{HIT}"/>'
WELL = '<speech id="p" start="q:end+0.3"><text>Well <sync id="m"/>then, my friend.</text></speech>'


@pytest.fixture(params=["convex", "embr"])
async def pilot(request: pytest.FixtureRequest) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        yield pilot


async def test_a_behavior_before_a_point_follows_it_after_the_source_of_the_point_has_passed(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 0.3)
    pilot.block("b", GAZE + nod("q", stroke="p:end+1"))
    await moves(pilot, 1.1, ("hit", 1.8), 4)
    assert_linked(pilot.feedback, "b:q:stroke", "b:p:end", 1.0)
    assert_linked(pilot.feedback, "b:q:stroke", "b:q:start", 0.35)
    assert texts(pilot) == []


@pytest.mark.parametrize("planned", [1.0, 2.5])
@pytest.mark.parametrize("moved", [0.7, 3.0])
@pytest.mark.parametrize("start", ["1.5", GO])
async def test_a_point_stays_after_two_earlier_behaviors_when_either_moves(
    pilot: RealizerPilot, planned: float, moved: float, start: str
) -> None:
    pilot.predict("t", "hit", planned)
    pilot.predict("t", "go", 1.5)
    pilot.block("b", BEAT.format(f' strokeEnd="{HIT}" end="n:stroke+0.2"') + nod("n", start=start))
    await moves(pilot, 0.1, ("hit", moved), 4)
    assert_time(pilot.feedback, "b:g:strokeEnd", moved)
    assert_time(pilot.feedback, "b:n:start", 1.5)
    assert_linked(pilot.feedback, "b:g:end", "b:n:stroke", 0.2)
    assert_order(pilot.feedback, "b:n:start", "b:n:stroke")
    assert_order(pilot.feedback, "b:g:strokeEnd", "b:g:end")
    assert not any("no longer holds" in text for text in texts(pilot))


async def test_a_point_stays_before_two_later_behaviors_when_either_moves(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.predict("t", "go", 2.5)
    pilot.block("b", nod("n", start="m:start", end=HIT) + nod("m", end=GO))
    await moves(pilot, 0.1, ("go", 1.2), 4)
    assert_time(pilot.feedback, "b:n:end", 2.0)
    assert_time(pilot.feedback, "b:m:end", 1.2)
    assert_linked(pilot.feedback, "b:n:start", "b:m:start")
    assert_order(pilot.feedback, "b:m:start", "b:m:end")
    assert texts(pilot) == []


async def test_a_cluster_that_should_have_started_earlier_starts_now_as_a_whole(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", WELL + wait("q", 0.5) + nod("r", start="q:start+1", end=HIT))
    await moves(pilot, 2, ("hit", 2.2), 5)
    assert_time(pilot.feedback, "b:q:start", 2.0)
    assert_linked(pilot.feedback, "b:p:start", "b:q:end", 0.3)
    assert_linked(pilot.feedback, "b:p:end", "b:p:start", 1.34)
    assert "no time is left" in texts(pilot)[-1] or "lost their order" in texts(pilot)[-1]


async def test_a_behavior_tied_to_a_playing_one_stays_with_it_with_every_strategy() -> None:
    for strategy in ("convex", "embr", "smartbody"):
        async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
            pilot.predict("t", "hit", 0.3)
            pilot.block("b", wait("p", 0.3, start=HIT) + nod("q", start="p:start+1"))
            await moves(pilot, 0.6, ("hit", 2.0), 3)
            assert_linked(pilot.feedback, "b:q:start", "b:p:start", 1.0)
            assert texts(pilot) == []


@pytest.mark.parametrize(
    ("behaviors", "lost"),
    [
        (wait("q", 0.5, start="n:start", end="n:start") + nod("n") + synchronize("q:end", "3"), ["n:start", "3"]),
        (
            WELL.replace("q:end+0.3", "0") + synchronize("p:start", "p:end") + synchronize("p:m", "p:end"),
            ["p:start", "p:m"],
        ),
    ],
)
async def test_each_tie_that_a_rigid_behavior_cannot_meet_is_reported_once(behaviors: Any, lost: list[str]) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy="smartbody")) as pilot:
        pilot.block("b", behaviors)
        await pilot.advance(1)
        ties = sorted(text.partition(": ")[2].partition(" is dropped")[0] for text in texts(pilot))
        assert len(ties) == len(lost)
        assert all(any(name in tie for tie in ties) for name in lost)


async def test_a_cycle_of_ties_and_orders_is_planned(pilot: RealizerPilot) -> None:
    beats = {"p": {"relax": f"{HIT}+1"}, "q": {"stroke": "p:stroke+1", "ready": "r:stroke-0.3"}, "r": {}}
    parts = [f'<gesture id="{id_}" lexeme="BEAT"{syncs(points)}/>' for id_, points in beats.items()]
    pilot.block("b", "".join(parts) + after("q:ready+1", "r:relax"))
    await moves(pilot, 0.1, ("hit", 2.0), 0.1)
    assert pilot.feedback.predicted("b:q:stroke") == pytest.approx(pilot.feedback.predicted("b:p:stroke") + 1)
    assert pilot.feedback.predicted("b:r:relax") >= pilot.feedback.predicted("b:q:ready") + 1 - 1e-6
    assert texts(pilot) == []
