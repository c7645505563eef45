"""How blocks join each other: after, before, in chunks, prepared and activated (BMLA; docs/semantics.md)."""

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


async def test_a_target_that_was_never_seen_counts_as_finished_and_is_told(pilot: RealizerPilot) -> None:
    send(pilot, "new", wait(0.1), 'bmla:appendAfter="nobody" bmla:interrupt="none" bmla:chunkAfter="new"')
    await pilot.advance(1)
    assert pilot.feedback.time("new:start") == 0
    assert pilot.feedback.warnings == [("new", "IMPOSSIBLE_TO_SCHEDULE")] * 3


async def test_a_target_that_has_ended_counts_as_finished_without_a_word(pilot: RealizerPilot) -> None:
    send(pilot, "old", wait(0.1))
    await pilot.advance(1)
    send(pilot, "new", wait(0.1), 'bmla:appendAfter="old" bmla:interrupt="old" bmla:prependBefore="old"')
    await pilot.advance(1)
    assert pilot.feedback.status("new") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_revoked_target_counts_as_finished_though_it_waited_itself(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(5))
    send(pilot, "second", wait(1), 'bmla:appendAfter="first"')
    send(pilot, "third", wait(1), 'bmla:appendAfter="second"')
    await pilot.advance(0.5)
    send(pilot, "stop", "", 'bmla:interrupt="second"')
    await pilot.tick()
    assert pilot.feedback.status("second") == "REVOKED"
    assert pilot.feedback.time("third:start") == pilot.feedback.time("second:end")


