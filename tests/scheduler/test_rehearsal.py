"""Rehearsal: what is known of the behaviors of a block before it is planned."""

import asyncio
from collections.abc import Awaitable, Callable

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, DefineProc
from reactive_realizer.bml.document import parse
from reactive_realizer.engines.animation.animation_engine import AnimationEngine
from reactive_realizer.engines.wait_engine import WaitEngine
from reactive_realizer.limits import Limits
from reactive_realizer.scheduler.engine_routing import EngineRouting
from reactive_realizer.scheduler.rehearsal import Rehearsal, rehearse, rehearse_slowly
from reactive_realizer.server.turns import Turns
from reactive_realizer.testing.pilot import block, open_pilot

Rehearse = Callable[[BehaviorBlock | DefineProc, EngineRouting], Awaitable[Rehearsal]]


async def rehearse_quickly(block: BehaviorBlock | DefineProc, routing: EngineRouting) -> Rehearsal:
    return await rehearse(block, routing, Turns())


BOTH = pytest.mark.parametrize("how", [rehearse_quickly, rehearse_slowly])


async def rehearsed(how: Rehearse, inside: str, **attributes: str) -> Rehearsal:
    (parsed,) = parse(block("b", inside, **attributes), Limits())
    assert parsed.block is not None
    async with open_pilot() as pilot:
        characters = pilot.realizer.characters
        return await how(parsed.block, EngineRouting({id_: each.engines for id_, each in characters.items()}))


def codes(rehearsal: Rehearsal) -> list[tuple[str, str, int | None]]:
    return [(problem.id, problem.fault.code, problem.fault.line) for problem in rehearsal.problems]


@BOTH
async def test_a_motion_has_the_points_of_its_file(how: Rehearse) -> None:
    conduct = '<x:procanimation xmlns:x="http://hmi.ewi.utwente.nl/bmlt" id="p" name="conduct-3-beat"/>'
    found = await rehearsed(how, f'<head id="h" lexeme="NOD"/>{conduct}')
    assert codes(found) == []
    assert found.points["p"] == ("start", "beat1", "beat2", "beat3", "end")
    assert "strokeStart" in found.points["h"]
    assert found.engines.keys() == {"h", "p"}


@BOTH
async def test_behaviors_that_cannot_be_played_are_problems_with_their_places(how: Rehearse) -> None:
    inside = """<gesture id="g" lexeme="DANCE"/>
      <gaze id="z" target="nobody"/>
      <locomotion id="l" target="viewer" manner="FLY"/>"""
    found = await rehearsed(how, inside)
    assert sorted(codes(found)) == [("b:g", "no-motion-for", 1), ("b:l", "no-manner", 3), ("b:z", "no-target", 2)]
    assert not found.points


@BOTH
async def test_a_description_that_is_replaced_by_the_behavior_is_a_problem(how: Rehearse) -> None:
    inside = """<gesture id="g" lexeme="BEAT"><description priority="1" type="application/bmlt">
      <x:procanimation xmlns:x="http://hmi.ewi.utwente.nl/bmlt" id="p" name="nowhere"/></description></gesture>"""
    found = await rehearsed(how, inside)
    assert codes(found) == [("b:g", "description-left-out", 1)]
    assert "stroke" in found.points["g"]


@BOTH
async def test_nothing_is_known_of_the_behaviors_of_an_unknown_character(how: Rehearse) -> None:
    found = await rehearsed(how, '<gesture id="g" lexeme="DANCE"/>', characterId="zoe")
    assert (codes(found), found.engines) == ([], {})


async def test_only_slow_work_tells_whether_a_text_can_be_spoken() -> None:
    inside = '<speech id="s"><text>...</text></speech>'
    assert codes(await rehearsed(rehearse_quickly, inside)) == []
    assert codes(await rehearsed(rehearse_slowly, inside)) == [("b:s", "nothing-to-say", 1)]


@pytest.mark.parametrize(
    ("how", "method"), [(rehearse_quickly, "check"), (rehearse_slowly, "plan"), (rehearse_slowly, "prepare")]
)
async def test_an_engine_that_fails_costs_the_behavior_alone(
    how: Rehearse, method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaitEngine, method, lambda *_: 1 / 0)
    found = await rehearsed(how, '<wait id="w" duration="1"/><head id="h" lexeme="NOD"/>')
    assert codes(found) == [("b:w", "work-failed", 1)]
    assert "h" in found.points


async def test_other_tasks_run_while_a_big_block_is_rehearsed() -> None:
    inside = "".join(f'<head id="h{number}" lexeme="NOD"/>' for number in range(100))
    turns: list[str] = []

    async def note(turn: str, times: int) -> None:
        for _ in range(times):
            turns.append(turn)
            await asyncio.sleep(0)

    async def rehearse_it(block: BehaviorBlock | DefineProc, routing: EngineRouting) -> Rehearsal:
        async with asyncio.TaskGroup() as group:
            group.create_task(note("other", 3))
            found = await rehearse_quickly(block, routing)
            turns.append("rehearsed")
        return found

    found = await rehearsed(rehearse_it, inside)
    assert len(found.points) == 100
    assert turns == ["other", "other", "other", "rehearsed"]


async def test_a_behavior_that_takes_long_to_check_has_a_turn_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[int] = []

    class Counted:
        async def __aenter__(self) -> None:
            taken.append(0)

        async def __aexit__(self, *failure: object) -> None:
            pass

    def check(engine: AnimationEngine, behavior: Behavior) -> tuple[str, ...]:
        taken[-1] += 1
        loop = asyncio.get_running_loop()
        end = loop.time() + 0.004
        while loop.time() < end:
            pass
        return ("start", "end")

    monkeypatch.setattr(AnimationEngine, "check", check)
    nods = "".join(f'<head id="h{i}" lexeme="NOD"/>' for i in range(4))
    await rehearsed(lambda block, routing: rehearse(block, routing, Counted()), nods)
    assert taken == [1, 1, 1, 1]
