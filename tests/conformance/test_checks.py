"""The checks that are derived from a script pass on correct feedback and fail on wrong feedback."""

import re
from collections.abc import Iterator

import pytest

from reactive_realizer.bml.document import parse
from reactive_realizer.conformance.case import ConformanceCase, read_case, read_suite
from reactive_realizer.conformance.derive import checks_of
from reactive_realizer.conformance.suite import TOLERANCE
from reactive_realizer.limits import Limits
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import block, open_pilot

Told = list[tuple[float, str]]

SCRIPT = block(
    "b",
    """
    <speech id="s" start="0.3"><text>One <sync id="m"/>two three.</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="s:m+0.1"/>
    <wait id="w" duration="0.5" start="0.2"/>
    <head id="h" lexeme="NOD"/>
    <constraint><synchronize><sync ref="h:start"/><sync ref="s:end"/></synchronize></constraint>
    """,
)


def case_of(script: str, rest: str = "") -> ConformanceCase:
    return read_case("own", f'<case title="It is so"><send>{script}</send>{rest}</case>'.encode())


def problems(case: ConformanceCase, told: Told) -> list[str]:
    feedback = FeedbackList()
    for time, xml in told:
        feedback.add(time, xml)
    return [problem for check in checks_of(case) if (problem := check.problem(feedback, TOLERANCE))]


async def played(script: str) -> Told:
    async with open_pilot() as pilot:
        pilot.perform(script)
        await pilot.advance(6)
        return [(line.time, xml) for line, xml in zip(pilot.feedback.messages, pilot.feedback.raw, strict=True)]


def progress(told: Told) -> Iterator[int]:
    return (number for number, (_, xml) in enumerate(told) if "Progress " in xml and ':relax"' not in xml[:200])


async def test_feedback_that_follows_the_script_has_no_problem() -> None:
    assert problems(case_of(SCRIPT), await played(SCRIPT)) == []


def test_what_follows_in_a_case_is_a_part_of_its_own() -> None:
    first, second = case_of(block("b", ""), f"<then><send>{block('b', '')}</send></then>").parts
    assert [part.blocks[0].id for part in (first, second)] == ["b", "b"]
    assert (first.title, second.title) == ("It is so", "It is so")


async def test_a_wait_may_end_at_its_limit() -> None:
    wait, nod = '<wait id="w" end="c:n:start" max-wait="1"/>', '<head id="n" lexeme="NOD" start="3"/>'
    script = block("b", wait) + block("c", nod)
    assert problems(case_of(script), await played(script)) == []


async def test_missing_progress_is_reported() -> None:
    told = await played(SCRIPT)
    for number in progress(told):
        assert problems(case_of(SCRIPT), told[:number] + told[number + 1 :]), told[number]


async def test_repeated_progress_is_reported() -> None:
    told = await played(SCRIPT)
    for number in progress(told):
        assert problems(case_of(SCRIPT), [*told[: number + 1], *told[number:]]), told[number]


@pytest.mark.parametrize(
    ("point", "source"),
    [
        ("b:s:start", 'start="0.3"'),
        ("b:s:m", 'stroke="s:m+0.1"'),
        ("b:g:stroke", 'stroke="s:m+0.1"'),
        ("b:w:end", 'duration="0.5"'),
        ("b:h:start", "synchronize h:start, s:end"),
        ("b:end", "the last prediction"),
    ],
)
async def test_a_late_sync_point_is_reported_with_the_constraint_that_it_breaks(point: str, source: str) -> None:
    def late(xml: str) -> str:
        if f'id="{point}"' not in xml:
            return xml
        return re.sub(r'globalTime="([^"]*)"', lambda found: f'globalTime="{float(found[1]) + 0.02}"', xml)

    found = problems(case_of(SCRIPT), [(time, late(xml)) for time, xml in await played(SCRIPT)])
    assert any(source in problem for problem in found), found


def moved(xml: str, attribute: str, seconds: float) -> str:
    """A message in which the times of one attribute are later."""
    return re.sub(f' ({attribute})="([0-9.]*)"', lambda found: f' {found[1]}="{float(found[2]) + seconds}"', xml)


@pytest.mark.parametrize(
    ("attribute", "missed"),
    [
        ("globalStart", "b:start"),
        ("globalEnd", "b:end"),
        ("start", "b:w:start"),
        ("stroke", "b:g:stroke"),
        ("relax", "b:h:relax"),
        ("end", "b:s:end"),
        (r"\w+:time", "b:s:m"),
    ],
)
async def test_a_wrong_prediction_is_reported(attribute: str, missed: str) -> None:
    told = [
        (at, moved(xml, attribute, 0.02) if "<predictionFeedback" in xml else xml) for at, xml in await played(SCRIPT)
    ]
    found = problems(case_of(SCRIPT), told)
    assert any(f"{missed} was reached" in each and "the last prediction before it" in each for each in found), found


async def test_a_prediction_that_comes_after_the_progress_does_not_count() -> None:
    told = await played(SCRIPT)
    late = sorted(told, key=lambda line: "<predictionFeedback" in line[1])
    assert "nothing was predicted of b before b:start was reported (the last prediction before it)" in problems(
        case_of(SCRIPT), late
    )


