"""The conformance suite against a realizer behind a message broker of the Virtual Human Toolkit."""

import asyncio
from collections.abc import AsyncIterator, Callable, Collection
from contextlib import AbstractAsyncContextManager, asynccontextmanager

import pytest
from lxml import etree

from reactive_realizer.__main__ import main
from reactive_realizer.bridges.vhmsg import run_bridge
from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm
from reactive_realizer.client.stomp_bus import Broker, StompBus, connected
from reactive_realizer.client.vh_message import SCOPE, VhMessage
from reactive_realizer.conformance.broker_connection import BrokerConnection
from reactive_realizer.conformance.case import Profile, read_suite
from reactive_realizer.conformance.suite import PATIENCE, Outcome, Verdict, run_suite
from reactive_realizer.conformance.vhmsg_feedback import VhmsgFeedback
from reactive_realizer.errors import RealizerError

Behind = Callable[[FeedbackForm], AbstractAsyncContextManager[None]]


@pytest.fixture
def bridged(realizer: str, broker: Broker) -> Behind:
    """Puts this realizer behind a broker, with feedback in a form."""

    @asynccontextmanager
    async def bridge(form: FeedbackForm) -> AsyncIterator[None]:
        async with connected(broker, f"/topic/{SCOPE}") as bus, asyncio.TaskGroup() as group:
            running = group.create_task(run_bridge(realizer, broker, SCOPE, {"brad": "alice"}, form))
            while VhMessage.read(await bus.receive()).word != "vrComponent":
                pass
            yield
            running.cancel()

    return bridge


async def outcomes(broker: Broker, *names: str, profiles: Collection[Profile] = ()) -> list[Outcome]:
    cases = [case for case in read_suite() if case.name in names]
    connection = BrokerConnection(broker, SCOPE, "brad", PATIENCE)
    return [outcome async for outcome in run_suite(connection, cases, profiles)]


async def test_with_feedback_as_in_bml_everything_can_be_asserted(broker: Broker, bridged: Behind) -> None:
    names = (
        "append",
        "bad-xml",
        "bmla-activate",
        "gesture",
        "id-again",
        "replace",
        "required-lost",
        "several",
        "speech",
    )
    async with bridged(FeedbackForm.BML):
        came = await outcomes(broker, *names, profiles={*Profile} - {Profile.STRICT})
    assert [(o.case.name, o.problems) for o in came if o.verdict is Verdict.FAILED] == []
    assert [o.case.name for o in came if o.verdict is Verdict.UNSUPPORTED] == ["several"]


async def test_feedback_in_the_form_of_smartbody_has_the_times_of_points_and_blocks(
    broker: Broker, bridged: Behind
) -> None:
    async with bridged(FeedbackForm.SMARTBODY):
        came = await outcomes(broker, "wait", "gesture", "replace", "append", "times", "id-again")
    assert [(o.case.name, o.verdict, o.problems) for o in came if o.verdict is not Verdict.PASSED] == []


async def test_without_feedback_on_behaviors_blocks_start_and_end(broker: Broker, bridged: Behind) -> None:
    async with bridged(FeedbackForm.NONE):
        empty, wait = await outcomes(broker, "empty", "wait")
    assert (empty.verdict, wait.verdict) == (Verdict.PASSED, Verdict.FAILED)
    assert any("reached nothing instead of start, end" in problem for problem in wait.problems)


# --- which feedback follows from which messages


def read(*texts: str) -> list[tuple[str, str, float]]:
    """The kind, id and time of the feedback in messages that arrive at 10 s, 11 s and so on."""
    reader = VhmsgFeedback("brad")
    arrived = [each for now, text in enumerate(texts, 10) for each in reader.take(VhMessage.read(text), now)]
    elements = [etree.fromstring(xml) for _, xml in arrived]
    return [(etree.QName(e).localname, e.get("id", ""), float(e.get("globalTime", "nan"))) for e in elements]


