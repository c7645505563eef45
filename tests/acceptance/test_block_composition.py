"""Composition of blocks: appended, prepended, chunks, preplanned and activated (BMLA; docs/semantics.md)."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

A = 'xmlns:bmla="http://www.asap-project.org/bmla"'
T = 'xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'


def wait(seconds: float) -> str:
    return f'<wait id="w" duration="{seconds}"/>'


def send(pilot: RealizerPilot, id_: str, inside: str = "", attributes: str = "") -> None:
    pilot.perform(
        f'<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" {A} {T} id="{id_}" {attributes}>{inside}</bml>'
    )


async def test_a_block_starts_when_the_blocks_it_is_appended_after_have_ended(pilot: RealizerPilot) -> None:
    send(pilot, "long", wait(3))
    send(pilot, "one", wait(0.5))
    send(pilot, "two", wait(1.2345))
    send(pilot, "new", wait(0.1), 'bmla:appendAfter="one,two"')
    await pilot.advance(4)
    assert pilot.feedback.time("new:start") == pilot.feedback.time("two:end") == pytest.approx(1.2345)


@pytest.mark.parametrize("words", ["APPEND-AFTER(one)", "append_after( one )"])
async def test_append_after_may_be_written_as_composition(pilot: RealizerPilot, words: str) -> None:
    send(pilot, "long", wait(3))
    send(pilot, "one", wait(0.5))
    send(pilot, "new", wait(0.1), f'composition="{words}"')
    await pilot.advance(4)
    assert pilot.feedback.time("new:start") == 0.5


async def test_an_unknown_target_counts_as_finished_and_is_reported(pilot: RealizerPilot) -> None:
    send(pilot, "new", wait(0.1), 'bmla:appendAfter="nobody" bmla:interrupt="none" bmla:chunkAfter="new"')
    await pilot.advance(1)
    assert pilot.feedback.time("new:start") == 0
    assert pilot.feedback.warnings == [("new", "IMPOSSIBLE_TO_SCHEDULE")] * 3


async def test_a_target_that_has_ended_counts_as_finished_without_a_warning(pilot: RealizerPilot) -> None:
    send(pilot, "old", wait(0.1))
    await pilot.advance(1)
    send(pilot, "new", wait(0.1), 'bmla:appendAfter="old" bmla:interrupt="old" bmla:prependBefore="old"')
    await pilot.advance(1)
    assert pilot.feedback.status("new") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_target_that_is_revoked_while_it_waits_counts_as_finished(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(5))
    send(pilot, "second", wait(1), 'bmla:appendAfter="first"')
    send(pilot, "third", wait(1), 'bmla:appendAfter="second"')
    await pilot.advance(0.5)
    send(pilot, "stop", "", 'bmla:interrupt="second"')
    await pilot.tick()
    assert pilot.feedback.status("second") == "REVOKED"
    assert pilot.feedback.time("third:start") == pilot.feedback.time("second:end")


async def test_a_chunk_starts_when_the_previous_chunk_subsides(pilot: RealizerPilot) -> None:
    send(pilot, "one", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>')
    send(pilot, "two", '<head id="h" lexeme="NOD"/>', 'bmla:chunkAfter="one"')
    await pilot.advance(6)
    assert pilot.feedback.time("two:start") == pilot.feedback.time("one:g:relax") == pilot.feedback.time("one:relax")
    assert pilot.feedback.time("two:start") < pilot.feedback.time("one:end")


async def test_a_prepended_block_plays_before_a_waiting_block(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "last", wait(1), 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "between", wait(2), 'bmla:prependBefore="last"')
    await pilot.advance(5)
    assert pilot.feedback.time("last:start") == pilot.feedback.time("between:end") == pytest.approx(2.01)


async def test_a_block_starts_when_a_chunk_that_was_prepended_to_it_subsides(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "last", '<head id="h" lexeme="NOD"/>', 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "chunk", '<gesture id="g" lexeme="BEAT" start="2"/>', 'bmla:chunkBefore="last"')
    await pilot.advance(8)
    assert pilot.feedback.time("last:start") == pilot.feedback.time("chunk:g:relax")


async def test_no_block_can_be_prepended_to_a_playing_block(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    await pilot.tick()
    send(pilot, "late", wait(1), 'bmla:prependBefore="plays"')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("late", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.progress == ["plays:start", "plays:w:start", "late:end", "plays:w:end", "plays:end"]
    assert pilot.feedback.status("late") == "FAILED"


async def test_a_block_cannot_be_both_before_and_after_another_block(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    send(pilot, "waits", wait(1), 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "odd", wait(1), 'bmla:appendAfter="waits" bmla:prependBefore="waits"')
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("odd", "IMPOSSIBLE_TO_SCHEDULE")]
    assert (pilot.feedback.status("odd"), pilot.feedback.status("waits")) == ("FAILED", "DONE")


async def test_a_behavior_cannot_refer_to_a_block_that_waits_for_its_own_block(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    send(pilot, "waits", wait(1), 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "odd", '<wait id="w" start="waits:w:start" duration="1"/>', 'bmla:prependBefore="waits"')
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("odd:w", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.status("odd") == pilot.feedback.status("waits") == "DONE"


@pytest.mark.parametrize("prefix", ["bmla", "bmlt"])
async def test_a_preplanned_block_waits_until_a_block_activates_it_at_its_start(
    pilot: RealizerPilot, prefix: str
) -> None:
    send(pilot, "ready", wait(1), f'{prefix}:preplan="true"')
    await pilot.advance(1)
    assert pilot.feedback.progress == []
    assert (
        pilot.feedback.predictions("ready")[-1].element[0].get("{http://www.asap-project.org/bmla}status") == "PENDING"
    )
    send(pilot, "go", '<wait id="w" duration="0.5"/>', f'{prefix}:onStart="ready"')
    await pilot.advance(2)
    assert pilot.feedback.time("ready:start") == pilot.feedback.time("go:start")


async def test_an_appended_block_does_not_wait_for_preplanned_blocks(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "ready", wait(1), 'bmla:preplan="true" bmla:appendAfter="first"')
    send(pilot, "new", wait(0.1), 'composition="APPEND"')
    await pilot.advance(2)
    assert pilot.feedback.time("new:start") == 1.0


async def test_an_activated_block_waits_for_the_blocks_that_it_is_appended_after(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1.005))
    send(pilot, "ready", wait(1), 'bmla:preplan="true" bmla:appendAfter="first"')
    send(pilot, "go", "", 'bmla:onStart="ready"')
    await pilot.advance(3)
    assert pilot.feedback.time("ready:start") == pytest.approx(1.005)


async def test_activating_a_block_that_is_not_preplanned_ended_or_active_is_reported(pilot: RealizerPilot) -> None:
    send(pilot, "plain", wait(0.1))
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    send(pilot, "go", "", 'bmla:onStart="ready,plain,nobody"')
    send(pilot, "again", "", 'bmla:onStart="ready"')
    await pilot.advance(1)
    send(pilot, "late", "", 'bmla:onStart="plain"')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [
        ("go", "IMPOSSIBLE_TO_SCHEDULE"),
        ("go", "NO_SUCH_TARGET"),
        ("again", "IMPOSSIBLE_TO_SCHEDULE"),
        ("late", "IMPOSSIBLE_TO_SCHEDULE"),
    ]


async def test_the_attribute_interrupt_ends_its_targets_before_the_new_block_starts(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(5))
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    await pilot.advance(0.5)
    send(pilot, "new", wait(0.1), 'bmla:interrupt="plays,ready"')
    await pilot.advance(1)
    order = pilot.feedback.progress
    assert order.index("plays:end") < order.index("new:start")
    assert (pilot.feedback.status("plays"), pilot.feedback.status("ready")) == ("INTERRUPTED", "REVOKED")


async def test_replace_revokes_preplanned_blocks(pilot: RealizerPilot) -> None:
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    await pilot.advance(0.5)
    send(pilot, "new", wait(0.1), 'composition="REPLACE"')
    await pilot.advance(1)
    assert pilot.feedback.status("ready") == "REVOKED"


async def test_either_path_of_the_incremental_speech_plan_can_be_taken(pilot: RealizerPilot) -> None:
    """Thesis 6.5.2.3 and example 11."""

    def plan() -> None:
        for id_, attributes in (
            ("eh", ""),
            ("well", ""),
            ("costs", 'bmla:appendAfter="eh,well"'),
            ("say", 'bmla:appendAfter="eh,well"'),
            ("crowns", 'bmla:appendAfter="costs,say"'),
        ):
            send(pilot, id_, wait(0.5), f'bmla:preplan="true" {attributes}')

    plan()
    await pilot.advance(1)
    send(pilot, "path", "", 'bmla:interrupt="well,say" bmla:onStart="eh,costs,crowns"')
    await pilot.advance(3)
    assert [p for p in pilot.feedback.progress if p.endswith("s:start") or p == "eh:start"] == [
        "eh:start",
        "costs:start",
        "crowns:start",
    ]
    assert pilot.feedback.time("crowns:start") == pilot.feedback.time("eh:start") + 1.0


async def test_a_block_of_more_than_fifty_behaviors_is_solved_in_the_background(pilot: RealizerPilot) -> None:
    waits = "".join(
        f'<wait id="w{i}" start="{"0" if i == 0 else f"w{i - 1}:end"}" duration="0.01"/>' for i in range(60)
    )
    send(pilot, "big", waits)
    send(pilot, "small", wait(0.05))
    await pilot.advance(2)
    assert pilot.feedback.time("big:w59:end") - pilot.feedback.time("big:start") == pytest.approx(0.6)
    assert pilot.feedback.time("small:start") < pilot.feedback.time("big:start")


async def test_a_block_may_interrupt_a_block_with_its_own_id(pilot: RealizerPilot) -> None:
    send(pilot, "again", wait(5))
    await pilot.advance(0.5)
    send(pilot, "again", wait(0.1), 'bmla:interrupt="again"')
    await pilot.advance(1)
    assert [point for point in pilot.feedback.progress if point in ("again:start", "again:end")] == [
        "again:start",
        "again:end",
    ] * 2


async def test_a_block_with_an_invalid_composition_interrupts_nothing(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    send(pilot, "other", wait(1))
    await pilot.tick()
    send(pilot, "late", wait(1), 'bmla:prependBefore="plays" bmla:interrupt="other"')
    await pilot.advance(2)
    assert pilot.feedback.status("other") == "DONE"


async def test_the_predictions_of_a_preplanned_block_assume_that_it_is_activated_now(
    pilot: RealizerPilot,
) -> None:
    send(pilot, "ready", '<speech id="s"><text>one two three</text></speech>', 'bmla:preplan="true"')
    await pilot.advance(0.5)
    send(pilot, "plain", '<speech id="s"><text>one two three</text></speech>')
    await pilot.tick()
    ready, plain = (pilot.feedback.predictions(block)[-1].element for block in ("ready", "plain"))
    spoken = float(plain[0].get("globalEnd", "nan")) - float(plain[0].get("globalStart", "nan"))
    assert spoken > 0.5
    assert float(ready[0].get("globalEnd", "nan")) - float(ready[0].get("globalStart", "nan")) == pytest.approx(spoken)
    assert ready[1].get("end") == plain[1].get("end")


async def test_a_waiting_block_follows_the_latest_prediction_after_an_earlier_one(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 3.0)
    send(pilot, "first", wait(2))
    send(pilot, "next", '<head id="n" lexeme="NOD" end="anticipators:t:hit"/>', 'composition="APPEND"')
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 0.6)
    await pilot.advance(0.1)
    pilot.predict("t", "hit", 5.0)
    await pilot.advance(5)
    assert pilot.feedback.time("next:n:end") == 5.0
    assert pilot.feedback.time("next:n:start") > 4


@pytest.mark.parametrize("start", [2.0, 2.0042])
async def test_a_behavior_whose_points_lie_before_its_block_is_shortened_at_the_start_of_the_block(
    pilot: RealizerPilot, start: float
) -> None:
    pilot.predict("t", "hit", 9.0)
    send(pilot, "first", wait(start))
    send(pilot, "next", '<head id="n" lexeme="NOD" end="anticipators:t:hit"/>', 'composition="APPEND"')
    await pilot.tick()
    pilot.predict("t", "hit", 2.3)
    await pilot.advance(4)
    assert pilot.feedback.time("next:n:start") == pilot.feedback.time("next:start") == start
    assert pilot.feedback.time("next:n:end") == 2.3
    assert pilot.feedback.warnings == []


async def test_a_behavior_that_should_have_started_before_it_was_planned_starts_now(pilot: RealizerPilot) -> None:
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    send(pilot, "early", '<head id="n" lexeme="NOD" stroke="ready:start"/>')
    await pilot.advance(0.3)
    send(pilot, "go", "", 'bmla:onStart="ready"')
    await pilot.advance(3)
    assert pilot.feedback.time("ready:start") == 0.3
    assert pilot.feedback.time("early:n:start") == 0.3
    assert pilot.feedback.time("early:n:stroke") == pytest.approx(0.35, abs=0.01)
    assert pilot.feedback.time("early:n:end") > 0.5
