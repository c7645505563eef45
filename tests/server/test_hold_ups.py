"""Nothing that a client sends holds up the session: its work is done in short turns, and ticks come in between.

The work of a turn of the event loop is counted in calls.
"""

import asyncio
import json
import sys
from asyncio.events import Handle
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioClip, AudioStart, Sound

from .conftest import BML, OnAir, Open, post, report

MOST_CALLS = 30_000
"""Of one turn, which takes about 5 ms; what is sent takes many times as many in all."""

Send = Callable[[OnAir, int], Awaitable[object]]


async def blocks(air: OnAir, number: int) -> object:
    """A document of many blocks."""
    return await post(air, "/bml", "".join(f'<bml {BML} id="b{each}"/>' for each in range(number)))


async def unknown_names(air: OnAir, number: int) -> object:
    """A block of which each behavior names another block that is unknown."""
    waits = "".join(f'<wait id="w{each}" start="none{each}:w:start"/>' for each in range(number))
    return await post(air, "/bml", f'<bml {BML} id="b">{waits}</bml>')


async def words(air: OnAir, number: int) -> object:
    """A message with many values."""
    socket = await air.client.ws_connect("/ws?streams=feedback")
    await socket.send_json({"type": "speech", "stream": "s", "words": [["word", 0.1]] * number})
    return [await socket.receive() for _ in ("hello", "error")]


async def explanation(air: OnAir, _: int) -> object:
    """A request for the explanation of a block with many points, which is there already."""
    answer = await air.client.get("/explain/chain")
    return await answer.read()


async def feedback(air: OnAir, _: int) -> object:
    """A client that resumes after much feedback."""
    reader, writer = await asyncio.open_connection(air.client.host, air.client.port)
    writer.write(b"GET /feedback?after=0 HTTP/1.1\r\nHost: localhost\r\n\r\n")
    text = b""
    while b"the last one" not in text:
        text += await reader.read(65536)
    writer.close()
    return text


@pytest.mark.parametrize("send", [blocks, unknown_names, words, explanation, feedback])
async def test_what_a_client_sends_is_worked_on_in_short_turns(on_air: Open, send: Send) -> None:
    assert await most_calls(on_air, send, 1000) < MOST_CALLS


async def test_a_message_with_too_many_values_is_refused(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        await socket.say_anything(json.dumps({"type": "ping", "t": 1, "more": [[]] * 60_000, "ref": 7}))
        answer = await socket.hear("error")
        assert (answer["code"], answer["ref"]) == ("too-many-values", 7)


async def test_a_sound_is_sent_as_its_client_reads_it(on_air: Open) -> None:
    async with on_air() as air:
        sound = Sound(bytes(32 * 1024 * 1024), 2.0)
        air.live.sounds.take(AudioStart("alice", AudioClip("c1", sound), GlobalTime(0.5)))
        reader, writer = await asyncio.open_connection(air.client.host, air.client.port, limit=1000)
        writer.write(b"GET /audio/c1.wav HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert b"200" in await reader.readline()
        for _ in range(200):
            await asyncio.sleep(0)
        server: Any = air.client.server
        (connection,) = server.runner.server.connections
        assert connection.transport.get_write_buffer_size() < 1024 * 1024
        writer.close()


async def most_calls(on_air: Open, send: Send, number: int) -> int:
    """The most calls of a turn of the event loop, other than those of ticks, while a client sends something."""
    async with on_air() as air:
        chain = "".join(f'<wait id="w{i}" duration="9" start="w{i - 1}:start + 0.1"/>' for i in range(1, number))
        await post(air, "/bml", f'<bml {BML} id="chain"><wait id="w0" duration="9"/>{chain}</bml>')
        for _ in range(3 * number // 10):
            await air.tick()
        for _ in range(number):
            air.live.feedback.append(report("one of many"))
        air.live.feedback.append(report("the last one"))
        with counted_turns() as turns:
            await send(air, number)
        return max(turns)


@contextmanager
def counted_turns() -> Iterator[list[int]]:
    """The numbers of calls in the turns of the event loop during the context."""
    turns, run = list[int](), Handle._run

    def count(_: FrameType, event: str, __: Any) -> None:
        turns[-1] += event in ("call", "c_call")

    def counted(handle: Any) -> None:
        turns.append(0)
        sys.setprofile(count)
        try:
            run(handle)
        finally:
            sys.setprofile(None)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Handle, "_run", counted)
        yield turns
