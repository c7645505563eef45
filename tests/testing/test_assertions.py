"""Each assertion holds of what is so, and says what is not."""

from collections.abc import Callable

import pytest

from reactive_realizer.testing import assertions
from reactive_realizer.testing.feedback_list import FeedbackList

BMLA = "http://www.asap-project.org/bmla"


def progress(id_: str, time: float, more: str = "") -> str:
    kind = "syncPointProgress" if id_.count(":") > 1 else "blockProgress"
    return f'<{kind} id="{id_}" time="{time - 1}" globalTime="{time}" {more}/>'


GOOD = [
    '<predictionFeedback><bml id="b" globalStart="1" globalEnd="3"/>'
    '<wait id="b:w" start="0.5" end="1"/></predictionFeedback>',
    progress("b:start", 1),
    progress("b:w:start", 1.5),
    progress("b:h:start", 1.5),
    progress("b:w:end", 2),
    progress("b:h:end", 3),
    progress("b:end", 3, f'xmlns:bmla="{BMLA}" bmla:status="DONE"'),
    '<warningFeedback id="b:x" type="NO_SUCH_TARGET">nobody</warningFeedback>',
    progress("c:start", 3),
]


def told(*lines: str) -> FeedbackList:
    feedback = FeedbackList()
    for line in lines:
        feedback.add(0.0, line)
    return feedback


Assertion = Callable[[FeedbackList], None]

HOLD: list[Assertion] = [
    assertions.assert_told_once,
    lambda told: assertions.assert_syncs_in_order(told, "b:w", "start", "end"),
    lambda told: assertions.assert_block_around(told, "b"),
    lambda told: assertions.assert_ended(told, "b"),
    lambda told: assertions.assert_time(told, "b:w:end", 2.0005),
    lambda told: assertions.assert_relative_time(told, "b:w:end", 1),
    lambda told: assertions.assert_linked(told, "b:w:start", "b:h:start"),
    lambda told: assertions.assert_linked(told, "b:h:end", "b:w:end", 1),
    lambda told: assertions.assert_order(told, "b:w:start", "b:h:start"),
    lambda told: assertions.assert_order(told, "b:w:start", "b:h:end", 1.5),
    lambda told: assertions.assert_warnings(told, ("b:x", "NO_SUCH_TARGET")),
    lambda told: assertions.assert_not_played(told, "b:x"),
    lambda told: assertions.assert_predicted(told, "b:end"),
    lambda told: assertions.assert_predicted(told, "b:w:start"),
    lambda told: assertions.assert_all_predicted(told, "b:w"),
    lambda told: assertions.assert_block_times(told, "b"),
    lambda told: assertions.assert_starts_with_last(told, "c", ["b:w:end", "b:end"]),
]


@pytest.mark.parametrize("assertion", HOLD)
def test_what_is_so_holds(assertion: Assertion) -> None:
    assertion(told(*GOOD))


