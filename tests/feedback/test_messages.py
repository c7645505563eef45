"""Feedback has the forms of BML 1.0, and one order."""

import logging
from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, BMLT, OWN, is_sync_id
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import FeedbackManager, ProgressOrder, Report
from reactive_realizer.feedback.messages import (
    BehaviorPrediction,
    BlockProgress,
    PredictionFeedback,
    SyncPointProgress,
    WarningFeedback,
)
from reactive_realizer.feedback.xml import seconds, to_xml
from reactive_realizer.limits import Limits


def read(message: BlockProgress | SyncPointProgress | WarningFeedback | PredictionFeedback) -> etree._Element:
    xml = to_xml(message)
    assert "\n" not in xml
    return etree.fromstring(xml)


def attributes(element: etree._Element) -> dict[str, str]:
    return {str(name): str(value) for name, value in element.attrib.items()}


def behaviors(text: str) -> Sequence[Behavior]:
    (parsed,) = parse(text, Limits())
    assert parsed.block
    return parsed.block.behaviors


def test_block_progress_has_id_time_character_and_status() -> None:
    element = read(BlockProgress("alice", "b", "start", GlobalTime(1.5), "IN_EXEC"))
    assert element.tag == f"{{{BML}}}blockProgress"
    assert attributes(element) == {
        "id": "b:start",
        "globalTime": "1.5",
        "characterId": "alice",
        f"{{{BMLA}}}status": "IN_EXEC",
    }


def test_sync_point_progress_has_the_time_in_its_block_and_on_the_clock() -> None:
    element = read(SyncPointProgress("alice", "b", "h", "stroke:1", BlockTime(0.5), GlobalTime(2.0), {"word": "3"}))
    assert element.tag == f"{{{BML}}}syncPointProgress"
    assert attributes(element) == {
        "id": "b:h:stroke:1",
        "time": "0.5",
        "globalTime": "2",
        "characterId": "alice",
        f"{{{OWN}}}word": "3",
    }


def test_a_warning_has_a_type_and_a_reason() -> None:
    element = read(WarningFeedback("alice", "b:h", WarningType.NO_SUCH_TARGET, "there is no <such> target & no other"))
    assert attributes(element) == {"id": "b:h", "type": "NO_SUCH_TARGET", "characterId": "alice"}
    assert element.text == "there is no <such> target & no other"


def test_a_warning_of_a_document_names_no_character() -> None:
    assert "characterId" not in read(WarningFeedback(None, "bml", WarningType.PARSING_FAILURE, "no block")).attrib


@given(st.text(), st.text(), st.text(), st.text())
def test_any_name_and_any_reason_can_be_written_as_xml(character: str, block: str, name: str, text: str) -> None:
    read(BlockProgress(character, block, name, GlobalTime(1.0), "IN_EXEC"))
    read(SyncPointProgress(character, block, name, text, BlockTime(0.0), GlobalTime(1.0), {"word": text}))
    read(WarningFeedback(character, block, WarningType.EXECUTION_FAILURE, text))
    read(PredictionFeedback(character, block, GlobalTime(0.0), GlobalTime(1.0), "LURKING"))


@pytest.mark.parametrize(
    ("time", "text"),
    [(0.0, "0"), (-0.0, "0"), (1.0, "1"), (0.1 + 0.2, "0.3"), (1 / 3, "0.333333"), (1e-7, "0"), (100.0, "100")],
)
def test_times_have_at_most_six_decimals_and_no_more_than_they_need(time: float, text: str) -> None:
    assert seconds(time) == text


PREDICTED = """
<speech id="say" start="1"><text>Well <sync id="now"/>then.</text></speech>
<head id="h" lexeme="NOD" amount="0.3" stroke="say:now"/>
"""


@pytest.mark.parametrize("namespace", [f' xmlns="{BML}"', ""])
def test_a_prediction_has_every_behavior_as_it_was_written_with_its_known_times(namespace: str) -> None:
    say, head = behaviors(f'<bml{namespace} id="b">{PREDICTED}</bml>')
    predicted = (
        BehaviorPrediction(say, {"start": BlockTime(1.0), "now": BlockTime(1.4), "end": BlockTime(2.0)}),
        BehaviorPrediction(head, {"start": BlockTime(1.0), "stroke:1": BlockTime(1.4), "end": BlockTime(3.25)}),
    )
    element = read(PredictionFeedback("alice", "b", GlobalTime(10.0), GlobalTime(13.25), "LURKING", predicted))
    (block,) = element.findall(f"{{{BML}}}bml")
    assert attributes(block) == {
        "id": "b",
        "globalStart": "10",
        "globalEnd": "13.25",
        f"{{{BMLA}}}status": "LURKING",
    }
    _, speech, nod = element
    assert (etree.QName(speech).localname, speech.get("id"), speech.get("start")) == ("speech", "b:say", "1")
    assert "".join(str(text) for text in speech.itertext()).strip() == "Well then."
    assert next(e for e in speech.iter() if etree.QName(e).localname == "sync").get(f"{{{OWN}}}time") == "1.4"
    assert attributes(nod) == {"id": "b:h", "lexeme": "NOD", "amount": "0.3", "start": "1", "end": "3.25"}


