"""Speech whose sound clients send over the socket."""

from base64 import b64encode
from typing import Any

import pytest

from .conftest import BML, OnAir, Open, Socket

STREAM = "<stream xmlns='urn:reactive-realizer:1' name='x' rate='16000'/>"
DESCRIBED = f'<description priority="1" type="audio/x-stream">{STREAM}</description>'
SPEECH = f'<bml {BML} id="{{id}}"><speech id="s"><text/>{DESCRIBED}</speech></bml>'
SECOND = b64encode(b"\0\x20\0\xe0" * 8000).decode()
"""A tone of one second."""


async def begun(air: OnAir, id_: str = "b") -> Socket:
    """A client whose speech has begun."""
    socket = await air.connect("?streams=audio,feedback")
    await socket.say(type="bml", xml=SPEECH.format(id=id_))
    assert (await socket.ask(type="speech", stream="x", audio=SECOND))["type"] == "accepted"
    await air.tick_until(air.live.now + 0.3)
    assert (await socket.hear("audio"))["duration"] == 1.0
    return socket


async def end_of(air: OnAir, socket: Socket, id_: str = "b") -> str:
    """The last feedback of a block."""
    await air.tick_until(air.live.now + 4)
    feedback: str = (await socket.hear_feedback(f'id="{id_}:end"'))["xml"]
    return feedback


async def test_sound_that_is_sent_right_after_its_speech_is_spoken(on_air: Open) -> None:
    async with on_air() as air:
        socket = await begun(air)
        answer = await socket.ask(type="speech", stream="x", audio=SECOND, end=True)
        assert answer == {"type": "accepted", "ref": "asked"}
        await air.tick_until(0.5)
        assert (await socket.hear("audio"))["duration"] == 1.0
        assert "DONE" in await end_of(air, socket)


@pytest.mark.parametrize(
    ("message", "code"),
    [
        ({"stream": "y", "audio": SECOND}, "unknown-stream"),
        ({"stream": "x", "audio": "AAA"}, "bad-message"),
        ({"stream": "x", "audio": b64encode(b"RIFF" + bytes(1000)).decode()}, "not-samples"),
    ],
    ids=["another stream", "no base64", "a WAV file"],
)
async def test_what_cannot_be_taken_is_refused_and_the_rest_is_spoken(
    on_air: Open, message: dict[str, Any], code: str
) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        await socket.say(type="bml", xml=SPEECH.format(id="b"))
        answer = await socket.ask(type="speech", **message)
        assert answer["code"] == code
        assert (await socket.ask(type="speech", stream="x", audio=SECOND, end=True))["type"] == "accepted"
        assert "DONE" in await end_of(air, socket)


async def test_what_is_sent_after_the_end_is_refused_once_and_then_ignored(on_air: Open) -> None:
    async with on_air() as air:
        socket, listener = await begun(air), await air.connect("?streams=feedback")
        await socket.ask(
            type="bml", xml=f'<bml {BML} id="c" xmlns:a="http://www.asap-project.org/bmla" a:interrupt="b"/>'
        )
        await air.tick_until(air.live.now + 0.1)
        answers = [await socket.ask(type="speech", stream="x", audio=SECOND) for _ in range(3)]
        assert [each.get("code") for each in answers] == ["stream-over", None, None]
        assert "INTERRUPTED" in await end_of(air, listener)
        await begun(air, "again")


async def test_only_the_client_that_has_begun_may_go_on_until_it_disconnects(on_air: Open) -> None:
    async with on_air() as air:
        first, second = await begun(air), await air.connect("?streams=feedback")
        assert (await second.ask(type="speech", stream="x", audio=SECOND))["code"] == "foreign-stream"
        await first.raw.close()
        answers = [await second.ask(type="speech", stream="x", audio=SECOND) for _ in range(3)]
        assert answers[-1]["type"] == "accepted"
        await second.ask(type="speech", stream="x", end=True)
        assert "DONE" in await end_of(air, second)


async def test_a_speech_whose_client_has_disconnected_ends_and_says_so(on_air: Open) -> None:
    async with on_air() as air:
        first, second = await begun(air), await air.connect("?streams=feedback")
        await first.raw.close()
        await air.tick_until(air.live.now + 21)
        warning = (await second.hear_feedback("warningFeedback"))["xml"]
        assert "no sound of the stream 'x' has arrived for 20 s" in warning


async def test_streams_above_the_limit_are_refused(on_air: Open) -> None:
    async with on_air("[character.alice]\n[limits]\nstreams = 1\n") as air:
        socket = await begun(air)
        other = SPEECH.replace("'x'", "'y'").format(id="c")
        await socket.ask(type="bml", xml=other)
        await air.tick_until(air.live.now + 0.1)
        assert "the limit of 1 streamed speeches" in (await socket.hear_feedback("warningFeedback"))["xml"]
        assert (await socket.ask(type="speech", stream="y", audio=SECOND))["code"] == "unknown-stream"
