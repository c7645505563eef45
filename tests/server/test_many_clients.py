"""Clients that connect late, reconnect, do not read, or exceed the limit."""

import aiohttp
import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioClip, AudioGain, AudioMove, AudioStart, AudioStop, Sound
from reactive_realizer.server import client_limits

from .conftest import ALICE, BML, XML, OnAir, Open, report, wait


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Clients that do not read are dropped sooner than usual."""
    monkeypatch.setattr(client_limits, "_PATIENCE", 2)


def clip(id_: str, start: float) -> AudioStart:
    return AudioStart("alice", AudioClip(id_, Sound(b"RIFF" + id_.encode(), 2.0)), GlobalTime(start))


async def test_sounds_are_announced_and_can_be_fetched(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        air.live.sounds.take(clip("c1", 0.5))
        told = await socket.hear("audio")
        assert told | {"url": ""} == {
            "type": "audio",
            "character": "alice",
            "id": "c1",
            "url": "",
            "start": 0.5,
            "duration": 2.0,
            "gain": 1.0,
        }
        async with air.client.get(told["url"]) as answer:
            assert answer.content_type == "audio/wav"
            assert await answer.read() == b"RIFFc1"
        air.live.sounds.take(AudioMove("c1", GlobalTime(0.75), GlobalTime(0.6)))
        assert await socket.hear("audio_move") == {"type": "audio_move", "id": "c1", "start": 0.75, "time": 0.6}
        air.live.sounds.take(AudioGain("c1", 1.5, GlobalTime(0.8)))
        assert await socket.hear("audio_gain") == {"type": "audio_gain", "id": "c1", "gain": 1.5, "time": 0.8}
        air.live.sounds.take(AudioStop("c1", GlobalTime(1.0), 0.03))
        assert await socket.hear("audio_stop") == {"type": "audio_stop", "id": "c1", "time": 1.0, "fade": 0.03}


async def test_a_late_client_gets_the_current_state_of_sounds_that_have_not_ended(on_air: Open) -> None:
    async with on_air() as air:
        sounds = air.live.sounds
        for change in (
            clip("over", 0.0),
            clip("stopped", 0.5),
            AudioStop("stopped", GlobalTime(0.6), 0.1),
            clip("moved", 1.0),
            AudioMove("moved", GlobalTime(2.5), GlobalTime(2.0)),
            AudioGain("moved", 0.5, GlobalTime(2.8)),
            clip("ending", 2.0),
            AudioStop("ending", GlobalTime(3.5), 0.1),
        ):
            sounds.take(change)
        await air.tick_until(3.0)
        late = await air.connect()
        told = [await late.hear("audio", "audio_stop") for _ in range(3)]
        assert [(message["type"], message["id"]) for message in told] == [
            ("audio", "moved"),
            ("audio", "ending"),
            ("audio_stop", "ending"),
        ]
        assert told[0]["start"] == 2.5
        assert [message["gain"] for message in told[:2]] == [0.5, 1.0]


async def test_a_sound_is_sent_ahead_of_its_announcement_to_clients_that_request_it(on_air: Open) -> None:
    async with on_air() as air:
        listener, planner = await air.connect("?streams=audio,sound"), await air.connect("?streams=audio")
        air.live.sounds.take(clip("c1", 1.0))
        first, second = await listener.raw.receive(), await listener.raw.receive()
        assert first.data == b"\x02\x01\x02\x00c1" + b"RIFFc1"
        assert '"type":"audio"' in second.data
        assert (await planner.hear())["type"] == "audio"


async def test_a_long_sound_is_only_announced(on_air: Open) -> None:
    async with on_air() as air:
        listener = await air.connect("?streams=audio,sound")
        air.live.sounds.take(AudioStart("alice", AudioClip("long", Sound(bytes(2_000_000), 60.0)), None))
        message = await listener.hear()
        assert (message["type"], message["start"]) == ("audio", None)


async def test_a_sound_is_kept_for_a_short_time_after_its_end(on_air: Open) -> None:
    async with on_air() as air:
        air.live.sounds.take(clip("c1", 0.0))
        await air.tick_until(5.0)
        async with air.client.get("/audio/c1.wav") as answer:
            assert answer.status == 200
        await air.tick_until(13.0)
        async with air.client.get("/audio/c1.wav") as answer:
            assert answer.status == 404
            assert (await answer.json())["error"]["code"] == "no-clip"


async def test_the_oldest_sounds_are_removed_above_the_limit(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nsound_bytes = 13\n") as air:
        for id_ in ("c1", "c2", "c3"):
            air.live.sounds.take(clip(id_, 0.0))
        await air.tick()
        assert [air.live.sounds.wav(id_) is None for id_ in ("c1", "c2", "c3")] == [True, False, False]


async def test_a_late_client_gets_frames_and_feedback_from_now_on(on_air: Open) -> None:
    async with on_air() as air:
        air.live.feedback.append(report("before"))
        await air.tick_until(1.0)
        late = await air.connect()
        air.live.feedback.append(report("after"))
        assert "after" in (await late.hear("feedback"))["xml"]
        await air.tick_until(1.02)
        assert await late.see()


async def test_a_client_that_reconnects_gets_the_feedback_that_it_missed(on_air: Open) -> None:
    async with on_air() as air:
        for n in range(1, 6):
            air.live.feedback.append(report(f"number {n}"))
        back = await air.connect("?after=3")
        assert back.hello["session"] == air.live.session
        assert [(await back.hear("feedback"))["seq"] for _ in range(2)] == [4, 5]
        air.live.feedback.append(report("number 6"))
        assert (await back.hear("feedback"))["seq"] == 6


async def test_a_client_that_reconnects_too_late_is_told_which_feedback_is_lost(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nremembered_feedback = 2\n") as air:
        for n in range(5):
            air.live.feedback.append(report(str(n)))
        back = await air.connect("?after=1")
        assert (await back.hear("error"))["code"] == "feedback-gone"
        assert (await back.hear("feedback"))["seq"] == 4


async def test_feedback_is_also_kept_up_to_a_total_size(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nremembered_feedback_bytes = 30000\n") as air:
        for letter in "abcde":
            air.live.feedback.append(report(letter * 10_000))
        assert air.live.feedback.forgotten == 3


async def test_all_feedback_that_is_kept_can_be_resumed_at_once(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nremembered_feedback = 50\nqueued_messages = 10\n") as air:
        for n in range(50):
            air.live.feedback.append(report(str(n)))
        back = await air.connect("?after=0")
        assert [(await back.hear("feedback"))["seq"] for _ in range(50)] == list(range(1, 51))


async def slow_reader(air: OnAir, text: str) -> tuple[int, int | None]:
    """The number of messages that a client got which did not read until it was closed, and its close code."""
    slow, quick = await air.connect("?streams=feedback"), await air.connect("?streams=feedback")
    sent = 0
    while len(air.live.feedback.subscribers) == 2:
        air.live.feedback.append(report(text))
        sent += 1
        assert (await quick.hear("feedback"))["seq"] == sent, "the quick client misses nothing"
    got = [message async for message in slow.raw if message.type is aiohttp.WSMsgType.TEXT]
    assert (await quick.ask(type="clock"))["type"] == "accepted"
    return len(got), slow.raw.close_code


async def test_a_client_that_does_not_read_is_closed_and_the_others_get_everything(
    on_air: Open, impatient: None
) -> None:
    async with on_air(ALICE + "[limits]\nqueued_bytes = 1000000\n") as air:
        got, code = await slow_reader(air, "x" * 100_000)
        assert got > 0
        assert code == 1013


async def test_a_client_with_too_many_messages_waiting_is_closed(on_air: Open, impatient: None) -> None:
    async with on_air(ALICE + "[limits]\nqueued_messages = 20\n") as air:
        _, code = await slow_reader(air, "x" * 100_000)
        assert code == 1013


async def test_a_closed_client_can_resume_where_it_stopped(on_air: Open, impatient: None) -> None:
    async with on_air(ALICE + "[limits]\nqueued_messages = 20\n") as air:
        got, _ = await slow_reader(air, "x" * 100_000)
        back = await air.connect(f"?after={got}")
        assert (await back.hear("feedback"))["seq"] == got + 1


async def test_clients_above_the_limit_are_refused(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nclients = 2\n") as air:
        one = await air.connect()
        async with air.client.get("/feedback"):
            with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
                await air.connect()
            assert refused.value.status == 503
            async with air.client.get("/feedback") as answer:
                assert (await answer.json())["error"]["code"] == "too-many-clients"
        await one.raw.close()
        assert (await air.connect()).hello


async def test_a_client_that_floods_a_character_does_not_delay_the_block_of_another_client(on_air: Open) -> None:
    async with on_air() as air:
        flooding, quiet = await air.connect(), await air.connect("?streams=feedback")
        nods = "".join(f'<head id="h{i}" lexeme="NOD"/>' for i in range(5))
        flood = "".join(f'<bml {BML} id="f{i}" composition="APPEND">{nods}</bml>' for i in range(200))
        await flooding.ask(type="bml", xml=flood)
        await air.tick()
        assert (await quiet.ask(type="bml", xml=wait("small")))["blocks"] == ["small"]
        await air.tick()
        assert 'globalTime="0.01"' in (await quiet.hear_feedback('"small:start"'))["xml"]
        assert air.live.realizer.scheduler.unplanned > 100


async def test_a_client_that_has_half_of_the_blocks_leaves_the_others_to_other_clients(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 20\n") as air:
        greedy, other = await air.connect(), await air.connect()
        answers = [await greedy.ask(type="bml", xml=wait(f"g{i}", 9)) for i in range(12)]
        assert [each["type"] for each in answers] == ["accepted"] * 11 + ["error"]
        assert answers[-1]["code"] == "too-many-of-one"
        assert (await other.ask(type="bml", xml=wait("small")))["type"] == "accepted"
        async with air.client.post("/bml", data=wait("posted"), headers=XML) as answer:
            assert answer.status == 202
        await air.tick()
        assert (await greedy.ask(type="bml", xml=wait("g12")))["code"] == "too-many-of-one"
        await air.tick()
        alive = {block.key.block for block in air.live.realizer.scheduler.blocks.alive}
        assert alive == {*(f"g{i}" for i in range(11)), "small", "posted"}


async def test_all_clients_are_disconnected_when_the_server_ends(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert (await socket.ask(type="bml", xml=wait()))["type"] == "accepted"
        async with air.client.get("/feedback") as stream:
            await air.client.app.shutdown()
            assert await stream.read() == b""
        assert await socket.close_code() == 1001
