"""The bridge to the Virtual Human Toolkit: which reports follow from what the realizer says."""

import logging
import math

import pytest

from reactive_realizer.bridges.vhmsg_bridge import VhmsgBridge, ends
from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm
from reactive_realizer.client.vh_message import VhMessage

FEEDBACK = (
    '<{} xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" '
    'xmlns:rr="urn:reactive-realizer:1" characterId="alice" id="{}" globalTime="1" {}>{}</{}>'
)


class Toolkit:
    """A bridge, and what it has sent to the toolkit."""

    def __init__(self, form: FeedbackForm = FeedbackForm.NONE) -> None:
        self.sent: list[str] = []
        self.bridge = VhmsgBridge({"alice": "alice", "brad": "alice"}, self._send, form)

    def request(self, name: str, xml: str = "<bml/>", agent: str = "brad") -> dict[str, object] | None:
        return self.bridge.take(VhMessage("vrSpeak", f"{agent} user {name} {xml}"))

    def progress(self, point: str, status: str) -> None:
        self._feedback("blockProgress", point, f'bmla:status="{status}"')

    def reach(self, point: str, event: str = "") -> None:
        self._feedback("syncPointProgress", point, "", event)

    def fail(self, block: str, reason: str, *accepted: str) -> None:
        self.bridge.report({"type": "error", "ref": block, "message": reason, "blocks": list(accepted)})

    def _send(self, message: VhMessage) -> None:
        self.sent.append(" ".join(message).strip())

    def _feedback(self, kind: str, id_: str, attributes: str, inside: str = "") -> None:
        self.bridge.report(
            {"type": "feedback", "time": 0.0, "xml": FEEDBACK.format(kind, id_, attributes, inside, kind)}
        )


@pytest.fixture
def toolkit() -> Toolkit:
    return Toolkit()


def test_the_realizer_gets_a_document_with_the_character_and_the_name_of_the_request(toolkit: Toolkit) -> None:
    sent = toolkit.request("m1")
    assert sent is not None
    assert (sent["type"], sent["ref"]) == ("bml", "m1")
    assert 'characterId="alice"' in str(sent["xml"])


@pytest.mark.parametrize(
    ("status", "outcome"),
    [("DONE", "complete"), ("INTERRUPTED", "interrupted"), ("REVOKED", "interrupted"), ("FAILED", "error")],
)
def test_a_request_is_reported_when_it_starts_and_ends(toolkit: Toolkit, status: str, outcome: str) -> None:
    toolkit.request("m1")
    toolkit.progress("m1:start", "IN_EXEC")
    toolkit.progress("m1:end", status)
    assert toolkit.sent == ["vrAgentBML brad m1 start", f"vrAgentBML brad m1 end {outcome}"]


def test_a_request_of_two_blocks_starts_with_the_first_and_ends_with_the_last(toolkit: Toolkit) -> None:
    toolkit.request("m1", "<act><bml/><bml/></act>")
    for point, status in (("m1:start", "IN_EXEC"), ("m1_2:start", "IN_EXEC"), ("m1_2:end", "REVOKED")):
        toolkit.progress(point, status)
    assert toolkit.sent == ["vrAgentBML brad m1 start"]
    toolkit.progress("m1:end", "DONE")
    assert toolkit.sent[1:] == ["vrAgentBML brad m1 end interrupted"]


def test_a_refused_request_is_reported_with_the_reason(toolkit: Toolkit) -> None:
    toolkit.request("m1")
    toolkit.fail("m1", "line 1: no entry")
    assert toolkit.sent == ["vrSpeakFailed brad user m1 line 1: no entry"]
    assert toolkit.request("m1") is not None


def test_the_accepted_blocks_of_a_refused_request_still_play(toolkit: Toolkit) -> None:
    toolkit.request("m1", "<act><bml/><bml/></act>")
    toolkit.fail("m1", "why", "m1")
    toolkit.progress("m1:start", "IN_EXEC")
    toolkit.progress("m1:end", "DONE")
    assert toolkit.sent[1:] == ["vrAgentBML brad m1 start", "vrAgentBML brad m1 end complete"]


def test_a_request_that_is_not_xml_fails_at_once(toolkit: Toolkit) -> None:
    assert toolkit.request("m1", "<bml><head></bml>") is None
    assert [each.rpartition(":")[0].startswith("vrSpeakFailed brad user m1 ") or each for each in toolkit.sent] == [
        True
    ]


