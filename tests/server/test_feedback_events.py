"""Feedback as server-sent events."""

import json
from collections.abc import AsyncIterator

from aiohttp import ClientResponse

from .conftest import ALICE, Open, report, wait


async def events(answer: ClientResponse) -> AsyncIterator[tuple[int, dict[str, object]]]:
    while line := (await answer.content.readline()).decode():
        data = (await answer.content.readline()).decode()
        assert await answer.content.readline() == b"\n"
        yield int(line.removeprefix("id: ")), json.loads(data.removeprefix("data: "))


async def test_events_are_the_numbered_feedback_of_the_socket(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        async with air.client.get("/feedback") as answer:
            assert answer.content_type == "text/event-stream"
            assert (await socket.ask(type="bml", xml=wait()))["type"] == "accepted"
            await air.tick_until(0.3)
            stream = events(answer)
            for _ in range(4):
                number, event = await anext(stream)
                assert event == await socket.hear("feedback")
                assert event["seq"] == number


async def test_events_resume_after_the_last_one_of_the_address_or_of_the_header(on_air: Open) -> None:
    async with on_air() as air:
        for n in range(4):
            air.live.feedback.append(report(str(n)))
        async with air.client.get("/feedback?after=2") as answer:
            assert (await anext(events(answer)))[0] == 3
        async with air.client.get("/feedback?after=2", headers={"Last-Event-ID": "3"}) as answer:
            assert (await anext(events(answer)))[0] == 4


async def test_lost_events_are_announced_before_those_that_are_kept(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nremembered_feedback = 1\n") as air:
        for n in range(4):
            air.live.feedback.append(report(str(n)))
        async with air.client.get("/feedback?after=1") as answer:
            assert await answer.content.readline() == b"event: gone\n"
            assert "up to 3" in (await answer.content.readline()).decode()
            assert await answer.content.readline() == b"\n"
            assert (await anext(events(answer)))[0] == 4


async def test_a_reader_that_does_not_read_is_disconnected(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nqueued_bytes = 1000000\n") as air:
        quick = await air.connect("?streams=feedback")
        async with air.client.get("/feedback") as slow:
            while len(air.live.feedback.subscribers) == 2:
                air.live.feedback.append(report("x" * 100_000))
                await air.tick()
                await quick.hear("feedback")
            assert slow.status == 200
        assert (await quick.ask(type="clock"))["type"] == "accepted"


async def test_a_reader_that_disconnects_is_removed(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        async with air.client.get("/feedback"):
            assert air.live.clients.number == 2
        while air.live.clients.number > 1:
            await socket.ask(type="clock")
        assert len(air.live.feedback.subscribers) == 1
