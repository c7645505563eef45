"""Assertions about feedback, after RealizerTester (thesis 9.3).

Ids are those of feedback: ``block:behavior:sync``, ``block:start`` and ``block:end`` for points, ``block:behavior`` for
behaviors. The message of an AssertionError says what was reported instead.
"""

from collections.abc import Iterable
from itertools import pairwise

from reactive_realizer.errors import rounded
from reactive_realizer.testing.feedback_list import FeedbackList

TOLERANCE = 1e-3
"""The largest difference between times that count as equal, s."""

DONE = "DONE"


def assert_reported_once(feedback: FeedbackList) -> None:
    """No progress was reported twice."""
    twice = sorted({id_ for id_ in feedback.progress if feedback.progress.count(id_) > 1})
    assert not twice, f"reported more than once: {', '.join(twice)}"


def assert_syncs_in_order(feedback: FeedbackList, behavior: str, *syncs: str) -> None:
    """A behavior reached exactly these points, each once; reports and times are in this order."""
    reached = [point.removeprefix(f"{behavior}:") for point in _points(feedback, behavior)]
    assert reached == list(syncs), f"{behavior} reached {_listed(reached)} instead of {_listed(syncs)}"
    for earlier, later in pairwise(syncs):
        assert_order(feedback, f"{behavior}:{earlier}", f"{behavior}:{later}")


def assert_block_around(feedback: FeedbackList, block: str) -> None:
    """The start of a block was reported before all points of its behaviors, and its end after them, each once."""
    assert_order(feedback, f"{block}:start", f"{block}:end")
    own = [id_ for id_ in feedback.progress if id_.startswith(f"{block}:") and id_ != f"{block}:relax"]
    assert own[0] == f"{block}:start", f"{own[0]} was reported before {block}:start"
    assert own[-1] == f"{block}:end", f"{own[-1]} was reported after {block}:end"


def assert_ended(feedback: FeedbackList, block: str, status: str = DONE) -> None:
    """A block ended once, with this status."""
    feedback.time(f"{block}:end")
    assert feedback.status(block) == status, f"{block} ended {feedback.status(block)} instead of {status}"


def assert_time(feedback: FeedbackList, point: str, time: float, tolerance: float = TOLERANCE) -> None:
    """A point was reached at a global time, s."""
    reached = feedback.time(point)
    assert abs(reached - time) <= tolerance, (
        f"{point} was reached at {rounded(reached, time)} s instead of {rounded(time, reached)} s"
    )


def assert_linked(
    feedback: FeedbackList, point: str, other: str, offset: float = 0.0, tolerance: float = TOLERANCE
) -> None:
    """A point was reached ``offset`` seconds after another one."""
    distance = feedback.time(point) - feedback.time(other)
    assert abs(distance - offset) <= tolerance, (
        f"{point} was reached {rounded(distance, offset)} s after {other} instead of {rounded(offset, distance)} s"
    )


def assert_relative_time(feedback: FeedbackList, point: str, time: float, tolerance: float = TOLERANCE) -> None:
    """A point was reached ``time`` seconds after the start of its block."""
    assert_linked(feedback, point, f"{point.partition(':')[0]}:start", time, tolerance)


def assert_order(
    feedback: FeedbackList, earlier: str, later: str, distance: float = 0.0, tolerance: float = TOLERANCE
) -> None:
    """A point was reached at least ``distance`` seconds after another one."""
    between = feedback.time(later) - feedback.time(earlier)
    assert between >= distance - tolerance, (
        f"{later} was reached {rounded(between, distance)} s after {earlier} "
        f"instead of at least {rounded(distance, between)} s"
    )


def assert_warnings(feedback: FeedbackList, *warnings: tuple[str, str]) -> None:
    """Exactly these warnings were sent, (id, type) in any order."""
    missing, other = list(warnings), []
    for warning in feedback.warnings:
        if warning in missing:
            missing.remove(warning)
        else:
            other.append(warning)
    assert not missing, f"no warning of {_listed(map(' '.join, missing))}"
    assert not other, f"a warning of {_listed(map(' '.join, other))}"


def assert_warned(feedback: FeedbackList, id_: str) -> None:
    """A warning of any type was sent about a behavior, or about its block or document."""
    block = id_.partition(":")[0]
    names = {id_, block, "", "bml"}
    assert any(warned in names for warned, _ in feedback.warnings), f"no warning of {id_}"


def assert_not_played(feedback: FeedbackList, behavior: str) -> None:
    """No point of a behavior or block was reported except its end."""
    played = [id_ for id_ in feedback.progress if id_.startswith(f"{behavior}:") and id_ != f"{behavior}:end"]
    assert not played, f"{behavior} reached {_listed(played)}"


def assert_predicted(feedback: FeedbackList, point: str, tolerance: float = TOLERANCE) -> None:
    """A point was reached at the time of the last prediction before it; ``block:start`` and ``block:end`` count too."""
    assert_time(feedback, point, feedback.predicted_before(point), tolerance)


def assert_all_predicted(feedback: FeedbackList, behavior: str, tolerance: float = TOLERANCE) -> None:
    """A behavior reached its points at their last predicted times; its start and its end must be predicted."""
    for point in _points(feedback, behavior):
        try:
            assert_predicted(feedback, point, tolerance)
        except LookupError:
            assert point not in (f"{behavior}:start", f"{behavior}:end"), f"{point} was not predicted"


def assert_block_times(feedback: FeedbackList, block: str, tolerance: float = TOLERANCE) -> None:
    """The ``time`` of each reported point of a block is the time since the start of the block."""
    start = feedback.time(f"{block}:start")
    for line in feedback.of("syncPointProgress"):
        if line.id.startswith(f"{block}:"):
            since = float(line.element.get("time", "nan"))
            assert abs(since - (line.global_time - start)) <= tolerance, (
                f"{line.id} was reported with the time {since:g} but {line.global_time - start:g} s after {block}:start"
            )


def assert_starts_with_last(
    feedback: FeedbackList, block: str, points: Iterable[str], tolerance: float = TOLERANCE
) -> None:
    """A block started at the time of the last of these points."""
    last = max(points, key=feedback.time)
    assert_linked(feedback, f"{block}:start", last, tolerance=tolerance)


def _points(feedback: FeedbackList, behavior: str) -> list[str]:
    return [id_ for id_ in feedback.progress if id_.startswith(f"{behavior}:")]


def _listed(parts: Iterable[str]) -> str:
    return ", ".join(parts) or "nothing"