def test_events_of_requests_are_messages(toolkit: Toolkit) -> None:
    toolkit.request("m1")
    toolkit.reach("m1:e:start", '<rr:event name="vrSpoke">brad user m1 Hello</rr:event>')
    toolkit.reach("other:e:start", '<rr:event name="vrSpoke">not ours</rr:event>')
    assert toolkit.sent == ["vrSpoke brad user m1 Hello"]


def test_requests_to_agents_of_other_components_are_left_to_them(
    toolkit: Toolkit, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        assert [toolkit.request(name, agent="rachel") for name in ("m1", "m2")] == [None, None]
    assert toolkit.sent == []
    assert len(caplog.records) == 1
    assert "rachel" in caplog.text


def test_a_request_without_one_of_its_parts_is_logged(toolkit: Toolkit, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        assert toolkit.bridge.take(VhMessage("vrSpeak", "brad user <bml/>")) is None
    assert "needs an agent, a recipient, a name and BML: brad user <bml/>" in caplog.text


@pytest.mark.parametrize(
    ("commands", "place"),
    [
        (["pawn cup init loc 1 2 3 geom sphere"], [1.0, 2.0, 3.0]),
        (["pawn cup init"], [0.0, 0.0, 0.0]),
        (["set pawn cup world_offset x 1 y -2 z 3.5"], [1.0, -2.0, 3.5]),
        (["pawn cup init loc 1 2 3", "set pawn cup world-offset y 5"], [1.0, 5.0, 3.0]),
        (["pawn cup init geom sphere"], [0.0, 0.0, 0.0]),
    ],
)
def test_a_pawn_that_is_placed_is_a_target(toolkit: Toolkit, commands: list[str], place: list[float]) -> None:
    *_, last = [toolkit.bridge.take(VhMessage("sbm", command)) for command in commands]
    assert last == {"type": "world", "set": {"cup": place}}


@pytest.mark.parametrize(
    ("commands", "orientation"),
    [
        (["h 90"], [math.sqrt(0.5), 0, math.sqrt(0.5), 0]),
        (["p 90"], [math.sqrt(0.5), math.sqrt(0.5), 0, 0]),
        (["r 90"], [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]),
        (["h 90", "p 90"], [0.5, 0.5, 0.5, -0.5]),
        (["h 90", "h 0"], [1, 0, 0, 0]),
    ],
)
def test_the_angles_of_a_pawn_are_its_orientation(
    toolkit: Toolkit, commands: list[str], orientation: list[float]
) -> None:
    placed = [VhMessage("sbm", f"set pawn cup world_offset x 1 {command}") for command in commands]
    *_, last = [toolkit.bridge.take(message) for message in placed]
    place = {"position": [1.0, 0.0, 0.0], "orientation": pytest.approx(orientation, abs=1e-9)}
    assert last == {"type": "world", "set": {"cup": place}}


def test_pawns_may_be_placed_in_centimeters() -> None:
    bridge = VhmsgBridge({}, lambda message: None, unit=0.01)
    moved = bridge.take(VhMessage("sbm", "pawn cup init loc 50 120 -30"))
    assert moved == {"type": "world", "set": {"cup": pytest.approx([0.5, 1.2, -0.3])}}


@pytest.mark.parametrize("init", ["geom sphere size 0.1 loc 1 2 3", "loc 1 2 3 geom sphere size 0.1"])
def test_what_is_not_read_of_a_pawn_is_logged(toolkit: Toolkit, caplog: pytest.LogCaptureFixture, init: str) -> None:
    placed = toolkit.bridge.take(VhMessage("sbm", f"pawn cup init {init}"))
    assert placed == {"type": "world", "set": {"cup": [1.0, 2.0, 3.0]}}
    assert caplog.messages == ["only loc of the pawn 'cup' is read, not geom sphere size 0.1"]


@pytest.mark.parametrize("command", ["pawn cup prim", "set pawn cup scale 2", "pawn * clear"])
def test_a_command_that_does_something_else_with_a_pawn_is_logged(
    toolkit: Toolkit, caplog: pytest.LogCaptureFixture, command: str
) -> None:
    assert toolkit.bridge.take(VhMessage("sbm", command)) is None
    assert caplog.messages == [f"a pawn cannot be placed: only init and world_offset do this: {command}"]


@pytest.mark.parametrize("place", ["far 1 2", "nan 0 0", "1e999 0 0"])
def test_a_pawn_that_cannot_be_placed_is_logged(toolkit: Toolkit, caplog: pytest.LogCaptureFixture, place: str) -> None:
    with caplog.at_level(logging.WARNING):
        assert toolkit.bridge.take(VhMessage("sbm", f"pawn cup init loc {place}")) is None
    assert "a pawn cannot be placed: could not convert" in caplog.text


@pytest.mark.parametrize("place", ["loc 1 2", "loc 1", "loc", "geom sphere loc 1 2"])
def test_a_pawn_with_too_few_numbers_is_not_placed_and_logged(
    toolkit: Toolkit, caplog: pytest.LogCaptureFixture, place: str
) -> None:
    assert toolkit.bridge.take(VhMessage("sbm", f"pawn cup init {place}")) is None
    assert caplog.messages == [f"a pawn cannot be placed: loc requires three numbers: pawn cup init {place}"]


@pytest.mark.parametrize(
    ("offsets", "reason"),
    [
        ("x 1 y 2 h", "'h' has no value"),
        ("h x 1 y 2", "'h' has no value"),
        ("x 1 h y 2", "'h' has no value"),
        ("x 1 q 3 y 2", "there is no coordinate 'q'; known: x, y, z, h, p, r"),
        ("x 1 xy 3 y 2", "there is no coordinate 'xy'; known: x, y, z, h, p, r"),
        ("x 1 z far y 2", "could not convert string to float: 'far'"),
        ("x 1 z inf y 2", "could not convert to a finite number: 'inf'"),
    ],
)
def test_an_offset_that_cannot_be_read_is_logged_and_the_others_count(
    toolkit: Toolkit, caplog: pytest.LogCaptureFixture, offsets: str, reason: str
) -> None:
    moved = toolkit.bridge.take(VhMessage("sbm", f"set pawn cup world_offset {offsets}"))
    assert moved == {"type": "world", "set": {"cup": [1.0, 2.0, 0.0]}}
    assert caplog.messages == [f"an offset of the pawn 'cup' is left out: {reason}"]


@pytest.mark.parametrize("offsets", ["", " ", " h"])
def test_a_pawn_without_an_offset_stays_and_is_logged(
    toolkit: Toolkit, caplog: pytest.LogCaptureFixture, offsets: str
) -> None:
    assert toolkit.bridge.take(VhMessage("sbm", f"set pawn cup world_offset{offsets}")) is None
    assert "a pawn cannot be placed: world_offset has no coordinate that can be read: set pawn cup" in caplog.text


def test_it_answers_a_call_of_all_components(toolkit: Toolkit) -> None:
    toolkit.bridge.take(VhMessage("vrAllCall", ""))
    assert toolkit.sent == ["vrComponent reactive-realizer all"]


def test_it_ends_when_it_or_every_component_is_asked_to() -> None:
    asked = [VhMessage("vrKillComponent", name) for name in ("all", "reactive-realizer", "nvb", "")]
    assert [ends(each) for each in asked] == [True, True, False, False]


def perform(toolkit: Toolkit) -> list[str]:
    """What is sent of a request with a gesture, and of a block of another client."""
    toolkit.request("m1")
    toolkit.progress("m1:start", "IN_EXEC")
    toolkit.reach("m1:g:strokeStart")
    toolkit.reach("other:g:strokeStart")
    toolkit.progress("m1:end", "DONE")
    return toolkit.sent


def test_feedback_in_the_form_of_smartbody_has_its_names_and_agents() -> None:
    assert perform(Toolkit(FeedbackForm.SMARTBODY)) == [
        '<blockstart characterId="brad" id="m1" time="1"/>',
        "vrAgentBML brad m1 start",
        '<syncpointprogress characterId="brad" id="m1:g:stroke_start" time="1"/>',
        '<blockend characterId="brad" id="m1" time="1"/>',
        "vrAgentBML brad m1 end complete",
    ]


def test_feedback_in_the_form_of_bml_is_that_of_the_realizer() -> None:
    sent = perform(Toolkit(FeedbackForm.BML))
    assert [each.partition(" ")[0] for each in sent] == [
        "<blockProgress",
        "vrAgentBML",
        "<syncPointProgress",
        "<blockProgress",
        "vrAgentBML",
    ]
    assert 'id="m1:g:strokeStart"' in sent[2]
