"""When a change of a parameter starts and ends, and what that means for others."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .parameter_changes import HEAD, SPEECH, change, points


def nod(ref: str) -> str:
    return f'<head id="n" lexeme="NOD" start="{ref}+0.2"/>'


async def test_in_the_older_form_the_end_may_be_tied_in_place_of_the_stroke(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:m" end="s:m+1"', space="bmlt"))
    await pilot.advance(4)
    mark = pilot.feedback.time("b:s:m")
    assert points(pilot, "b:p") == [("start", mark), ("stroke", mark + 1), ("end", mark + 1)]


async def test_in_the_older_form_stroke_is_another_name_of_the_end(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:m" stroke="s:m+1"', space="bmlt"))
    await pilot.advance(4)
    mark = pilot.feedback.time("b:s:m")
    assert points(pilot, "b:p") == [("start", mark), ("stroke", mark + 1), ("end", mark + 1)]


async def test_in_the_newer_form_there_are_start_and_end(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="s:start" end="s:end"', initialValue=0))
    await pilot.advance(6)
    assert points(pilot, "b:p") == [("start", 0.0), ("end", pilot.feedback.time("b:s:end"))]
    assert pilot.feedback.warnings == []


async def test_a_change_of_which_nobody_says_how_long_it_takes_takes_half_a_second(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="0.25"'))
    await pilot.advance(2)
    assert points(pilot, "b:p") == [("start", 0.25), ("end", 0.75)]


@pytest.mark.parametrize(("kind", "takes"), [("linear", 0.5), ("instant", 0.0)])
@pytest.mark.parametrize("point", ["end", "stroke", "start"])
async def test_who_hangs_on_it_comes_when_it_has_taken_its_half_second_or_at_once(
    pilot: RealizerPilot, kind: str, takes: float, point: str
) -> None:
    space = "bmlt" if point == "stroke" else "bmla"
    pilot.block("b", SPEECH + change("p", 'start="s:start+1"', target="s", space=space, type=kind) + nod(f"p:{point}"))
    await pilot.advance(5)
    assert pilot.feedback.time("b:p:start") == 1.0
    assert pilot.feedback.time("b:p:end") == 1.0 + takes
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.2 + (0.0 if point == "start" else takes))
    assert pilot.feedback.warnings == []


async def test_that_holds_also_where_nothing_says_when_it_starts(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", "", target="s") + nod("p:end"))
    await pilot.advance(5)
    assert points(pilot, "b:p") == [("start", 0.0), ("end", 0.5)]
    assert pilot.feedback.time("b:n:start") == 0.7
    assert pilot.feedback.warnings == []


async def test_what_comes_after_its_end_waits_for_that(pilot: RealizerPilot) -> None:
    after = '<constraint><after ref="p:end"><sync ref="n:start"/></after></constraint>'
    pilot.block("b", SPEECH + change("p", 'start="1"', target="s") + '<head id="n" lexeme="NOD"/>' + after)
    await pilot.advance(5)
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("b:p:end") == 1.5
    assert pilot.feedback.warnings == []


async def test_who_hangs_on_it_follows_it_when_it_moves(pilot: RealizerPilot) -> None:
    pilot.predict("user", "starts", 3.0)
    pilot.block("b", SPEECH + change("p", 'start="anticipators:user:starts"', target="s") + nod("p:end"))
    await pilot.advance(0.5)
    pilot.predict("user", "starts", 1.0)
    await pilot.advance(4)
    assert pilot.feedback.time("b:p:end") == 1.5
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.7)
    assert pilot.feedback.warnings == []


async def test_it_shares_the_time_with_who_hangs_on_it_and_has_to_end_somewhere(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", SPEECH + change("p", 'start="1"', target="s") + '<head id="n" lexeme="NOD" start="p:end" end="3"/>'
    )
    await pilot.advance(5)
    assert pilot.feedback.time("b:n:end") == 3.0
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("b:p:end") > 1.0
    assert pilot.feedback.warnings == []


async def test_it_moves_nothing(pilot: RealizerPilot) -> None:
    pilot.block("b", HEAD.format(0.5) + SPEECH + change("p", 'start="h:stroke:2" end="s:m"', target="s"))
    await pilot.advance(6)
    assert pilot.feedback.time("b:h:end") == 4.0
    assert pilot.feedback.time("b:s:start") == 0.0


async def test_a_target_that_ends_first_ends_it_without_a_warning(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="1" end="60"'))
    await pilot.advance(6)
    assert points(pilot, "b:p") == [("start", 1.0), ("end", pilot.feedback.time("b:s:end"))]
    assert pilot.feedback.time("b:end") == pilot.feedback.time("b:s:end")
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_target_that_is_interrupted_ends_it_then(pilot: RealizerPilot) -> None:
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