async def test_a_block_starts_in_retraction_of_the_one_it_is_a_chunk_after(pilot: RealizerPilot) -> None:
    send(pilot, "one", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>')
    send(pilot, "two", '<head id="h" lexeme="NOD"/>', 'bmla:chunkAfter="one"')
    await pilot.advance(6)
    assert pilot.feedback.time("two:start") == pilot.feedback.time("one:g:relax") == pilot.feedback.time("one:relax")
    assert pilot.feedback.time("two:start") < pilot.feedback.time("one:end")


async def test_what_is_prepended_comes_before_a_block_that_still_waits(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "last", wait(1), 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "between", wait(2), 'bmla:prependBefore="last"')
    await pilot.advance(5)
    assert pilot.feedback.time("last:start") == pilot.feedback.time("between:end") == pytest.approx(2.01)


async def test_a_chunk_put_before_a_block_lets_it_start_when_it_subsides(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "last", '<head id="h" lexeme="NOD"/>', 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "chunk", '<gesture id="g" lexeme="BEAT" start="2"/>', 'bmla:chunkBefore="last"')
    await pilot.advance(8)
    assert pilot.feedback.time("last:start") == pilot.feedback.time("chunk:g:relax")


async def test_nothing_can_be_put_before_a_block_that_plays(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    await pilot.tick()
    send(pilot, "late", wait(1), 'bmla:prependBefore="plays"')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("late", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.progress == ["plays:start", "plays:w:start", "late:end", "plays:w:end", "plays:end"]
    assert pilot.feedback.status("late") == "FAILED"


async def test_a_block_cannot_come_both_before_and_after_another(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    send(pilot, "waits", wait(1), 'composition="APPEND"')
    await pilot.tick()
    send(pilot, "odd", wait(1), 'bmla:appendAfter="waits" bmla:prependBefore="waits"')
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("odd", "IMPOSSIBLE_TO_SCHEDULE")]
    assert (pilot.feedback.status("odd"), pilot.feedback.status("waits")) == ("FAILED", "DONE")


async def test_a_behavior_cannot_hang_on_a_block_that_waits_for_its_own(pilot: RealizerPilot) -> None:
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


async def test_an_append_does_not_wait_for_what_was_never_activated(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1))
    send(pilot, "ready", wait(1), 'bmla:preplan="true" bmla:appendAfter="first"')
    send(pilot, "new", wait(0.1), 'composition="APPEND"')
    await pilot.advance(2)
    assert pilot.feedback.time("new:start") == 1.0


async def test_an_activated_block_still_waits_for_what_it_is_appended_after(pilot: RealizerPilot) -> None:
    send(pilot, "first", wait(1.005))
    send(pilot, "ready", wait(1), 'bmla:preplan="true" bmla:appendAfter="first"')
    send(pilot, "go", "", 'bmla:onStart="ready"')
    await pilot.advance(3)
    assert pilot.feedback.time("ready:start") == pytest.approx(1.005)


async def test_activating_what_is_not_preplanned_gone_or_active_is_told(pilot: RealizerPilot) -> None:
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


async def test_the_attribute_interrupt_ends_blocks_before_the_new_one_starts(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(5))
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    await pilot.advance(0.5)
    send(pilot, "new", wait(0.1), 'bmla:interrupt="plays,ready"')
    await pilot.advance(1)
    order = pilot.feedback.progress
    assert order.index("plays:end") < order.index("new:start")
    assert (pilot.feedback.status("plays"), pilot.feedback.status("ready")) == ("INTERRUPTED", "REVOKED")


async def test_replace_revokes_what_is_prepared(pilot: RealizerPilot) -> None:
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    await pilot.advance(0.5)
    send(pilot, "new", wait(0.1), 'composition="REPLACE"')
    await pilot.advance(1)
    assert pilot.feedback.status("ready") == "REVOKED"


async def test_the_incremental_speech_plan_takes_either_of_its_paths(pilot: RealizerPilot) -> None:
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


async def test_a_block_of_more_than_fifty_behaviors_is_solved_aside_and_plays(pilot: RealizerPilot) -> None:
    waits = "".join(
        f'<wait id="w{i}" start="{"0" if i == 0 else f"w{i - 1}:end"}" duration="0.01"/>' for i in range(60)
    )
    send(pilot, "big", waits)
    send(pilot, "small", wait(0.05))
    await pilot.advance(2)
    assert pilot.feedback.time("big:w59:end") - pilot.feedback.time("big:start") == pytest.approx(0.6)
    assert pilot.feedback.time("small:start") < pilot.feedback.time("big:start")


async def test_a_block_may_interrupt_the_one_of_its_own_name(pilot: RealizerPilot) -> None:
    send(pilot, "again", wait(5))
    await pilot.advance(0.5)
    send(pilot, "again", wait(0.1), 'bmla:interrupt="again"')
    await pilot.advance(1)
    assert [point for point in pilot.feedback.progress if point in ("again:start", "again:end")] == [
        "again:start",
        "again:end",
    ] * 2


async def test_a_block_that_cannot_stand_where_it_wants_to_ends_nothing(pilot: RealizerPilot) -> None:
    send(pilot, "plays", wait(1))
    send(pilot, "other", wait(1))
    await pilot.tick()
    send(pilot, "late", wait(1), 'bmla:prependBefore="plays" bmla:interrupt="other"')
    await pilot.advance(2)
    assert pilot.feedback.status("other") == "DONE"


async def test_of_a_block_that_is_prepared_everything_is_predicted_as_if_it_were_activated_now(
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


async def test_a_block_that_waits_and_whose_prediction_was_early_for_a_moment_follows_the_later_one(
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
async def test_what_came_to_lie_before_its_block_is_squeezed_when_the_block_starts(
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


async def test_what_would_have_had_to_begin_before_it_was_known_is_not_played_in_the_past(pilot: RealizerPilot) -> None:
    send(pilot, "ready", wait(1), 'bmla:preplan="true"')
    send(pilot, "early", '<head id="n" lexeme="NOD" stroke="ready:start"/>')
    await pilot.advance(0.3)
    send(pilot, "go", "", 'bmla:onStart="ready"')
    await pilot.advance(3)
    assert pilot.feedback.time("ready:start") == 0.3
    assert pilot.feedback.time("early:n:start") == pilot.feedback.time("early:n:stroke") == 0.3
    assert pilot.feedback.time("early:n:end") > 0.5
