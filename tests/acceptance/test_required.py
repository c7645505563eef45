"""Required behaviors that are lost after planning fail their block."""

from collections import Counter

import pytest

from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.testing.assertions import assert_block_around, assert_ended, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import HIT, nod

TALK = '<speech id="s"{}><text>one two three four five six</text></speech>'
REQUIRED = "<required>{}</required>"
SAID = [("new:s", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_required_speech_that_is_dropped_in_a_conflict_fails_its_block(pilot: RealizerPilot) -> None:
    pilot.block("talk", TALK.format(""))
    await pilot.advance(0.5)
    pilot.block("new", REQUIRED.format(TALK.format("")) + nod("n"))
    pilot.block("next", nod("n"), **{"bmla:appendAfter": "new"})
    await pilot.advance(4)
    assert pilot.feedback.warnings == SAID
    assert_ended(pilot.feedback, "new", "FAILED")
    assert_time(pilot.feedback, "new:end", 0.5)
    assert_time(pilot.feedback, "next:start", 0.5)
    assert_ended(pilot.feedback, "talk")
    assert pilot.realizer.scheduler.failed == 1
    assert pilot.realizer.scheduler.blocks.alive == ()


async def test_a_block_that_fails_ends_its_playing_behaviors_and_removes_the_others(pilot: RealizerPilot) -> None:
    pilot.block("talk", TALK.format(""))
    gesture = '<gesture id="g" lexeme="BEAT" start="0" end="3"/>'
    pilot.block("new", gesture + nod("late", start="2") + REQUIRED.format(TALK.format(' start="1"')))
    await pilot.advance(4)
    assert pilot.feedback.warnings == SAID
    assert_ended(pilot.feedback, "new", "FAILED")
    for point in ("new:g:relax", "new:g:end", "new:end"):
        assert_time(pilot.feedback, point, 1.0)
    assert_block_around(pilot.feedback, "new")
    assert not pilot.feedback.reached("new:late:start")
    assert not pilot.feedback.reached("new:s:start")


async def test_a_required_parameter_change_of_an_ended_behavior_fails_its_block(pilot: RealizerPilot) -> None:
    pilot.block("talk", TALK.format(""))
    louder = (
        '<bmla:parametervaluechange id="s" target="talk:s" paramId="volume" start="3">'
        '<bmla:trajectory type="instant" targetValue="90"/></bmla:parametervaluechange>'
    )
    pilot.block("new", nod("n", start="2.8") + REQUIRED.format(louder))
    await pilot.advance(4)
    assert pilot.feedback.warnings == SAID
    assert_ended(pilot.feedback, "new", "FAILED")
    assert_time(pilot.feedback, "new:n:end", 3.0)


@pytest.mark.parametrize("composition", ["MERGE", "APPEND"])
async def test_a_required_behavior_tied_to_a_point_that_will_not_happen_fails_its_block_at_once(
    pilot: RealizerPilot, composition: str
) -> None:
    pilot.block("first", '<wait id="w" duration="1"/>')
    pilot.block("old", nod("n"), composition="APPEND")
    required = REQUIRED.format(nod("s", start="old:n:end"))
    pilot.block("new", '<wait id="w" duration="2"/>' + required, composition=composition)
    pilot.block("third", nod("n", start="new:w:end") + '<wait id="w" duration="1"/>')
    await pilot.advance(0.5)
    pilot.block("stop", '<bmla:interrupt id="i" target="old"/>')
    await pilot.advance(3)
    assert_ended(pilot.feedback, "new", "FAILED")
    assert_time(pilot.feedback, "new:end", 0.5)
    assert pilot.feedback.warnings == [*SAID, ("third:n", "IMPOSSIBLE_TO_SCHEDULE")]
    # If it never started, its dependents have no times.
    assert pilot.feedback.reached("new:start") == pilot.feedback.reached("third:n:start") == (composition == "MERGE")


async def test_a_required_tie_that_is_late_fails_its_block_before_it_plays(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 5.0)
    pilot.block("long", '<wait id="w" duration="3"/>')
    required = REQUIRED.format(nod("s", end=HIT))
    pilot.block("new", nod("n") + required, composition="APPEND", **{"bmla:onStart": "asleep"})
    pilot.block("asleep", **{"bmla:preplan": "true"})
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 1.0)
    await pilot.advance(3)
    assert pilot.feedback.warnings == SAID
    assert [id_ for id_ in pilot.feedback.progress if id_.startswith(("new", "asleep"))] == ["new:end"]
    assert_ended(pilot.feedback, "new", "FAILED")


async def test_a_required_behavior_that_fails_while_it_plays_fails_its_block(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    pilot.block("new", REQUIRED.format(TALK.format("")) + '<wait id="n" duration="3"/>')
    await pilot.advance(0.5)
    engine = next(
        each
        for each in pilot.realizer.characters["alice"].engines
        if isinstance(each, DefaultEngine) and each.player.playing
    )
    monkeypatch.setattr(engine, "audio", lambda tick: 1 / 0)
    engine.player.note(engine.player.playing[0])
    await pilot.tick()
    assert pilot.feedback.warnings == [("new:s", "EXECUTION_FAILURE")]
    assert_ended(pilot.feedback, "new", "FAILED")
    ends = Counter(id_ for id_ in pilot.feedback.progress if id_.endswith(":end"))
    assert ends == {"new:s:end": 1, "new:n:end": 1, "new:end": 1}


@pytest.mark.parametrize("required", [True, False])
async def test_a_required_activation_of_an_unknown_block_fails_its_block(pilot: RealizerPilot, required: bool) -> None:
    activate = '<bmla:activate id="s" target="nobody" start="0.5"/>'
    pilot.block("new", '<wait id="w" duration="2"/>' + (REQUIRED.format(activate) if required else activate))
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("new:s", "NO_SUCH_TARGET")]
    assert_ended(pilot.feedback, "new", "FAILED" if required else "DONE")
    assert_time(pilot.feedback, "new:w:end", 0.5 if required else 2.0)


async def test_blocks_that_fail_each_other_end_once_each(pilot: RealizerPilot) -> None:
    pilot.block("old", nod("n", start=HIT))
    for name, on in (("a", "old"), ("b", "a"), ("c", "b")):
        pilot.block(name, REQUIRED.format(nod("n", start=f"{on}:n:end")) + '<wait id="w" duration="9"/>')
    await pilot.advance(0.5)
    pilot.block("stop", composition="MERGE", **{"bmla:interrupt": "old"})
    await pilot.tick()
    assert sorted(pilot.feedback.warnings) == [(f"{name}:n", "IMPOSSIBLE_TO_SCHEDULE") for name in "abc"]
    assert [pilot.feedback.status(name) for name in ("old", "a", "b", "c")] == ["INTERRUPTED", *["FAILED"] * 3]


async def test_an_interrupted_or_replaced_required_behavior_does_not_fail_its_block(pilot: RealizerPilot) -> None:
    beat = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>'
    pilot.block("old", REQUIRED.format(TALK.format("") + beat) + nod("n", start="0", end="2"))
    pilot.block("new", beat, **{"bmla:chunkAfter": "old"})
    pilot.block("stop", '<bmla:interrupt id="i" target="old" include="s" start="0.5"/>')
    await pilot.advance(6)
    assert pilot.feedback.warnings == []
    assert_ended(pilot.feedback, "old")
    assert_ended(pilot.feedback, "new")
