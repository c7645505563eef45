"""Events over the socket move pegs, or are answered with an error."""

import pytest

from .conftest import ALICE, BML, Open

HUMAN = f"""{ALICE}
[anticipator.spacebar]
kind = "spacebar"
[anticipator.user]
kind = "speech_stop"
[anticipator.trainee]
kind = "exercise"
[anticipator.orchestra]
kind = "conducting"
"""
WAIT = f'<bml {BML} id="b"><wait id="w" start="anticipators:{{}}" duration="0.1"/></bml>'


async def test_a_key_event_starts_a_behavior_that_is_tied_to_it(on_air: Open) -> None:
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        await socket.ask(type="bml", xml=WAIT.format("spacebar:press"))
        await air.tick_until(0.5)
        assert (await socket.ask(type="event", anticipator="spacebar", event="press"))["type"] == "accepted"
        await air.tick_until(1.0)
        assert 'id="b:end"' in (await socket.hear_feedback("b:end"))["xml"]


async def test_a_client_emits_an_event_but_neither_predicts_it_nor_names_it_badly(on_air: Open) -> None:
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        await socket.ask(type="bml", xml=WAIT.format("events:go"))
        await air.tick_until(0.5)
        assert (await socket.ask(type="predict", anticipator="events", sync="go", time=9))["code"] == "predicts-itself"
        assert (await socket.ask(type="event", anticipator="events", event="a-1"))["code"] == "not-an-event"
        assert (await socket.ask(type="event", anticipator="events", event="go"))["type"] == "accepted"
        await air.tick_until(1.0)
        assert 'id="b:end"' in (await socket.hear_feedback("b:end"))["xml"]


async def test_recognized_words_reach_the_anticipator(on_air: Open) -> None:
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        await socket.ask(type="bml", xml=WAIT.format("user:stop"))
        said = {"type": "event", "anticipator": "user", "event": "words"}
        assert (await socket.ask(**said, text="Où est-ce que tu habites ?"))["type"] == "accepted"
        await air.tick_until(1.0)
        assert 'id="b:end"' in (await socket.hear_feedback("b:end"))["xml"]


@pytest.mark.parametrize(
    ("anticipator", "event", "value"),
    [
        ("user", "voice", 3),
        ("user", "voice", None),
        ("trainee", "sample", -1),
        ("trainee", "sample", 1e7),
        ("trainee", "sample", None),
        ("metronome", "tempo", 500),
        ("metronome", "tempo", None),
    ],
)
async def test_the_answer_to_an_invalid_value_has_its_range(
    on_air: Open, anticipator: str, event: str, value: float | None
) -> None:
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        said = {} if value is None else {"value": value}
        answer = await socket.ask(type="event", anticipator=anticipator, event=event, **said)
        assert answer["code"] == "bad-number"
        assert event in answer["message"]


NOT_KNOWN = {
    "kick": ({"anticipator": "spacebar", "event": "kick"}, "known events: press, release"),
    "press in words": (
        {"anticipator": "spacebar", "event": "press", "text": "on"},
        "not know the event press with a text",
    ),
    "words without any": ({"anticipator": "user", "event": "words"}, "known events: voice, words with a text"),
    "a beat": ({"anticipator": "metronome", "event": "beat"}, "known events: tempo, start"),
    "an event of a partner": ({"anticipator": "partner", "event": "clap"}, "it takes predictions"),
}


@pytest.mark.parametrize("name", NOT_KNOWN)
async def test_the_answer_to_an_unknown_event_lists_the_known_ones(on_air: Open, name: str) -> None:
    said, known = NOT_KNOWN[name]
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        await socket.ask(type="predict", anticipator="partner", sync="hit", **{"in": 1})
        await air.tick_until(0.1)
        answer = await socket.ask(type="event", **said)
        assert (answer["type"], answer["code"]) == ("error", "unknown-event")
        assert known in answer["message"]


@pytest.mark.parametrize(
    ("anticipator", "sync"), [("spacebar", "press"), ("user", "stop"), ("trainee", "1"), ("orchestra", "beat1")]
)
async def test_a_client_cannot_predict_for_a_built_in_anticipator(on_air: Open, anticipator: str, sync: str) -> None:
    async with on_air(HUMAN) as air:
        socket = await air.connect()
        answer = await socket.ask(type="predict", anticipator=anticipator, sync=sync, **{"in": 1})
        assert answer["code"] == "predicts-itself"
