"""The laws of any session: feedback that keeps them passes, and each breach is noted with its law."""

from types import SimpleNamespace
from typing import cast

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.document import parse
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import (
    BehaviorPrediction,
    BlockProgress,
    Feedback,
    PredictionFeedback,
    SyncPointProgress,
    WarningFeedback,
)
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.testing.pilot import block
from reactive_realizer.testing.session_laws import SessionLaws

(_PARSED,) = parse(block("b", '<wait id="w" duration="1"/><head id="h" lexeme="NOD"/>'), Limits())
assert _PARSED.block is not None
WAIT, NOD = _PARSED.block.behaviors


def predicted(end: float) -> Feedback:
    times = {"start": BlockTime(0.0), "end": BlockTime(end)}
    return PredictionFeedback("c", "b", GlobalTime(0.0), GlobalTime(end), "LURKING", (BehaviorPrediction(WAIT, times),))


def of_block(sync: str, time: float, status: str = "DONE") -> Feedback:
    return BlockProgress("c", "b", sync, GlobalTime(time), status)


def point(sync: str, time: float) -> Feedback:
    return SyncPointProgress("c", "b", "w", sync, BlockTime(time), GlobalTime(time))


def broken(*told: tuple[float, Feedback]) -> list[str]:
    laws = SessionLaws()
    for now, message in told:
        laws(Report(GlobalTime(now), message))
    return [breach.law for breach in laws.breaches]


BEGUN = ((0.0, predicted(1.0)), (0.0, of_block("start", 0.0)), (0.0, point("start", 0.0)))


def test_feedback_as_it_should_be_breaks_no_law() -> None:
    assert broken(*BEGUN, (1.0, point("end", 1.0)), (1.0, of_block("end", 1.0))) == []


def test_a_behavior_that_is_cut_may_end_earlier_than_predicted() -> None:
    assert broken(*BEGUN, (0.5, point("end", 0.5)), (0.5, of_block("end", 0.5, "INTERRUPTED"))) == []


def test_a_prediction_of_the_next_block_with_the_same_id_does_not_count_for_the_present_one() -> None:
    of_next = PredictionFeedback("c", "b", GlobalTime(0.5), GlobalTime(0.5), "DONE", ())
    assert broken(*BEGUN, (1.0, of_next), (1.0, point("end", 1.0)), (1.0, of_block("end", 1.0))) == []


@pytest.mark.parametrize(
    ("law", "told"),
    [
        ("order", [(1.0, point("start", 1.0))]),
        ("order", [*BEGUN, (0.0, point("start", 0.0))]),
        ("order", [*BEGUN, (0.3, of_block("start", 0.0))]),
        ("order", [(0.0, of_block("end", 0.0))]),
        ("before_block", [(0.0, predicted(1.0)), (0.0, of_block("start", 0.0)), (0.0, point("start", -0.005))]),
        ("past", [*BEGUN, (1.02, point("end", 1.0))]),
        ("past", [*BEGUN, (0.9, point("end", 1.0))]),
        ("prediction", [*BEGUN, (1.2, point("end", 1.2))]),
        ("prediction", [(0.0, of_block("start", 0.0))]),
        ("equation", [(0.0, WarningFeedback("c", "b", WarningType.IMPOSSIBLE_TO_SCHEDULE, "(w:end; thesis 7.14)"))]),
    ],
)
def test_a_breach_is_noted_with_its_law(law: str, told: list[tuple[float, Feedback]]) -> None:
    assert law in broken(*told)


def ended(
    *, behavior: Behavior = NOD, cut: bool = False, kind: PhaseKind = PhaseKind.ELASTIC, **times: float
) -> BMLBlock:
    """A block whose behavior has ended with points at some times; it preferred a second for each phase."""
    graph, key = Graph(), BlockKey("c", "b")
    unit = PlanUnit(key, behavior, timing_at({sync: float(i) for i, sync in enumerate(times)}, kind))
    for sync, time in times.items():
        peg = OffsetPeg(graph, sync, AnticipatorPeg(graph, sync, GlobalTime(time)), 0.0)
        unit.points.append(SyncPoint(sync, peg, fired=True, cut=cut and sync == "end"))
    return cast("BMLBlock", SimpleNamespace(key=key, units=[unit], end=unit.points[-1].peg))


def broken_by(*steps: tuple[float, Feedback] | BMLBlock) -> list[str]:
    """The laws that feedback, and blocks that end in between, break."""
    laws = SessionLaws()
    for step in steps:
        if isinstance(step, tuple):
            laws(Report(GlobalTime(step[0]), step[1]))
        else:
            laws.check_units(step)
    return [breach.law for breach in laws.breaches]


END = (0.5, point("end", 0.5)), (0.5, of_block("end", 0.5))


@pytest.mark.parametrize(("cut", "laws"), [(True, []), (False, ["prediction"])])
def test_only_a_behavior_that_is_cut_may_end_earlier_than_predicted(cut: bool, laws: list[str]) -> None:
    block = ended(behavior=WAIT, start=0.0, end=0.5, cut=cut)
    assert broken_by(*BEGUN, block, *END) == broken_by(*BEGUN, END[0], block, END[1]) == laws


def test_an_early_end_does_not_count_for_the_next_block_with_the_same_id() -> None:
    first, second = ended(behavior=WAIT, start=0.0, end=0.5, cut=True), ended(behavior=WAIT, start=0.5, end=1.5)
    next_one = PredictionFeedback("c", "b", GlobalTime(0.5), GlobalTime(1.5), "LURKING", ())
    revoked = (0.9, of_block("end", 0.9, "REVOKED"))
    assert broken_by(*BEGUN, first, *END, (0.5, next_one), second, revoked) == []


@pytest.mark.parametrize(
    ("block", "laws"),
    [
        (ended(start=0.0, end=0.8), []),
        (ended(start=0.0, end=0.0), ["equation"]),
        (ended(behavior=WAIT, start=0.0, end=0.0), []),
        (ended(start=0.0, stroke=0.9, end=0.8), ["equation"]),
        (ended(start=0.0, end=0.8, kind=PhaseKind.RIGID), ["equation"]),
        (ended(start=0.0, end=1.0, kind=PhaseKind.RIGID), []),
        (ended(start=0.0, end=0.8, kind=PhaseKind.RIGID, cut=True), []),
    ],
)
def test_the_durations_of_a_behavior_are_checked_when_its_block_has_ended(block: BMLBlock, laws: list[str]) -> None:
    assert broken_by(block) == laws
