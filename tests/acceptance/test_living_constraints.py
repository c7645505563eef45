"""Constraints live: what held goes on holding while times move, or it is said, once (docs/time.md)."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_not_played, assert_order, assert_time
from reactive_realizer.testing.pilot import open_pilot

HIT, GO = "anticipators:t:hit", "anticipators:t:go"
LOST = "cannot be kept any more"
WELL = '<speech id="s"{}><text>Well <sync id="m"/>then, my friend.</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT"{}/>'


def syncs(points):
    return "".join(f' {sync}="{ref}"' for sync, ref in points.items())


def wait(id_, duration, **points):
    return f'<wait id="{id_}" duration="{duration}"{syncs(points)}/>'


def nod(id_, **points):
    return f'<head id="{id_}" lexeme="NOD"{syncs(points)}/>'


def after(ref, *points):
    return order("after", ref, points)


def before(ref, *points):
    return order("before", ref, points)


def order(kind, ref, points):
    inside = "".join(f'<sync ref="{point}"/>' for point in points)
    return f'<constraint><{kind} ref="{ref}">{inside}</{kind}></constraint>'


def synchronize(*refs):
    return "<constraint><synchronize>" + "".join(f'<sync ref="{ref}"/>' for ref in refs) + "</synchronize></constraint>"


def texts(pilot):
    return [line.element.text for line in pilot.feedback.of("warningFeedback")]


async def moves(pilot, *script):
    """Numbers are seconds to play; pairs are predictions."""
    for step in script:
        if isinstance(step, tuple):
            pilot.predict("t", *step)
        else:
            await pilot.advance(step)


# --- after and before, with one side on an anticipator


@pytest.mark.parametrize("moved", [0.6, 1.0, 2.5])
async def test_after_pushes_and_lets_come_back_whatever_the_partner_does_before_either_has_come(pilot, moved) -> None:
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", wait("w", 1) + after(HIT, "w:start"))
    await moves(pilot, 0.4, ("hit", 3.0), 0.1, ("hit", moved), 5)
    assert_time(pilot.feedback, "b:w:start", moved)
    assert pilot.feedback.warnings == []


async def test_what_may_be_earlier_than_now_is_now(pilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", wait("w", 1) + after(f"{HIT}-1", "w:start"))
    await moves(pilot, 1, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:w:start", 1.0)
    assert pilot.feedback.warnings == []


async def test_an_after_that_moves_past_a_point_that_has_come_is_lost_and_that_is_said_once(pilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w", 1) + after(f"{HIT}-0.5", "w:start"))
    await moves(pilot, 0.7, ("hit", 2.0), 0.1, ("hit", 2.5), 3)
    assert_time(pilot.feedback, "b:w:start", 0.5)
    (said,) = texts(pilot)
    assert f"w:start after {HIT}-0.5 {LOST}: 1 s are missing" in said


async def test_an_after_pushes_a_point_of_a_gesture_that_is_on_its_way(pilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", BEAT.format("") + after(HIT, "g:stroke"))
    await moves(pilot, 0.5, ("hit", 3.0), 4)
    assert_time(pilot.feedback, "b:g:stroke", 3.0)
    assert pilot.feedback.time("b:g:start") < 0.5
    assert pilot.feedback.warnings == []


async def test_a_before_pulls_what_is_on_its_way_and_lets_it_go_again(pilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n") + before(HIT, "n:end"))
    await moves(pilot, 0.2, ("hit", 0.5), 0.1)
    assert pilot.feedback.predicted("b:n:end") == pytest.approx(0.5)
    await moves(pilot, ("hit", 0.6), 2)
    assert_time(pilot.feedback, "b:n:end", 0.6)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("first", [wait("w", 2), wait("w", 2, start=GO), nod("w", start="0", end="2")])
async def test_a_before_on_what_cannot_go_is_lost_and_nothing_else_is(pilot, first) -> None:
    pilot.predict("t", "go", 0.2)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", first + before(HIT, "w:end"))
    await moves(pilot, 0.3, ("hit", 1.0), 0.1, ("hit", 0.9), 3)
    (said,) = texts(pilot)
    assert f"w:end before {HIT} {LOST}" in said
    assert pilot.feedback.time("b:w:end") in (2.0, 2.2)


@pytest.mark.parametrize("start", ["1", "anticipators:t:go"])
@pytest.mark.parametrize("moved", [0.6, -1.0])
async def test_a_before_that_moves_in_front_of_what_must_come_first_is_given_up_and_nothing_else_is(
    pilot, start, moved
) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start=start) + nod("like", start="1") + before(HIT, "n:end"))
    await moves(pilot, 0.5, ("hit", moved), 0.1, ("hit", moved + 0.01), 3)
    for sync in ("start", "stroke", "end"):
        assert_linked(pilot.feedback, f"b:n:{sync}", f"b:like:{sync}")
    (said,) = texts(pilot)
    assert f"n:end before {HIT} {LOST}" in said


async def test_it_binds_again_when_its_bound_comes_back(pilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start="1") + before(HIT, "n:end"))
    await moves(pilot, 0.5, ("hit", 0.6), 0.1, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert_time(pilot.feedback, "b:n:end", 1.2)


async def test_a_before_is_given_up_rather_than_the_tie_of_a_point_in_front(pilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", BEAT.format(f' stroke="{GO}"') + before(HIT, "g:end"))
    await moves(pilot, 0.5, ("hit", 0.9), 3)
    assert_time(pilot.feedback, "b:g:stroke", 1.0)
    assert [f"g:end before {HIT} {LOST}" in said for said in texts(pilot)] == [True]


async def test_after_the_unknown_waits_before_it_nothing_is_bound_and_at_it_a_whole_cluster_waits(pilot) -> None:
    tied = nod("n", stroke=HIT) + nod("m", start="n:end")
    pilot.block("b", wait("w", 1) + after(HIT, "w:start") + wait("v", 1) + before(HIT, "v:end") + tied)
    await pilot.advance(2)
    assert pilot.feedback.progress == ["b:start", "b:v:start", "b:v:end"]
    await moves(pilot, ("hit", 3.0), 0.8, ("hit", None), 1)
    assert len(pilot.feedback.progress) == 6  # n had begun; its stroke, and all the rest, wait again
    await moves(pilot, ("hit", 4.0), 4)
    assert_time(pilot.feedback, "b:n:stroke", 4.0)
    assert_time(pilot.feedback, "b:w:start", 4.0)
    assert_linked(pilot.feedback, "b:m:start", "b:n:end")
    assert [said for said in texts(pilot) if "v:end" not in said] == []


# --- chains, clusters, blocks


async def test_a_chain_of_afters_moves_as_a_whole_in_both_directions(pilot) -> None:
    chain = after(HIT, "w1:start") + after("w1:end", "w2:start") + after("w2:end+0.2", "n:start")
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w1", 0.5) + wait("w2", 0.5) + nod("n") + chain)
    await moves(pilot, 0.2, ("hit", 3.0), 0.2, ("hit", 0.5), 3)
    for point, time in {"w1:start": 0.5, "w2:start": 1.0, "n:start": 1.7}.items():
        assert_time(pilot.feedback, f"b:{point}", time)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("moved", [0.5, 4.0])
async def test_a_cluster_starts_as_early_as_it_may_also_after_the_change(pilot, moved) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", WELL.format("") + nod("n", stroke="s:m") + wait("w", 0.2) + after(HIT, "s:m", "w:start"))
    await moves(pilot, 0.2, ("hit", moved), 8)
    assert_linked(pilot.feedback, "b:n:stroke", "b:s:m")
    assert_time(pilot.feedback, "b:s:m", max(moved, 0.55), tolerance=0.06)
    assert_time(pilot.feedback, "b:w:start", moved)
    assert pilot.feedback.warnings == []  # verify would say that 7.24 does not hold


async def test_constraints_across_blocks_and_characters_follow(tests_data) -> None:
    two = SceneOptions(human=tests_data / "humans" / "two.toml", voice="text", verify=True)
    async with open_pilot(two) as pilot:
        pilot.predict("t", "hit", 1.0)
        pilot.block("a", wait("w", 0.5, start=HIT), characterId="alice")
        more = wait("v", 0.5) + after("a:w:end", "v:start")
        pilot.block("b", nod("n", start="a:w:end+0.1") + more, characterId="bob")
        pilot.block("c", nod("n", start="0.5") + before("a:w:start", "n:end"), characterId="alice")
        await moves(pilot, 0.2, ("hit", 3.0), 0.2, ("hit", 0.9), 4)
        assert_linked(pilot.feedback, "b:n:start", "a:w:end", 0.1)
        assert_linked(pilot.feedback, "b:v:start", "a:w:end")
        assert_linked(pilot.feedback, "c:n:end", "a:w:start")
        assert pilot.feedback.warnings == []


async def test_whatever_tries_to_come_before_the_block_is_not_pulled_further_than_its_start(pilot) -> None:
    pilot.block("a", wait("w", 2))
    pilot.block("b", wait("w", 0.5) + before(HIT, "w:end"), composition="APPEND")
    await moves(pilot, 0.2, ("hit", 1.0), 4)
    assert_time(pilot.feedback, "b:w:start", 2.0)
    assert [f"w:end before {HIT} {LOST}: 1.5 s are missing" in said for said in texts(pilot)] == [True]


async def test_who_hangs_on_a_chunk_follows_it_when_that_is_planned_anew(pilot) -> None:
    pilot.block("a", BEAT.format(' mode="RIGHT_HAND"'))
    chunk = WELL.format("") + BEAT.format(' mode="RIGHT_HAND" stroke="s:m"')
    pilot.block("b", chunk, **{"bmla:chunkAfter": "a"})
    pilot.block("c", nod("n", start="b:s:m") + wait("w", 0.1) + after("b:g:stroke", "w:start"))
    await pilot.advance(6)
    assert_linked(pilot.feedback, "c:n:start", "b:s:m")
    assert_linked(pilot.feedback, "c:w:start", "b:g:stroke")
    assert pilot.feedback.warnings == []


# --- at


async def test_a_point_that_has_come_keeps_its_time_and_the_rest_follows(pilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", nod("n", start=f"{HIT}-0.5", end=f"{HIT}+1"))
    await moves(pilot, 0.7, ("hit", 1.4), 3)
    assert_time(pilot.feedback, "b:n:start", 0.5)
    assert_time(pilot.feedback, "b:n:end", 2.4)
    (said,) = texts(pilot)
    assert f"n:start = {HIT}-0.5 {LOST}: 0.4 s are missing" in said


async def test_an_anticipator_that_starts_over_breaks_nothing_that_has_come(pilot) -> None:
    pilot.predict("t", "hit", 0.5)
    pilot.block("b", nod("n", start=HIT) + wait("w", 5))
    await moves(pilot, 0.7, ("hit", 1.4), 0.2, ("hit", None), 0.2, ("hit", 3.0), 5)
    assert_time(pilot.feedback, "b:n:start", 0.5)
    assert pilot.feedback.warnings == []


async def test_between_two_ties_everything_stretches_alike_while_it_plays(pilot) -> None:
    pilot.predict("t", "hit", 1.4)
    pilot.block("b", nod("n", start="0", end=HIT) + nod("m", start="0", end="1.4"))
    await moves(pilot, 0.1, ("hit", 2.8), 4)
    for sync in ("strokeStart", "stroke", "strokeEnd", "end"):
        assert_time(pilot.feedback, f"b:n:{sync}", 2 * pilot.feedback.time(f"b:m:{sync}"))


async def test_rigid_stays_rigid_when_its_start_cannot_be_as_early_as_its_end_would_have_it(pilot) -> None:
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", WELL.format(f' end="{HIT}"') + nod("n", start="s:m"))
    await moves(pilot, 1, ("hit", 1.3), 4)
    assert_time(pilot.feedback, "b:s:start", 1.0)
    assert pilot.feedback.time("b:s:end") > 2.0
    assert_linked(pilot.feedback, "b:n:start", "b:s:m")
    assert [LOST in said and f"s:end = {HIT}" in said for said in texts(pilot)] == [True]


async def test_the_end_of_a_speech_that_has_begun_does_not_wait(pilot) -> None:
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", WELL.format(f' end="{HIT}"') + nod("n", start="s:end") + wait("w", 0.1, start=HIT))
    await moves(pilot, 0.5, ("hit", 3.0), 4)
    assert_time(pilot.feedback, "b:s:end", 1.5)
    assert_linked(pilot.feedback, "b:n:start", "b:s:end")
    assert_time(pilot.feedback, "b:w:start", 3.0)
    assert [f"s:end = {HIT} {LOST}" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize("turn", [1, -1])
async def test_a_circle_of_at_that_agrees_is_kept_and_one_that_does_not_is_named(pilot, turn) -> None:
    def circle(last):
        return "".join([nod("x", start="y:start+1"), nod("y", start="z:start+1"), nod("z", start=last)][::turn])

    pilot.block("good", circle("x:start-2"))
    pilot.block("bad", circle("x:start-2.5"), composition="APPEND")
    await pilot.advance(8)
    assert_linked(pilot.feedback, "good:x:start", "good:z:start", 2.0)
    assert pilot.feedback.warnings == [("bad:z", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "z:start = x:start-2.5 contradicts other constraints by 0.5 s" in texts(pilot)[0]


# --- two times from outside


@pytest.mark.parametrize(
    ("moved", "start"), [((0.5, ("go", 1.8)), 2.3), ((1.2, ("hit", 1.3)), 1.5), ((1.6, ("hit", 1.7)), 1.7)]
)
async def test_of_two_on_anticipators_that_come_too_close_the_later_one_is_held_back(pilot, moved, start) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", wait("w", 0.5, start=GO) + nod("n", start=HIT) + after("w:end", "n:start"))
    await moves(pilot, *moved, 4)
    assert_time(pilot.feedback, "b:n:start", start)
    assert [f"n:start = {HIT} {LOST}" in said for said in texts(pilot)] == [True] * (start != 1.7)


@pytest.mark.parametrize("moved", [(0.5, ("go", 1.6)), (1.2, ("hit", 1.7)), (0.5, ("hit", 1.3))])
async def test_what_lies_between_them_and_can_be_shorter_is_whoever_was_predicted_last(pilot, moved) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 2.0)
    pilot.block("b", nod("m", start=GO) + nod("n", start=HIT) + after("m:end", "n:start"))
    await moves(pilot, *moved, 4)
    predicted = {"go": 1.0, "hit": 2.0} | dict([moved[1]])
    assert_time(pilot.feedback, "b:m:start", predicted["go"])
    assert_time(pilot.feedback, "b:n:start", predicted["hit"])
    assert_order(pilot.feedback, "b:m:end", "b:n:start")
    assert pilot.feedback.warnings == []


async def test_a_point_that_its_successor_overtakes_comes_with_it_and_is_predicted_so(pilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", nod("n", start="0", stroke=HIT, end=GO))
    await moves(pilot, 0.5, ("hit", 3.0), 0.1)
    assert pilot.feedback.predicted("b:n:stroke") == pytest.approx(1.5)
    await pilot.advance(3)
    assert_time(pilot.feedback, "b:n:stroke", 1.5)
    assert [f"n:stroke = {HIT} {LOST}" in said for said in texts(pilot)] == [True]


@pytest.mark.parametrize(("moved", "why"), [(0.8, "lost their order"), (1.0, "no time is left")])
async def test_a_behavior_without_time_that_has_not_begun_is_dropped_with_one_warning(pilot, moved, why) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.predict("t", "hit", 3.0)
    pilot.block("b", nod("n", start=GO, end=HIT))
    await moves(pilot, 0.5, ("hit", moved), 2)
    assert_not_played(pilot.feedback, "b:n")
    (said,) = texts(pilot)
    assert why in said


# --- joining what has begun


async def test_a_behavior_on_a_point_that_has_passed_joins_late_without_a_warning(pilot) -> None:
    pilot.block("a", wait("w", 3))
    await pilot.advance(0.5)
    pilot.block("b", nod("n", start="a:w:start"))
    await pilot.advance(1)
    assert_time(pilot.feedback, "b:n:start", 0.0)
    assert 0.5 < pilot.feedback.time("b:n:end") < 1.0
    assert pilot.feedback.warnings == []


async def test_it_is_dropped_with_a_warning_if_its_end_has_passed_too(pilot) -> None:
    pilot.block("a", wait("w", 3))
    await pilot.advance(2)
    pilot.block("b", nod("n", start="a:w:start"))
    await pilot.advance(1)
    assert_not_played(pilot.feedback, "b:n")
    assert pilot.feedback.warnings == [("b:n", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.status("b") == "DONE"


async def test_it_is_dropped_also_if_its_end_passes_while_its_block_waits(pilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 2.0)
    pilot.block("a", wait("w", 0.5, start=GO))
    pilot.block("b", nod("n", start=HIT), composition="APPEND")
    await moves(pilot, 0.2, ("go", None), 2.2, ("go", 2.4), 3)
    assert_not_played(pilot.feedback, "b:n")
    assert [line.id for line in pilot.feedback.of("warningFeedback")] == ["b:n"]


async def test_a_block_that_waits_is_not_pinned_by_a_prediction_that_is_early_for_a_moment(pilot) -> None:
    pilot.predict("t", "go", 1.5)
    pilot.predict("t", "hit", 3.0)
    pilot.block("a", wait("w", 0.5, start=GO))
    pilot.block("b", nod("n", end=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 0.6), 0.05, ("hit", 5.0), 0.1)
    assert pilot.feedback.predicted("b:n:start") > 4.0
    await pilot.advance(6)
    assert_time(pilot.feedback, "b:n:end", 5.0)
    assert pilot.feedback.time("b:n:start") > 4.0
    assert pilot.feedback.warnings == []


async def test_what_would_begin_before_its_block_is_hurried_and_not_begun_before_it(pilot) -> None:
    pilot.predict("t", "hit", 5.0)
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", end=HIT), composition="APPEND")
    await moves(pilot, 0.5, ("hit", 1.2), 3)
    assert_time(pilot.feedback, "b:n:start", 1.0)
    assert_time(pilot.feedback, "b:n:end", 1.2)
    assert pilot.feedback.warnings == []


# --- the start of a block


@pytest.mark.parametrize("tie", [before("d:start", "a:end", "b:end"), after("b:end", "d:start")])
async def test_example_34_a_block_waits_for_what_its_start_is_after(pilot, tie) -> None:
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", end=HIT))
    pilot.predict("t", "hit", 2.0)
    pilot.block("d", f"<required>{tie}</required>" + wait("w", 0.5), composition="MERGE")
    await moves(pilot, 0.5, ("hit", 1.7), 3)
    assert_linked(pilot.feedback, "d:start", "b:end")
    assert_time(pilot.feedback, "d:start", 1.7)
    assert_order(pilot.feedback, "a:end", "d:start")
    assert pilot.feedback.warnings == []


async def test_a_block_may_start_at_a_point_of_another_one_or_of_an_anticipator(pilot) -> None:
    pilot.block("a", wait("w", 1))
    pilot.block("b", wait("w", 0.5) + synchronize("b:start", "a:w:end+0.5"))
    pilot.block("c", wait("w", 0.5) + after(HIT, "c:start"))
    await pilot.advance(1)
    assert not pilot.feedback.reached("c:start")
    await moves(pilot, ("hit", 2.0), 2)
    assert_linked(pilot.feedback, "b:start", "a:w:end", 0.5)
    assert_time(pilot.feedback, "c:start", 2.0)
    assert pilot.feedback.warnings == []


async def test_what_waits_for_itself_by_way_of_others_is_refused(pilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.block("z", wait("w", 0.5, start=GO))
    pilot.block("a", wait("w", 1), composition="APPEND")
    pilot.block("d", wait("w", 0.5, start="a:w:end"))
    await pilot.advance(0.2)
    pilot.block("x", **{"bmla:appendAfter": "d", "bmla:prependBefore": "a"})
    await pilot.advance(4)
    (said,) = texts(pilot)
    assert "'x' is to come before 'a' and waits for it too" in said
    assert pilot.feedback.status("d") == "DONE"


async def test_a_block_that_has_ended_leaves_nothing_on_what_it_was_constrained_by(pilot) -> None:
    pilot.predict("t", "hit", 100.0)
    pilot.block("keep", wait("w", 1, start=HIT))
    await pilot.tick()
    hanging = len(pilot.realizer.board.predicted("t", "hit").dependents)
    for constraint in (before(HIT, "n:end"), after(f"{HIT}-100", "n:end"), after(f"{HIT}-100", "b:start")):
        pilot.block("b", nod("n") + constraint)
        await pilot.advance(1)
    assert [line.id for line in pilot.feedback.of("blockProgress")].count("b:end") == 3
    assert len(pilot.realizer.board.predicted("t", "hit").dependents) == hanging


# --- required, limits of what can be


@pytest.mark.parametrize("kind", ["tie", "order", "behavior"])
async def test_a_required_constraint_that_cannot_be_fails_its_block_of_which_nothing_stays(pilot, kind) -> None:
    parts = {
        "tie": wait("w", 1, start="0") + f"<required>{synchronize('w:end', '3')}</required>",
        "order": wait("w", 1, start="0") + f"<required>{after('2', 'w:start')}{before('1', 'w:start')}</required>",
        "behavior": f"<required>{nod('n', start='1', end='1')}</required>",
    }
    pilot.block("b", wait("other", 1) + parts[kind])
    await pilot.advance(4)
    if kind == "tie":  # what is not required makes room
        assert pilot.feedback.warnings == [("b:w", "IMPOSSIBLE_TO_SCHEDULE")]
        assert_time(pilot.feedback, "b:w:start", 2.0)
        return
    assert pilot.feedback.progress == ["b:end"]
    assert pilot.feedback.status("b") == "FAILED"


async def test_a_required_constraint_that_is_lost_while_it_plays_is_said_like_any_other(pilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w", 1, start="0.5") + f"<required>{after(HIT, 'w:end')}</required>")
    await moves(pilot, 0.7, ("hit", 2.0), 2)
    assert [LOST in said for said in texts(pilot)] == [True]
    assert pilot.feedback.status("b") == "DONE"


async def test_a_wait_is_not_stretched_beyond_its_most_where_others_can_be(pilot) -> None:
    pilot.block(
        "b", nod("n", start="0") + '<wait id="w" max-wait="1" start="n:end"/>' + nod("m", start="w:end", end="3.4")
    )
    pilot.block("c", '<wait id="w" max-wait="1" start="0" end="3"/>')  # what its sync points say goes first
    await pilot.advance(9)
    assert_time(pilot.feedback, "b:w:end", pilot.feedback.time("b:w:start") + 1)
    assert_time(pilot.feedback, "b:m:end", 3.4)
    assert_time(pilot.feedback, "c:w:end", 3.0)
    assert pilot.feedback.warnings == []


async def test_a_constraint_that_contradicts_itself_says_so(pilot) -> None:
    pilot.block("b", wait("w", 1) + before("w:end", "w:end+1"))
    await pilot.advance(2)
    assert ["w:end+1 before w:end can never hold, 1 s are missing" in said for said in texts(pilot)] == [True]


# --- off the loop


async def test_a_big_block_is_solved_again_if_times_from_outside_moved_meanwhile(pilot) -> None:
    chain = "".join(wait(f"w{i}", 0.05, start=f"w{i - 1}:end") for i in range(1, 60))
    pilot.predict("t", "hit", 9.0)
    pilot.block("big", wait("w0", 0.05, start=GO) + chain + nod("n", start="w59:end", end=HIT))
    pilot.predict("t", "go", 1.0)
    await pilot.tick()
    for time in (5.0, 4.2):
        pilot.predict("t", "hit", time)
        await pilot.tick()
    await pilot.advance(6)
    assert_time(pilot.feedback, "big:w0:start", 1.0)
    assert_time(pilot.feedback, "big:n:end", 4.2)
    assert_linked(pilot.feedback, "big:n:start", "big:w59:end")
    assert pilot.feedback.warnings == []


async def test_a_big_block_is_committed_even_if_what_it_hangs_on_never_rests(pilot) -> None:
    chain = "".join(wait(f"w{i}", 0.05, start=f"w{i - 1}:end") for i in range(1, 60))
    pilot.block("big", wait("w0", 0.05) + chain + nod("n", end=HIT))
    for i in range(100):
        pilot.predict("t", "hit", 4.0 + i / 100)
        await pilot.tick()
    assert 0.0 < pilot.feedback.time("big:start") < 0.1
    await pilot.advance(5)
    assert_time(pilot.feedback, "big:n:end", 4.99)


# --- what is predicted


async def test_what_was_predicted_last_is_what_comes_for_every_point_of_a_plan_that_moves(pilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.block("b", WELL.format(f' start="{GO}"') + BEAT.format(' stroke="s:m"') + nod("n", start="g:end", end=HIT))
    pilot.block("c", nod("n"), composition="APPEND")
    await moves(pilot, 0.3, ("go", 1.4), 0.1, ("hit", 6.0), 0.4, ("go", 1.2), 1.5, ("hit", 5.0), 8)
    for point in pilot.feedback.progress:
        if point not in ("b:relax", "c:relax", "b:s:m"):
            assert pilot.feedback.predicted(point) == pytest.approx(pilot.feedback.time(point), abs=1e-3)
    assert pilot.feedback.time("c:start") == pilot.feedback.time("b:end")
