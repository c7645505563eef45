"""Planning has a budget for each tick: the rest waits, and no character or client waits for another one."""

from collections import Counter
from collections.abc import AsyncIterator, Generator, Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BML, BMLT, OWN
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import Clearance
from reactive_realizer.engines.animation.motions import posture
from reactive_realizer.engines.animation.motions.posture import PostureUnit
from reactive_realizer.engines.animation.posture.detour import Detour, find_detour
from reactive_realizer.realizer.inputs import BmlText, TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.scheduler.block_planner import BlockPlanner, Planned
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.lanes import Lane
from reactive_realizer.scheduler.problem import SchedulingProblem
from reactive_realizer.scheduler.solution import Solution
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

TWO = SceneOptions(Path(__file__).parents[1] / "data" / "humans" / "two.toml", "text")
NOD = '<head id="h" lexeme="NOD"/>'
BEATS = '<gesture id="g" lexeme="BEAT" stroke="1"/><gesture id="h" lexeme="BEAT" stroke="1.5"/>'


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(TWO) as pilot:
        yield pilot


@pytest.fixture
async def slow(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    """A realizer that plans a behavior a tick."""
    human = tmp_path / "slow.toml"
    human.write_text(TWO.human.read_text() + "[limits]\nplanning_per_tick = 20\n")
    async with open_pilot(SceneOptions(human, "text", verify=True)) as pilot:
        yield pilot


def chain(number: int, first: str = "") -> str:
    """Waits, each of which starts at the end of the previous one."""
    starts = (f'start="w{i - 1}:end"' if i else first for i in range(number))
    return "".join(f'<wait id="w{i}" duration="0.1" {start}/>' for i, start in enumerate(starts))


def loose(number: int) -> str:
    """Waits that begin together."""
    return "".join(f'<wait id="w{i}" duration="0.1"/>' for i in range(number))


async def test_a_small_block_starts_in_the_tick_in_which_it_arrives(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD)
    await pilot.tick()
    assert pilot.feedback.time("b:start") == 0.0


async def test_a_big_block_is_planned_over_several_ticks_and_then_played_whole(pilot: RealizerPilot) -> None:
    pilot.block("big", chain(45))
    await pilot.tick()
    assert pilot.feedback.progress == []
    await pilot.advance(6)
    start = pilot.feedback.time("big:start")
    assert 0.0 < start < 0.1
    assert pilot.feedback.time("big:end") == pytest.approx(start + 4.5)
    assert pilot.feedback.warnings == []


async def test_a_block_whose_pegs_are_more_than_the_work_of_a_tick_starts_in_the_tick_after_they_are_on_the_board(
    pilot: RealizerPilot,
) -> None:
    pilot.block("big", chain(300))
    await pilot.advance(0.5)
    *_, planned, started = [each for each in pilot.feedback.of("predictionFeedback") if each.id == "big"]
    assert round(started.time - planned.time, 6) == 0.01
    assert pilot.feedback.time("big:start") == started.time


async def test_many_key_poses_are_as_much_work_as_many_behaviors(pilot: RealizerPilot) -> None:
    pose = '<rr:keyPose time="{}"><rr:lookAt target="0 0.6 1"/></rr:keyPose>'
    poses = "".join(pose.format(number / 10) for number in range(1, 501))
    inside = "".join(
        f'<rr:keyPoses xmlns:rr="{OWN}" id="k{number}" group="HEAD">{poses}</rr:keyPoses>' for number in range(8)
    )
    pilot.block("long", inside)
    await pilot.advance(0.03)
    assert not pilot.feedback.reached("long:start")
    await pilot.advance(0.2)
    assert pilot.feedback.reached("long:start")
    assert pilot.feedback.warnings == []


async def test_the_search_for_the_detours_of_postures_is_work_only_once(pilot: RealizerPilot) -> None:
    poses = ["CROSSED", "AKIMBO", "FORWARD", "SPREAD", "OPEN"]
    postures = "".join(
        f'<posture id="p{i}" start="{i}" end="{i + 1}"><pose part="ARMS" lexeme="ARMS_{lexeme}"/></posture>'
        for i, lexeme in enumerate(poses)
    )
    pilot.block("first", postures)
    await pilot.advance(0.5)
    pilot.block("second", postures, composition="REPLACE")
    await pilot.advance(0.5)
    assert pilot.feedback.time("first:start") >= 0.03
    assert pilot.feedback.time("second:start") <= 0.52
    assert pilot.feedback.warnings == []


async def test_the_search_for_a_detour_is_spread_over_ticks(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    looks: list[float] = []
    clear = Clearance.__call__

    def look(self: Clearance, *arguments: Any, **named: Any) -> Body:
        looks.append(pilot.now)
        return clear(self, *arguments, **named)

    monkeypatch.setattr(Clearance, "__call__", look)
    for i, (stance, lexeme) in enumerate(product(("STANDING", "SITTING", "CROUCHING"), ("CROSSED", "AKIMBO"))):
        poses = f'<stance type="{stance}"/><pose part="ARMS" lexeme="ARMS_{lexeme}"/>'
        pilot.block(f"b{i}", f'<postureShift id="p" start="{i}">{poses}</postureShift>')
    await pilot.advance(0.5)
    assert all(pilot.feedback.reached(f"b{i}:start") for i in range(6))
    assert len(looks) > 60
    assert max(Counter(looks).values()) <= 12


@pytest.mark.parametrize(
    ("junk", "reason"),
    [(ArithmeticError("no way"), "no way"), (SystemExit(), "SystemExit"), ("much", "it returned 'much'")],
    ids=repr,
)
async def test_a_behavior_whose_planning_fails_later_is_left_out_with_the_reason(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch, junk: object, reason: str
) -> None:
    def fail(unit: PostureUnit) -> Iterator[object]:
        yield 1
        if isinstance(junk, BaseException):
            raise junk
        yield junk

    monkeypatch.setattr(PostureUnit, "finish_planning", fail)
    pilot.block("b", f'<postureShift id="p"><stance type="SITTING"/></postureShift>{NOD}')
    await pilot.advance(3)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.text.endswith(f"its preparation failed: {reason}")
    assert pilot.feedback.reached("b:h:end")


async def test_no_detour_is_searched_when_postures_start_from_another_base_than_expected(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    searched: list[float] = []

    def find(*arguments: Any) -> Generator[int, None, Detour]:
        searched.append(pilot.now)
        return find_detour(*arguments)

    monkeypatch.setattr(posture, "find_detour", find)
    for lexeme in ("CROSSED", "AKIMBO", "FORWARD"):
        shift = f'<postureShift id="p"><pose part="ARMS" lexeme="ARMS_{lexeme}"/></postureShift>'
        pilot.block(lexeme, shift, **{"bmla:preplan": "true"})
    await pilot.advance(0.5)
    pilot.block("sit", '<postureShift id="p"><stance type="SITTING"/></postureShift>')
    await pilot.advance(4)
    assert len(searched) == 4
    pilot.block("go", **{"bmla:onStart": "CROSSED,AKIMBO,FORWARD"})
    await pilot.advance(4)
    assert [pilot.feedback.status(block) for block in ("sit", "CROSSED", "AKIMBO", "FORWARD")] == ["DONE"] * 4
    assert len(searched) == 4


async def test_computing_the_paths_of_gestures_is_work(pilot: RealizerPilot) -> None:
    for id_, values in ("equal", [0.5] * 7), ("different", [number / 10 for number in range(1, 8)]):
        gestures = (
            f'<gesture id="g{i}" lexeme="BEAT" start="{2 * i}">'
            f'<bmlt:parameter name="amount" value="{value}"/></gesture>'
            for i, value in enumerate(values)
        )
        pilot.block(id_, "".join(gestures), composition="REPLACE")
        await pilot.advance(0.5)
    assert pilot.feedback.time("equal:start") == 0.0
    assert pilot.feedback.time("different:start") >= 0.51
    assert pilot.feedback.warnings == []


async def test_work_beyond_the_budget_of_a_tick_is_taken_from_the_next_ones(
    slow: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    slices: list[int] = []
    last = 0.0
    step = BlockPlanner.step

    def count(planner: BlockPlanner, lane: Lane) -> tuple[int, Planned | None]:
        nonlocal last
        work, planned = step(planner, lane)
        slices.append(work)
        last = slow.now
        return work, planned

    monkeypatch.setattr(BlockPlanner, "step", count)
    for i in range(4):
        slow.block(f"b{i}", loose(5), characterId="alice")
        slow.block(f"c{i}", loose(5), characterId="bob")
    await slow.advance(3)
    assert slow.feedback.status("b3") == slow.feedback.status("c3") == "DONE"
    entries, ticks = 8 * 65, round(last * 100) + 1
    assert 20 * (ticks - 1) <= entries + sum(slices) <= 20 * ticks + max(slices)


async def test_a_step_asks_the_strategy_once_also_where_one_gesture_takes_over_from_another(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []
    solve, step = ConvexStrategy.solve, BlockPlanner.step

    def count(strategy: ConvexStrategy, problem: SchedulingProblem) -> Solution:
        asked[-1] += 1
        return solve(strategy, problem)

    def begin(planner: BlockPlanner, lane: Lane) -> tuple[int, Planned | None]:
        asked.append(0)
        return step(planner, lane)

    monkeypatch.setattr(ConvexStrategy, "solve", count)
    monkeypatch.setattr(BlockPlanner, "step", begin)
    pilot.block("b", BEATS)
    await pilot.advance(0.1)
    assert pilot.feedback.reached("b:start")
    assert (sum(asked), max(asked)) == (2, 1)


@pytest.mark.parametrize("came", [0.0, 0.03], ids=["with it", "while it waits"])
async def test_an_event_counts_for_a_block_after_the_tick_of_its_arrival_also_if_it_waits_to_enter(
    slow: RealizerPilot, came: float
) -> None:
    for i in range(4):
        slow.block(f"b{i}", loose(5))
    slow.block("answer", '<wait id="w" duration="0.1" start="anticipators:partner:done"/>')
    await slow.advance(came)
    slow.predict("partner", "done", slow.now)
    await slow.advance(0.5)
    assert slow.feedback.time("b3:start") > 0.05
    assert slow.feedback.reached("answer:w:start") is (came > 0.0)


async def test_a_small_block_of_another_character_does_not_wait_for_a_big_one(pilot: RealizerPilot) -> None:
    pilot.block("big", chain(200), characterId="alice")
    await pilot.tick()
    pilot.block("small", NOD, characterId="bob")
    await pilot.tick()
    assert pilot.feedback.time("small:start") == 0.01
    assert not pilot.feedback.reached("big:start")


async def test_a_small_block_of_another_character_does_not_wait_for_many_blocks(pilot: RealizerPilot) -> None:
    for i in range(100):
        pilot.block(f"b{i}", NOD, characterId="alice", composition="APPEND")
    pilot.block("small", NOD, characterId="bob")
    await pilot.tick()
    assert pilot.feedback.time("small:start") == 0.0


def send(pilot: RealizerPilot, client: str, name: str, inside: str = NOD, **attributes: str) -> None:
    """Sends a block of a client."""
    pilot.realizer.put(BmlText(block(name, inside, **attributes), client), pilot.now)


async def test_a_small_block_of_another_client_does_not_wait_for_a_big_one(pilot: RealizerPilot) -> None:
    send(pilot, "flooding", "big", chain(200))
    await pilot.tick()
    send(pilot, "quiet", "small")
    await pilot.tick()
    assert pilot.feedback.time("small:start") == 0.01
    assert not pilot.feedback.reached("big:start")


@pytest.mark.parametrize("others", ["alice", "alice bob"])
async def test_a_small_block_of_another_client_does_not_wait_for_many_blocks(pilot: RealizerPilot, others: str) -> None:
    for i in range(200):
        for character in others.split():
            send(pilot, "flooding", f"{character}{i}", characterId=character, composition="APPEND")
    send(pilot, "quiet", "small", characterId="alice")
    await pilot.advance(0.02)
    assert pilot.feedback.time("small:start") <= 0.01
    assert pilot.realizer.scheduler.unplanned > 100


async def test_a_block_that_names_one_of_another_client_waits_for_it_only(pilot: RealizerPilot) -> None:
    for i in range(100):
        send(pilot, "flooding", f"b{i}", '<wait id="w" duration="0.1"/>')
    send(pilot, "quiet", "small", '<wait id="w" start="b1:w:end" duration="0.1"/>')
    await pilot.tick()
    assert pilot.feedback.reached("small:start")
    assert pilot.realizer.scheduler.unplanned > 50
    await pilot.advance(0.5)
    assert pilot.feedback.time("small:w:start") == pilot.feedback.time("b1:w:end")
    assert pilot.feedback.warnings == []


async def test_a_replace_of_another_client_ends_everything_that_arrived_before_it(pilot: RealizerPilot) -> None:
    for i in range(300):
        send(pilot, "flooding", f"b{i}", loose(10))
    send(pilot, "quiet", "last", composition="REPLACE")
    await pilot.advance(0.5)
    assert pilot.feedback.time("last:start") < 0.35
    await pilot.advance(3)
    assert pilot.feedback.status("b299") in ("REVOKED", "INTERRUPTED")
    assert pilot.feedback.status("last") == "DONE"


async def test_a_block_with_the_id_of_one_of_another_client_that_arrived_before_is_the_one_refused(
    pilot: RealizerPilot,
) -> None:
    for i in range(50):
        send(pilot, "flooding", f"b{i}", '<wait id="w" duration="9"/>')
    send(pilot, "quiet", "b49", '<wait id="w" duration="1"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b49", "PARSING_FAILURE")]
    assert not pilot.feedback.reached("b49:end")


async def test_a_client_gets_as_many_blocks_as_are_left_for_others(tmp_path: Path) -> None:
    human = tmp_path / "few.toml"
    human.write_text(TWO.human.read_text() + "[limits]\nblocks_alive = 8\n")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        for client in ("first", "second", "third", ""):
            for i in range(9):
                send(pilot, client, f"{client}{i}", '<wait id="w" duration="9"/>')
            await pilot.advance(0.5)
        alive = [each.client for each in pilot.realizer.scheduler.blocks.alive]
    assert [alive.count(client) for client in ("first", "second", "third", "")] == [5, 2, 1, 0]
    assert "so the 3 that are left are for others" in "".join(pilot.feedback.raw)


async def test_a_client_gets_as_many_behaviors_as_are_left_for_others(tmp_path: Path) -> None:
    """Also those of procedures."""
    human = tmp_path / "few.toml"
    human.write_text(TWO.human.read_text() + "[limits]\nbehaviors_alive = 40\n")
    names = f'xmlns="{BML}" xmlns:bmlt="{BMLT}"'
    waits = "".join(f'<wait id="w{i}" duration="9"/>' for i in range(5))
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.perform(f'<bmlt:defineproc {names} id="waits">{waits}</bmlt:defineproc>')
        for client in ("first", "second", ""):
            for i in range(9):
                use = f'<bmlt:useproc {names} procid="waits" bmlid="{client}{i}" characterId="alice"/>'
                pilot.realizer.put(BmlText(use, client) if i % 2 else BmlText(block(f"{client}{i}", waits), client))
            await pilot.advance(0.5)
        alive = [each.client for each in pilot.realizer.scheduler.blocks.alive]
    assert [alive.count(client) for client in ("first", "second", "")] == [4, 2, 2]
    assert "this client has 20 live behaviors, so the 20 that are left are for others" in "".join(pilot.feedback.raw)
    assert "more than the limit of 40 behaviors of live blocks" in "".join(pilot.feedback.raw)


async def test_blocks_of_a_character_play_in_order_although_they_are_planned_in_several_ticks(
    pilot: RealizerPilot,
) -> None:
    for i in range(60):
        pilot.block(f"b{i}", '<wait id="w" duration="0.05"/>', composition="APPEND")
    await pilot.advance(3.5)
    starts = [pilot.feedback.time(f"b{i}:start") for i in range(60)]
    assert starts == pytest.approx([0.05 * i for i in range(60)])


async def test_a_block_waits_for_a_later_one_of_its_document_that_it_names(pilot: RealizerPilot) -> None:
    first = block("first", '<wait id="w" start="last:w:end" duration="0.1"/>')
    between = "".join(block(f"b{i}", NOD, composition="APPEND") for i in range(60))
    pilot.perform(first + between + block("last", '<wait id="w" duration="0.5"/>'))
    await pilot.advance(2)
    assert pilot.feedback.time("first:w:start") == pytest.approx(pilot.feedback.time("last:w:end"))
    assert pilot.feedback.warnings == []


async def test_a_block_that_names_another_enters_after_all_that_arrived_before(pilot: RealizerPilot) -> None:
    for i in range(60):
        pilot.block(f"b{i}", '<wait id="w" duration="0.1"/>', characterId="alice")
    pilot.block("after", NOD, **{"characterId": "bob", "bmla:appendAfter": "b59"})
    await pilot.advance(1)
    assert pilot.feedback.time("after:start") == pytest.approx(pilot.feedback.time("b59:end"))
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("number", [6, 52])
@pytest.mark.parametrize("share", [0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0])
async def test_a_block_that_is_replaced_while_it_is_planned_leaves_nothing(
    slow: RealizerPilot, number: int, share: float
) -> None:
    slow.predict("partner", "hit", 9.0)
    await slow.tick()
    (hit,) = slow.realizer.board.predictions("partner").values()
    slow.block("big", chain(number, first='start="anticipators:partner:hit"'), **{"bmla:preplan": "true"})
    await slow.advance(share * number / 100)
    slow.block("next", NOD, composition="REPLACE")
    await slow.advance(2)
    assert slow.feedback.status("next") == "DONE"
    assert not hit.dependents
    assert slow.feedback.warnings == []


@pytest.mark.parametrize("ticks", range(1, 12))
async def test_a_behavior_that_is_interrupted_while_its_block_is_planned_is_not_played(
    slow: RealizerPilot, ticks: int
) -> None:
    slow.block("first", '<wait id="w" duration="0.3"/>')
    slow.block(
        "go", '<bmla:interrupt id="i" target="big" include="w0"/>', characterId="bob", **{"bmla:preplan": "true"}
    )
    await slow.advance(0.2)
    slow.block("big", loose(5), composition="APPEND")
    await slow.advance(ticks / 100)
    slow.block("cut", characterId="bob", **{"bmla:onStart": "go"})
    await slow.advance(1)
    begun = [i for i in range(5) if slow.feedback.reached(f"big:w{i}:start")]
    assert begun == [1, 2, 3, 4]
    assert slow.feedback.warnings == []


@pytest.mark.parametrize("ticks", range(3, 19, 2))
async def test_an_event_before_the_activation_of_a_block_does_not_count_while_the_block_is_planned_either(
    slow: RealizerPilot, ticks: int
) -> None:
    slow.predict("partner", "hit", 0.01)
    slow.block(
        "big", '<wait id="w" duration="0.1" start="anticipators:partner:hit"/>' + loose(5), **{"bmla:preplan": "true"}
    )
    await slow.advance(ticks / 100)
    slow.block("go", characterId="bob", **{"bmla:onStart": "big"})
    await slow.advance(0.5)
    slow.predict("partner", "hit", 1.0)
    await slow.advance(1)
    assert slow.feedback.time("big:w:start") == 1.0


async def test_a_prediction_that_moves_while_a_block_is_planned_is_followed(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "hit", 1.0)
    pilot.block("big", chain(45, first='start="anticipators:partner:hit"'))
    for tick in range(10):
        pilot.predict("partner", "hit", 1.0 + tick / 100)
        await pilot.tick()
    await pilot.advance(2)
    assert pilot.feedback.time("big:w0:start") == pytest.approx(1.09)


async def test_a_block_with_too_many_sync_points_fails_with_the_limit(pilot: RealizerPilot) -> None:
    nods = "".join(f'<head id="h{i}" lexeme="NOD" repetition="100"/>' for i in range(120))
    pilot.block("many", nods)
    await pilot.advance(0.5)
    assert pilot.feedback.warnings == [("many", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "more than 10000 sync points" in pilot.feedback.raw[-2]
    assert pilot.feedback.status("many") == "FAILED"


async def test_a_session_in_which_planning_is_spread_over_ticks_is_replayed_byte_by_byte() -> None:
    session: list[TickInputs] = []
    async with open_pilot(TWO) as pilot:
        pilot.realizer.record(session.append)
        pilot.block("big", chain(120), characterId="alice")
        for i in range(30):
            pilot.block(f"b{i}", NOD, characterId="bob", composition="APPEND")
            await pilot.tick()
        pilot.block("stop", NOD, composition="REPLACE")
        await pilot.advance(2)
        recorded = pilot.feedback.raw
    async with open_pilot(TWO) as pilot:
        await replay(pilot.realizer, session)
        assert pilot.feedback.raw == recorded


@pytest.mark.parametrize("ticks", range(8, 18))
async def test_a_block_may_be_interrupted_while_one_that_names_its_points_is_planned(
    slow: RealizerPilot, ticks: int
) -> None:
    slow.block("named", '<wait id="w" duration="1"/>', characterId="bob")
    await slow.advance(0.05)
    slow.block("big", chain(22, first='start="named:w:end+0.5"'))
    await slow.advance(ticks / 100)
    slow.block("stop", characterId="bob", composition="REPLACE")
    await slow.advance(4)
    dropped = [text for text in slow.feedback.raw if "big:w0" in text and "has ended" in text]
    assert slow.feedback.reached("big:w0:start") is not bool(dropped)
    assert slow.feedback.status("big") == "DONE"


async def test_a_behavior_stays_with_the_point_that_it_awaits_while_its_block_is_late(slow: RealizerPilot) -> None:
    slow.predict("partner", "hit", 0.92)
    slow.block(
        "b",
        '<head id="p" lexeme="NOD"/><gesture id="q" lexeme="BEAT" mode="RIGHT_HAND"/>'
        '<constraint><after ref="anticipators:partner:hit"><sync ref="p:start"/></after></constraint>'
        '<constraint><after ref="q:stroke"><sync ref="p:stroke"/></after></constraint>',
    )
    await slow.advance(1.1)
    assert slow.feedback.time("b:start") > 0.0
    assert slow.feedback.time("b:p:start") == pytest.approx(0.92)
