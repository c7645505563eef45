"""The times of parameter changes, and of behaviors that depend on them."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .parameter_changes import HEAD, SPEECH, change, points


def nod(ref: str) -> str:
    return f'<head id="n" lexeme="NOD" start="{ref}+0.2"/>'


async def test_in_bmlt_the_end_may_be_tied_instead_of_the_stroke(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:m" end="s:m+1"', space="bmlt"))
    await pilot.advance(4)
    mark = pilot.feedback.time("b:s:m")
    assert points(pilot, "b:p") == [("start", mark), ("stroke", mark + 1), ("end", mark + 1)]


async def test_in_bmlt_the_stroke_is_the_end(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:m" stroke="s:m+1"', space="bmlt"))
    await pilot.advance(4)
    mark = pilot.feedback.time("b:s:m")
    assert points(pilot, "b:p") == [("start", mark), ("stroke", mark + 1), ("end", mark + 1)]


async def test_in_bmla_a_change_has_start_and_end(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:start" end="s:end"', initialValue=0))
    await pilot.advance(6)
    assert points(pilot, "b:p") == [("start", 0.0), ("end", pilot.feedback.time("b:s:end"))]
    assert pilot.feedback.warnings == []


async def test_a_change_without_a_duration_takes_half_a_second(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="0.25"'))
    await pilot.advance(2)
    assert points(pilot, "b:p") == [("start", 0.25), ("end", 0.75)]


@pytest.mark.parametrize(("kind", "takes"), [("linear", 0.5), ("instant", 0.0)])
@pytest.mark.parametrize("point", ["end", "stroke", "start"])
async def test_dependents_of_a_change_follow_its_preferred_duration(
    pilot: RealizerPilot, kind: str, takes: float, point: str
) -> None:
    space = "bmlt" if point == "stroke" else "bmla"
    pilot.block("b", SPEECH + change("p", 'start="s:start+1"', target="s", space=space, type=kind) + nod(f"p:{point}"))
    await pilot.advance(5)
    assert pilot.feedback.time("b:p:start") == 1.0
    assert pilot.feedback.time("b:p:end") == 1.0 + takes
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.2 + (0.0 if point == "start" else takes))
    assert pilot.feedback.warnings == []


async def test_dependents_of_a_change_without_a_start_time_follow_its_preferred_duration(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", "", target="s") + nod("p:end"))
    await pilot.advance(5)
    assert points(pilot, "b:p") == [("start", 0.0), ("end", 0.5)]
    assert pilot.feedback.time("b:n:start") == 0.7
    assert pilot.feedback.warnings == []


async def test_an_after_constraint_on_the_end_of_a_change_holds(pilot: RealizerPilot) -> None:
    after = '<constraint><after ref="p:end"><sync ref="n:start"/></after></constraint>'
    pilot.block("b", SPEECH + change("p", 'start="1"', target="s") + '<head id="n" lexeme="NOD"/>' + after)
    await pilot.advance(5)
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("b:p:end") == 1.5
    assert pilot.feedback.warnings == []


async def test_dependents_of_a_change_follow_when_it_moves(pilot: RealizerPilot) -> None:
    pilot.predict("user", "starts", 3.0)
    pilot.block("b", SPEECH + change("p", 'start="anticipators:user:starts"', target="s") + nod("p:end"))
    await pilot.advance(0.5)
    pilot.predict("user", "starts", 1.0)
    await pilot.advance(4)
    assert pilot.feedback.time("b:p:end") == 1.5
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.7)
    assert pilot.feedback.warnings == []


async def test_a_change_shares_the_available_time_with_a_dependent_that_has_a_fixed_end(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", SPEECH + change("p", 'start="1"', target="s") + '<head id="n" lexeme="NOD" start="p:end" end="3"/>'
    )
    await pilot.advance(5)
    assert pilot.feedback.time("b:n:end") == 3.0
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("b:p:end") > 1.0
    assert pilot.feedback.warnings == []


async def test_a_change_does_not_move_other_behaviors(pilot: RealizerPilot) -> None:
    pilot.block("b", HEAD.format(0.5) + SPEECH + change("p", 'start="h:stroke:2" end="s:m"', target="s"))
    await pilot.advance(6)
    assert pilot.feedback.time("b:h:end") == 4.0
    assert pilot.feedback.time("b:s:start") == 0.0


async def test_a_change_ends_with_its_target_without_a_warning(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="1" end="60"'))
    await pilot.advance(6)
    assert points(pilot, "b:p") == [("start", 1.0), ("end", pilot.feedback.time("b:s:end"))]
    assert pilot.feedback.time("b:end") == pilot.feedback.time("b:s:end")
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_change_ends_when_its_target_is_interrupted(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH)
    pilot.block("c", change("p", 'start="0" end="60"'))
    await pilot.advance(1)
    pilot.block("i", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(1)
    assert points(pilot, "c:p")[-1] == ("end", 1.0)
    assert pilot.feedback.status("c") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_change_may_wait_for_a_prediction(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="anticipators:user:starts" end="s:end"'))
    await pilot.advance(1)
    pilot.predict("user", "starts", 1.5)
    await pilot.advance(4)
    assert pilot.feedback.time("b:p:start") == 1.5


async def test_a_change_that_ends_with_a_speech_of_unknown_time_is_not_dropped(pilot: RealizerPilot) -> None:
    speech = '<speech id="s" start="anticipators:t:hit"><text>one two three</text></speech>'
    pilot.block("b", speech + change("p", 'end="s:end"'))
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 1.0)
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:p:end") == pilot.feedback.time("b:s:end")