@pytest.mark.parametrize(
    ("assertion", "message"),
    [
        (
            lambda told: assertions.assert_syncs_in_order(told, "b:w", "start", "m", "end"),
            "b:w reached start, end where",
        ),
        (lambda told: assertions.assert_syncs_in_order(told, "b:x", "start"), "b:x reached nothing where start"),
        (lambda told: assertions.assert_ended(told, "b", "INTERRUPTED"), "b ended DONE where INTERRUPTED was to come"),
        (
            lambda told: assertions.assert_time(told, "b:w:end", 2.1),
            "b:w:end was reached at 2 s where 2.1 s was to come",
        ),
        (lambda told: assertions.assert_time(told, "b:x:end", 2), "b:x:end was reported 0 times"),
        (lambda told: assertions.assert_relative_time(told, "b:w:end", 2), "1 s after b:start where 2 s"),
        (lambda told: assertions.assert_linked(told, "b:h:end", "b:w:end"), "b:h:end was reached 1 s after b:w:end"),
        (lambda told: assertions.assert_order(told, "b:h:end", "b:w:end"), "b:w:end was reached -1 s after b:h:end"),
        (lambda told: assertions.assert_order(told, "b:w:end", "b:h:end", 1.1), "at least 1.1 s"),
        (lambda told: assertions.assert_warnings(told), "a warning of b:x NO_SUCH_TARGET"),
        (lambda told: assertions.assert_warnings(told, ("b:x", "A"), ("b:x", "NO_SUCH_TARGET")), "no warning of b:x A"),
        (lambda told: assertions.assert_not_played(told, "b:w"), "b:w reached b:w:start"),
        (lambda told: assertions.assert_predicted(told, "c:start"), "nothing was predicted of c before c:start"),
        (lambda told: assertions.assert_all_predicted(told, "b:h"), "b:h:start was not predicted"),
        (lambda told: assertions.assert_starts_with_last(told, "c", ["b:w:end"]), "c:start was reached 1 s after b:w"),
        (lambda told: assertions.assert_starts_with_last(told, "b", ["b:start", "b:end"]), "b:start was reached -2 s"),
    ],
)
def test_what_is_not_so_is_said(assertion: Assertion, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        assertion(told(*GOOD))


def test_what_is_told_twice_is_named() -> None:
    with pytest.raises(AssertionError, match="told more than once: b:w:end"):
        assertions.assert_told_once(told(*GOOD, GOOD[4]))


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([GOOD[2], *GOOD[1:2], *GOOD[3:]], "b:w:start was told before b:start"),
        ([*GOOD[1:5], GOOD[6], GOOD[5]], "b:h:end was told after b:end"),
        (GOOD[2:], "b:start was reported 0 times"),
        (GOOD[:6], "b:end was reported 0 times"),
    ],
)
def test_what_is_told_outside_of_its_block_is_named(lines: list[str], message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        assertions.assert_block_around(told(*lines), "b")


PREDICTED = (
    '<predictionFeedback xmlns:own="urn:reactive-realizer:1"><bml id="b" globalStart="1" globalEnd="3"/>'
    '<speech id="b:s" start="0"{}><text>one <sync id="m" own:time="{}"/>two</text></speech></predictionFeedback>'
)
REACHED = [progress("b:s:start", 1), progress("b:s:m", 1.5), progress("b:s:n", 1.7), progress("b:s:end", 3)]


def test_of_a_behavior_its_start_its_end_and_what_else_was_predicted_has_to_come_true() -> None:
    whole = PREDICTED.format(' end="2"', 0.5)
    assertions.assert_all_predicted(told(whole, *REACHED), "b:s")
    with pytest.raises(AssertionError, match=r"b:s:m was reached at 1.5 s where 1.6 s was to come"):
        assertions.assert_all_predicted(told(PREDICTED.format(' end="2"', 0.6), *REACHED), "b:s")
    with pytest.raises(AssertionError, match="b:s:end was not predicted"):
        assertions.assert_all_predicted(told(PREDICTED.format("", 0.5), *REACHED), "b:s")


def test_a_prediction_is_held_against_what_is_told_after_it_and_the_last_one_counts() -> None:
    wrong, right = PREDICTED.format(' end="2.5"', 0.5), PREDICTED.format(' end="2"', 0.5)
    assertions.assert_predicted(told(wrong, *REACHED[:3], right, REACHED[3]), "b:s:end")
    assertions.assert_predicted(told(right, *REACHED, wrong), "b:s:end")
    with pytest.raises(AssertionError, match=r"b:s:end was reached at 3 s where 3.5 s was to come"):
        assertions.assert_predicted(told(right, wrong, *REACHED), "b:s:end")


@pytest.mark.parametrize("time", ["", 'time="77"'])
def test_a_time_that_is_not_that_since_the_start_of_the_block_is_named(time: str) -> None:
    wrong = f'<syncPointProgress id="b:w:start" globalTime="1.5" {time}/>'
    with pytest.raises(AssertionError, match=r"b:w:start was told with the time \w+ where 0.5 s had passed"):
        assertions.assert_block_times(told(GOOD[1], wrong), "b")
