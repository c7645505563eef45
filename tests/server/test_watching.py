"""What those who run a server watch: health, readiness and metrics; and its end."""

import asyncio
import re

import pytest

from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.keys import INTAKE
from reactive_realizer.server.security import Security
from reactive_realizer.server.serve import drain

from .conftest import ALICE, OnAir, Open, post, report, wait

LOCKED = Security(token="s3cret")


async def status(air: OnAir, path: str) -> int:
    async with air.client.get(path) as answer:
        return answer.status


async def test_a_server_is_healthy_while_it_ticks(on_air: Open) -> None:
    async with on_air() as air:
        await air.tick()
        assert await status(air, "/health") == 200
        assert isinstance(air.live.clock, ManualClock)
        await air.live.clock.wait_until(GlobalTime(6.0))
        assert await status(air, "/health") == 503


async def test_health_and_readiness_need_no_token_but_metrics_do(on_air: Open) -> None:
    async with on_air(security=LOCKED) as air:
        assert [await status(air, path) for path in ("/health", "/ready", "/metrics")] == [200, 200, 401]


async def test_metrics_are_in_the_text_format_of_prometheus(on_air: Open) -> None:
    async with on_air() as air:
        await air.connect()
        await post(air, "/bml", wait("b1", 0.1) + wait("b2", 9))
        await air.tick_until(0.5)
        async with air.client.get("/metrics") as answer:
            assert answer.headers["Content-Type"].startswith("text/plain; version=0.0.4")
            lines = (await answer.text()).splitlines()
    samples = dict(line.rsplit(" ", 1) for line in lines if not line.startswith("#"))
    assert all(re.fullmatch(r'realizer_\w+({\w+="[\w.]+"})?', name) for name in samples)
    assert float(samples["realizer_ticks_total"]) == 50
    assert float(samples["realizer_clients"]) == 1
    assert float(samples['realizer_blocks{state="IN_EXEC"}']) == 1
    assert float(samples['realizer_tick_lateness_seconds{quantile="0.99"}']) == pytest.approx(0.0, abs=1e-9)
    described = {line.split()[2] for line in lines if line.startswith("# TYPE")}
    assert {name.partition("{")[0] for name in samples} <= described


async def samples_of(air: OnAir) -> dict[str, float]:
    async with air.client.get("/metrics") as answer:
        lines = (await answer.text()).splitlines()
    return {name: float(value) for name, value in (line.rsplit(" ", 1) for line in lines if not line.startswith("#"))}


async def test_metrics_count_the_blocks_that_wait_for_the_work_of_a_tick(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nplanning_per_tick = 50\n") as air:
        for number in range(5):
            await post(air, "/bml", wait(f"b{number}", 9))
        counts = []
        for _ in range(40):
            await air.tick()
            counts.append((await samples_of(air))["realizer_unplanned_blocks"])
        assert counts[0] > 0
        assert counts == sorted(counts, reverse=True)
        assert counts[-1] == 0


async def test_metrics_tell_what_waits_to_be_sent_to_all_clients_and_to_the_slowest(on_air: Open) -> None:
    async with on_air() as air:
        slow, quick = [await air.connect("?streams=feedback") for _ in range(2)]
        sent, samples = 0, await samples_of(air)
        assert samples["realizer_queued_bytes"] == 0
        while samples["realizer_longest_queue_messages"] < 3:
            air.live.feedback.append(report("x" * 100_000))
            sent += 1
            await quick.hear("feedback")
            samples = await samples_of(air)
        assert samples["realizer_longest_queue_bytes"] > 300_000
        assert samples["realizer_queued_bytes"] == samples["realizer_longest_queue_bytes"]
        for _ in range(sent):
            await slow.hear("feedback")
        assert (await samples_of(air))["realizer_queued_bytes"] == 0


async def test_a_server_that_shuts_down_refuses_new_blocks_and_reports_the_end_of_those_that_play(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        await post(air, "/bml", wait("b", 9))
        await air.tick()
        draining = asyncio.ensure_future(drain(air.live, air.client.app[INTAKE]))
        await asyncio.sleep(0)
        assert await status(air, "/ready") == 503
        refused, answer = await post(air, "/bml", wait("late"))
        assert (refused, answer["error"]["code"]) == (503, "going-away")
        assert (await socket.ask(type="bml", xml=wait("later")))["code"] == "going-away"
        while not draining.done():
            await air.tick()
            await asyncio.sleep(0)
        assert "INTERRUPTED" in (await socket.hear_feedback('id="b:end"'))["xml"]


async def test_behind_a_proxy_the_public_address_is_known_by_its_origin(on_air: Open) -> None:
    async with on_air(security=Security(token="s3cret", origins=("https://avatar.example",))) as air:
        public = {"Host": "avatar.example", "Origin": "https://avatar.example", "Authorization": "Bearer s3cret"}
        async with air.client.get("/status", headers=public) as answer:
            assert answer.status == 200
