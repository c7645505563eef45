"""Assertions about feedback: each passes on good feedback, and fails with a message on bad feedback."""

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


def feedback_of(*lines: str) -> FeedbackList:
    feedback = FeedbackList()
    for line in lines:
        feedback.add(0.0, line)
    return feedback


Assertion = Callable[[FeedbackList], None]

HOLD: list[Assertion] = [
    assertions.assert_reported_once,
    lambda feedback: assertions.assert_syncs_in_order(feedback, "b:w", "start", "end"),
    lambda feedback: assertions.assert_block_around(feedback, "b"),
    lambda feedback: assertions.assert_ended(feedback, "b"),
    lambda feedback: assertions.assert_time(feedback, "b:w:end", 2.0005),
    lambda feedback: assertions.assert_relative_time(feedback, "b:w:end", 1),
    lambda feedback: assertions.assert_linked(feedback, "b:w:start", "b:h:start"),
    lambda feedback: assertions.assert_linked(feedback, "b:h:end", "b:w:end", 1),
    lambda feedback: assertions.assert_order(feedback, "b:w:start", "b:h:start"),
    lambda feedback: assertions.assert_order(feedback, "b:w:start", "b:h:end", 1.5),
    lambda feedback: assertions.assert_warnings(feedback, ("b:x", "NO_SUCH_TARGET")),
    lambda feedback: assertions.assert_not_played(feedback, "b:x"),
    lambda feedback: assertions.assert_predicted(feedback, "b:end"),
    lambda feedback: assertions.assert_predicted(feedback, "b:w:start"),
    lambda feedback: assertions.assert_all_predicted(feedback, "b:w"),
    lambda feedback: assertions.assert_block_times(feedback, "b"),
    lambda feedback: assertions.assert_starts_with_last(feedback, "c", ["b:w:end", "b:end"]),
]


def test_every_assertion_passes_on_good_feedback() -> None:
    feedback = feedback_of(*GOOD)
    for assertion in HOLD:
        assertion(feedback)