KEYFRAME = f'<bmlt:keyframe xmlns:bmlt="{BMLT}" id="k" name="wave"/>'


def predicted(times: Mapping[str, BlockTime]) -> dict[str, str]:
    """The attributes of a keyframe animation with these points in a prediction."""
    (keyframe,) = behaviors(f'<bml xmlns="{BML}" id="b">{KEYFRAME}</bml>')
    predictions = (BehaviorPrediction(keyframe, times),)
    return attributes(
        read(PredictionFeedback("alice", "b", GlobalTime(0.0), GlobalTime(1.0), "LURKING", predictions))[1]
    )


@given(
    st.text() | st.sampled_from(["id", "name", "xmlns", "xmlns:a", "a b", "1x", "{x}", "{urn:x}y", "a+b", "", "é-1.a"])
)
def test_a_point_is_predicted_by_an_attribute_of_its_name_or_left_out_if_that_is_no_attribute_name(sync: str) -> None:
    found = predicted({sync: BlockTime(0.5)})
    assert found.pop("id") == "b:k"
    assert found.pop("name") == "wave"
    assert found == ({sync: "0.5"} if is_sync_id(sync) and sync != "name" else {})


@pytest.mark.parametrize(
    ("name", "may"),
    [
        *((name, True) for name in ("stroke", "beat1a", "é-1.a", "_", "xml")),
        *(
            (name, False)
            for name in ("", "a b", " a", "1x", "-1", "a+b", "a:b", "{x}", "{urn:x}y", "id", "xmlns", "\0")
        ),
    ],
)
def test_a_sync_id_is_a_legal_attribute_name(name: str, may: bool) -> None:
    assert is_sync_id(name) is may


@pytest.fixture
def told() -> tuple[FeedbackManager, list[Report]]:
    manager = FeedbackManager()
    reports: list[Report] = []
    manager.listen(reports.append)
    return manager, reports


def fail(report: Report) -> None:
    raise ZeroDivisionError


def progress(name: str, time: float) -> SyncPointProgress:
    return SyncPointProgress("alice", "b", name, "start", BlockTime(0.0), GlobalTime(time))


def test_within_a_tick_progress_is_sent_by_time_then_block_then_behavior_then_sync_point(
    told: tuple[FeedbackManager, list[Report]],
) -> None:
    manager, reports = told
    places = {
        "late": ProgressOrder(2.0, 0.0, 1, 0, 0),
        "second block": ProgressOrder(1.0, 1.0, 1, 0, 0),
        "arrived later": ProgressOrder(1.0, 0.0, 2, 0, 0),
        "second behavior": ProgressOrder(1.0, 0.0, 1, 1, 0),
        "second point": ProgressOrder(1.0, 0.0, 1, 0, 1),
        "first": ProgressOrder(1.0, 0.0, 1, 0, 0),
    }
    for name, place in places.items():
        manager.add_progress(progress(name, place.time), place)
    manager.add(WarningFeedback("alice", "b", WarningType.NO_SUCH_TARGET, "said last, told first"))
    manager.flush(GlobalTime(2.0))
    told_ids = [getattr(report.message, "behavior", "warning") for report in reports]
    assert told_ids == ["warning", *reversed(places)]
    assert {report.time for report in reports} == {2.0}
    manager.flush(GlobalTime(3.0))
    assert len(reports) == 7, "nothing is told twice"


def test_a_listener_that_fails_does_not_stop_the_others(
    told: tuple[FeedbackManager, list[Report]], caplog: pytest.LogCaptureFixture
) -> None:
    manager, reports = told
    stop = manager.listen(fail)
    manager.listen(lambda report: stop())
    with caplog.at_level(logging.CRITICAL):
        for _ in range(2):
            manager.add_progress(progress("h", 0.0), ProgressOrder(0.0, 0.0, 1, 0, 0))
            manager.flush(GlobalTime(0.0))
    assert len(reports) == 2
    stop()


@pytest.mark.parametrize("name", ["a b", "9th", 'x"y', "a:b", "", "<", "ö", "-"])
def test_an_engine_may_name_an_attribute_of_its_feedback_as_it_likes(name: str) -> None:
    message = progress("h", 0.0)._replace(details={name: "value"})
    assert "value" in etree.fromstring(to_xml(message)).attrib.values()


def test_of_many_warnings_of_a_tick_some_are_written_to_the_log(
    told: tuple[FeedbackManager, list[Report]], caplog: pytest.LogCaptureFixture
) -> None:
    manager, reports = told
    for number in range(100):
        manager.add(WarningFeedback("alice", f"b{number}", WarningType.PARSING_FAILURE, "wrong"))
    manager.flush(GlobalTime(0.25))
    assert len(reports) == 100
    assert len(caplog.messages) == 21
    assert caplog.messages[-1] == "tick 25: 80 more warnings"