def test_a_request_starts_and_ends_when_this_is_told() -> None:
    told = read("vrAgentBML brad m1 start", "vrAgentBML other m1 start", "vrAgentBML brad m1 end complete")
    assert told == [("blockProgress", "m1:start", 10), ("blockProgress", "m1:end", 12)]


def test_blocks_with_times_count_instead_of_the_messages_about_their_request() -> None:
    told = read(
        '<blockstart characterId="brad" id="m1" time="3.5"/>',
        "vrAgentBML brad m1 start",
        '<syncpointprogress characterId="brad" id="m1:h:stroke_start" time="4"/>',
        "vrAgentBML brad m1 end complete",
        '<blockend characterId="brad" id="m1" time="5"/>',
        '<blockstart characterId="brad" id="m1" time="6"/>',
    )
    assert told == [
        ("blockProgress", "m1:start", 3.5),
        ("syncPointProgress", "m1:h:strokeStart", 4),
        ("blockProgress", "m1:end", 5),
        ("blockProgress", "m1:start", 6),
    ]


def test_an_interruption_that_is_only_told_of_the_request_is_in_the_time_of_the_realizer() -> None:
    told = read('<blockstart characterId="brad" id="m1" time="3.5"/>', "vrAgentBML brad m1 end interrupted")
    assert told[1] == ("blockProgress", "m1:end", 4.5)


@pytest.mark.parametrize("message", ["vrAgentBML brad m1 end error it is odd", "vrSpeakFailed brad user m1 it is odd"])
def test_a_request_that_fails_is_warned_of(message: str) -> None:
    (_, xml), *_ = VhmsgFeedback("brad").take(VhMessage.read(message), 10)
    warning = etree.fromstring(xml)
    assert (etree.QName(warning).localname, warning.get("id"), warning.text) == ("warningFeedback", "m1", "it is odd")


@pytest.mark.parametrize("message", ["vrAllCall", "vrAgentBML brad m1", "vrAgentBML request brad m1 <bml/>", "vrSpeak"])
def test_other_messages_are_no_feedback(message: str) -> None:
    assert read(message) == []


async def talk(bus: StompBus, text: str) -> None:
    """Say the same again and again: nobody knows when the others have begun to listen."""
    while True:
        bus.send(text)
        await asyncio.sleep(0.05)


async def test_a_realizer_that_says_nothing_is_not_alive(broker: Broker) -> None:
    with pytest.raises(RealizerError, match="sent no feedback for"):
        async for _ in run_suite(BrokerConnection(broker, SCOPE, "brad", 0.2), []):
            pass


async def test_feedback_that_is_no_xml_fails_the_case(broker: Broker) -> None:
    async with (
        connected(broker, f"/topic/{SCOPE}") as bus,
        BrokerConnection(broker, SCOPE, "brad", PATIENCE) as connection,
        asyncio.TaskGroup() as group,
    ):
        talking = group.create_task(talk(bus, "<blockstart id="))
        assert await connection.until(lambda: bool(connection.mistakes))
        talking.cancel()
    assert "feedback that is not XML" in connection.mistakes[0]


# --- the command


async def test_the_command_tests_an_agent_behind_a_broker(
    broker: Broker, bridged: Behind, capsys: pytest.CaptureFixture[str]
) -> None:
    async with bridged(FeedbackForm.BML):
        arguments = ["--agent", "brad", "--broker", f"{broker.host}:{broker.port}", "--case", "wait"]
        assert await asyncio.to_thread(main, ["conformance", *arguments, "--case", "bad-twice"]) == 0
    out = capsys.readouterr().out
    assert "1 passed, 0 failed, 1 unsupported" in out
    assert "  the name of a message may be in use\n" in out


async def test_the_exit_status_is_2_without_a_broker(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["conformance", "--agent", "brad", "--broker", "127.0.0.1:9"]
    assert await asyncio.to_thread(main, arguments) == 2
    assert "no message broker can be reached at 127.0.0.1:9" in capsys.readouterr().err
