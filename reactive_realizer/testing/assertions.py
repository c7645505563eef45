"""What a test asks of feedback: the assertions of RealizerTester (thesis 9.3), over a `FeedbackList`.

Points are named as in feedback: ``block:behavior:sync``, ``block:start``, ``block:end``; behaviors ``block:behavior``.
Each raises an AssertionError that says what was told instead.
"""

from collections.abc import Iterable
from itertools import pairwise

from reactive_realizer.testing.feedback_list import FeedbackList

TOLERANCE = 1e-3
"""s by which times that are meant to be one may differ."""

DONE = "DONE"


def assert_told_once(told: FeedbackList) -> None:
    """No progress was told twice."""
    twice = sorted({id_ for id_ in told.progress if told.progress.count(id_) > 1})
    assert not twice, f"told more than once: {', '.join(twice)}"


def assert_syncs_in_order(told: FeedbackList, behavior: str, *syncs: str) -> None:
    """A behavior reached these points and no others, each once, in this order of telling and of time."""
    reached = [point.removeprefix(f"{behavior}:") for point in _points(told, behavior)]
    assert reached == list(syncs), f"{behavior} reached {_listed(reached)} where {_listed(syncs)} was to come"
    for earlier, later in pairwise(syncs):
        assert_order(told, f"{behavior}:{earlier}", f"{behavior}:{later}")


def assert_block_around(told: FeedbackList, block: str) -> None:
    """A block was told to start and to end, once each, before and after all that was told of its behaviors."""
    assert_order(told, f"{block}:start", f"{block}:end")
    own = [id_ for id_ in told.progress if id_.startswith(f"{block}:") and id_ != f"{block}:relax"]
    assert own[0] == f"{block}:start", f"{own[0]} was told before {block}:start"
    assert own[-1] == f"{block}:end", f"{own[-1]} was told after {block}:end"


def assert_ended(told: FeedbackList, block: str, status: str = DONE) -> None:
    """A block ended once, in this state."""
    told.time(f"{block}:end")
    assert told.status(block) == status, f"{block} ended {told.status(block)} where {status} was to come"


def assert_time(told: FeedbackList, point: str, time: float, tolerance: float = TOLERANCE) -> None:
    """A point was reached at a time of the realizer, s."""
    reached = told.time(point)
    assert abs(reached - time) <= tolerance, f"{point} was reached at {reached:g} s where {time:g} s was to come"


def assert_linked(
    told: FeedbackList, point: str, other: str, offset: float = 0.0, tolerance: float = TOLERANCE
) -> None:
    """A point was reached together with another one, or ``offset`` seconds after it."""
    distance = told.time(point) - told.time(other)
    assert abs(distance - offset) <= tolerance, (
        f"{point} was reached {distance:g} s after {other} where {offset:g} s was to come"
    )


def assert_relative_time(told: FeedbackList, point: str, time: float, tolerance: float = TOLERANCE) -> None:
    """A point was reached so many seconds after the start of its block."""
    assert_linked(told, point, f"{point.partition(':')[0]}:start", time, tolerance)


def assert_order(
    told: FeedbackList, earlier: str, later: str, distance: float = 0.0, tolerance: float = TOLERANCE
) -> None:
    """A point was reached at least ``distance`` seconds after another one."""
    between = told.time(later) - told.time(earlier)
    assert between >= distance - tolerance, (
        f"{later} was reached {between:g} s after {earlier} where at least {distance:g} s was to come"
    )


def assert_warnings(told: FeedbackList, *warnings: tuple[str, str]) -> None:
    """These warnings came, as (id, type) in any order, and no others."""
    missing, other = list(warnings), []
    for warning in told.warnings:
        if warning in missing:
            missing.remove(warning)
        else:
            other.append(warning)
    assert not missing, f"no warning of {_listed(map(' '.join, missing))}"
    assert not other, f"a warning of {_listed(map(' '.join, other))}"


def assert_not_played(told: FeedbackList, behavior: str) -> None:
    """Nothing was told of a behavior, or of a whole block, but its end."""
    played = [id_ for id_ in told.progress if id_.startswith(f"{behavior}:") and id_ != f"{behavior}:end"]
    assert not played, f"{behavior} reached {_listed(played)}"


def assert_predicted(told: FeedbackList, point: str, tolerance: float = TOLERANCE) -> None:
    """A point was reached when the last prediction before it said; it may be ``block:start`` or ``block:end`` too."""
    assert_time(told, point, told.foretold(point), tolerance)


def assert_all_predicted(told: FeedbackList, behavior: str, tolerance: float = TOLERANCE) -> None:
    """A behavior reached its start, its end and what else of it was predicted when the last prediction before said."""
    for point in _points(told, behavior):
        try:
            assert_predicted(told, point, tolerance)
        except LookupError:
            assert point not in (f"{behavior}:start", f"{behavior}:end"), f"{point} was not predicted"


def assert_block_times(told: FeedbackList, block: str, tolerance: float = TOLERANCE) -> None:
    """Of each point of a block was told how long after the start of the block it was reached."""
    start = told.time(f"{block}:start")
    for line in told.of("syncPointProgress"):
        if line.id.startswith(f"{block}:"):
            since = float(line.element.get("time", "nan"))
            assert abs(since - (line.at - start)) <= tolerance, (
                f"{line.id} was told with the time {since:g} where {line.at - start:g} s had passed since {block}:start"
            )


def assert_starts_with_last(
    told: FeedbackList, block: str, points: Iterable[str], tolerance: float = TOLERANCE
) -> None:
    """A block started when the last of what it waits for was reached: neither before nor after."""
    last = max(points, key=told.time)
    assert_linked(told, f"{block}:start", last, tolerance=tolerance)


def _points(told: FeedbackList, behavior: str) -> list[str]:
    return [id_ for id_ in told.progress if id_.startswith(f"{behavior}:")]


def _listed(parts: Iterable[str]) -> str:
    return ", ".join(parts) or "nothing"