@pytest.mark.parametrize(
    ("assertion", "message"),
    [
        (
            lambda feedback: assertions.assert_syncs_in_order(feedback, "b:w", "start", "m", "end"),
            "b:w reached start, end instead of start, m, end",
        ),
        (
            lambda feedback: assertions.assert_syncs_in_order(feedback, "b:x", "start"),
            "b:x reached nothing instead of start",
        ),
        (lambda feedback: assertions.assert_ended(feedback, "b", "INTERRUPTED"), "b ended DONE instead of INTERRUPTED"),
        (
            lambda feedback: assertions.assert_time(feedback, "b:w:end", 2.1),
            "b:w:end was reached at 2.00 s instead of 2.10 s",
        ),
        (lambda feedback: assertions.assert_time(feedback, "b:x:end", 2), "b:x:end was reported 0 times"),
        (
            lambda feedback: assertions.assert_relative_time(feedback, "b:w:end", 2),
            "1.00 s after b:start instead of 2.00 s",
        ),
        (
            lambda feedback: assertions.assert_time(feedback, "b:w:end", 2.00004, 0.0),
            "at 2.00000 s instead of 2.00004 s",
        ),
        (
            lambda feedback: assertions.assert_linked(feedback, "b:h:end", "b:w:end"),
            "b:h:end was reached 1.00 s after b:w:end",
        ),
        (
            lambda feedback: assertions.assert_order(feedback, "b:h:end", "b:w:end"),
            "b:w:end was reached -1.00 s after b:h:end",
        ),
        (lambda feedback: assertions.assert_order(feedback, "b:w:end", "b:h:end", 1.1), "at least 1.10 s"),
        (lambda feedback: assertions.assert_warnings(feedback), "a warning of b:x NO_SUCH_TARGET"),
        (
            lambda feedback: assertions.assert_warnings(feedback, ("b:x", "A"), ("b:x", "NO_SUCH_TARGET")),
            "no warning of b:x A",
        ),
        (lambda feedback: assertions.assert_not_played(feedback, "b:w"), "b:w reached b:w:start"),
        (
            lambda feedback: assertions.assert_predicted(feedback, "c:start"),
            "nothing was predicted of c before c:start",
        ),
        (lambda feedback: assertions.assert_all_predicted(feedback, "b:h"), "b:h:start was not predicted"),
        (
            lambda feedback: assertions.assert_starts_with_last(feedback, "c", ["b:w:end"]),
            "c:start was reached 1.00 s after b:w",
        ),
        (
            lambda feedback: assertions.assert_starts_with_last(feedback, "b", ["b:start", "b:end"]),
            "b:start was reached -2.00 s",
        ),
    ],
)
def test_a_failed_assertion_says_what_was_reported(assertion: Assertion, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        assertion(feedback_of(*GOOD))


def test_progress_that_is_reported_twice_is_named() -> None:
    with pytest.raises(AssertionError, match="reported more than once: b:w:end"):
        assertions.assert_reported_once(feedback_of(*GOOD, GOOD[4]))


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([GOOD[2], *GOOD[1:2], *GOOD[3:]], "b:w:start was reported before b:start"),
        ([*GOOD[1:5], GOOD[6], GOOD[5]], "b:h:end was reported after b:end"),
        (GOOD[2:], "b:start was reported 0 times"),
        (GOOD[:6], "b:end was reported 0 times"),
    ],
)
def test_progress_outside_of_its_block_is_named(lines: list[str], message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        assertions.assert_block_around(feedback_of(*lines), "b")


PREDICTED = (
    '<predictionFeedback xmlns:own="urn:reactive-realizer:1"><bml id="b" globalStart="1" globalEnd="3"/>'
    '<speech id="b:s" start="0"{}><text>one <sync id="m" own:time="{}"/>two</text></speech></predictionFeedback>'
)
REACHED = [progress("b:s:start", 1), progress("b:s:m", 1.5), progress("b:s:n", 1.7), progress("b:s:end", 3)]


def test_the_start_the_end_and_the_other_predicted_points_of_a_behavior_are_checked() -> None:
    whole = PREDICTED.format(' end="2"', 0.5)
    assertions.assert_all_predicted(feedback_of(whole, *REACHED), "b:s")
    with pytest.raises(AssertionError, match=r"b:s:m was reached at 1.50 s instead of 1.60 s"):
        assertions.assert_all_predicted(feedback_of(PREDICTED.format(' end="2"', 0.6), *REACHED), "b:s")
    with pytest.raises(AssertionError, match="b:s:end was not predicted"):
        assertions.assert_all_predicted(feedback_of(PREDICTED.format("", 0.5), *REACHED), "b:s")


def test_a_point_is_compared_with_the_last_prediction_before_it() -> None:
    wrong, right = PREDICTED.format(' end="2.5"', 0.5), PREDICTED.format(' end="2"', 0.5)
    assertions.assert_predicted(feedback_of(wrong, *REACHED[:3], right, REACHED[3]), "b:s:end")
    assertions.assert_predicted(feedback_of(right, *REACHED, wrong), "b:s:end")
    with pytest.raises(AssertionError, match=r"b:s:end was reached at 3.00 s instead of 3.50 s"):
        assertions.assert_predicted(feedback_of(right, wrong, *REACHED), "b:s:end")


@pytest.mark.parametrize("time", ["", 'time="77"'])
def test_a_time_that_is_not_relative_to_the_start_of_the_block_is_named(time: str) -> None:
    wrong = f'<syncPointProgress id="b:w:start" globalTime="1.5" {time}/>'
    with pytest.raises(AssertionError, match=r"b:w:start was reported with the time \w+ but 0.5 s after"):
        assertions.assert_block_times(feedback_of(GOOD[1], wrong), "b")