async def test_a_missing_prediction_is_reported() -> None:
    told = [(at, re.sub(r"<(\w+:)?head .*?/>", "", xml)) for at, xml in await played(SCRIPT)]
    assert problems(case_of(SCRIPT), told) == ["b:h:start was not predicted (the last prediction before it)"]


def waiting(id_: str, attribute: str = "composition", value: str = "MERGE") -> str:
    """A block that waits half a second once it has started."""
    return block(id_, '<wait id="w" start="0.1" duration="0.5"/>', **{attribute: value})


async def test_the_time_of_progress_is_relative_to_the_start_of_its_block() -> None:
    script = waiting("a") + waiting("b", "composition", "APPEND")
    told = await played(script)
    wrong = [(at, moved(xml, "time", 0.5) if "syncPointProgress" in xml else xml) for at, xml in told]
    assert any(
        "b:w:start was reported with the time 0.6 but 0.1 s" in each for each in problems(case_of(script), wrong)
    )


RETRACTING = block("a", '<gesture id="g" lexeme="BEAT"/><wait id="w" duration="0.2"/>')
PREPARED = waiting("b", "bmla:preplan", "true")


@pytest.mark.parametrize("seconds", [-0.02, 0.02])
@pytest.mark.parametrize(
    ("script", "last"),
    [
        (waiting("a") + waiting("b", "composition", "APPEND"), "a:end"),
        (waiting("a") + waiting("b", "bmla:appendAfter", "a"), "a:end"),
        (waiting("b", "composition", "APPEND") + waiting("a", "bmla:prependBefore", "b"), "a:end"),
        (RETRACTING + waiting("b", "bmla:chunkAfter", "a"), "a:g:relax"),
        (PREPARED + waiting("a", "bmla:onStart", "b"), "a:start"),
        (PREPARED + block("a", '<bmla:activate id="i" target="b" start="0.5"/>'), "a:i:start"),
    ],
)
async def test_a_waiting_block_starts_when_the_last_of_its_predecessors_is_over(
    script: str, last: str, seconds: float
) -> None:
    told = await played(script)
    assert problems(case_of(script), told) == []

    def shifted(xml: str) -> str:
        return moved(xml, "global(?:Start|Time|End)", seconds) if ' id="b' in xml else xml

    found = problems(case_of(script), [(at, shifted(xml)) for at, xml in told])
    assert any(f"b:start was reached {seconds:.2f} s after {last} instead of 0.00 s" in each for each in found), found


@pytest.mark.parametrize(
    ("constraint", "holds"),
    [
        ('<after ref="w:end"><sync ref="h:start"/></after>', True),
        ('<after ref="w:end+0.05"><sync ref="h:start"/></after>', False),
        ('<after ref="w:end"><sync ref="h:start-0.05"/></after>', False),
        ('<before ref="w:end"><sync ref="h:start"/></before>', True),
        ('<before ref="w:end-0.05"><sync ref="h:start"/></before>', False),
        ('<before ref="h:end"><sync ref="w:start"/><sync ref="h:stroke"/></before>', True),
        ('<synchronize><sync ref="h:start+0.1"/><sync ref="w:end+0.1"/></synchronize>', True),
        ('<synchronize><sync ref="h:start"/><sync ref="0.4"/></synchronize>', True),
        ('<synchronize><sync ref="0.45"/><sync ref="h:start"/></synchronize>', False),
    ],
)
async def test_constraints_are_checked_against_the_reported_times(constraint: str, holds: bool) -> None:
    own = '<wait id="w" duration="0.4"/><head id="h" lexeme="NOD" start="w:end"/>'
    told = await played(block("b", own))
    found = problems(case_of(block("b", f"{own}<constraint>{constraint}</constraint>")), told)
    assert (found == []) == holds, found


async def test_unexpected_and_missing_warnings_are_reported() -> None:
    script = block("b", '<gaze id="g" target="nobody"/>')
    warned = '<warning id="b:g" type="NO_SUCH_TARGET"/>'
    told = await played(script)
    assert problems(case_of(script, warned), told) == []
    assert any("a warning of b:g NO_SUCH_TARGET" in problem for problem in problems(case_of(script), told))
    without = [line for line in told if "warningFeedback" not in line[1]]
    assert problems(case_of(script, warned), without) == [
        "no warning of b:g (warnings)",
        "no warning of b:g NO_SUCH_TARGET (warnings)",
    ]


def test_every_case_of_the_suite_has_a_title_blocks_and_checks(subtests: pytest.Subtests) -> None:
    for case in read_suite():
        with subtests.test(case.name):
            assert case.title[0].isupper()
            ids = [parsed.block.id for send in case.sends for parsed in parse(send.xml, Limits()) if parsed.block]
            assert ids or case.warnings
            assert set(case.ends) <= set(ids)
            assert len(list(checks_of(case))) > 1


def test_every_block_of_the_suite_has_a_different_id() -> None:
    ids = [block.id for case in read_suite() for block in case.blocks]
    assert len(set(ids)) == len(ids)
