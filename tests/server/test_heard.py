"""Reports of clients on what is heard."""

from typing import Any

import pytest

from reactive_realizer.embodiment.audio import AudioHeard

from .conftest import BML, OnAir, Open, Socket

pytestmark = pytest.mark.speech

TEXT = "It is a long story, and nobody has ever heard the end of it, or will."
SPEECH = f'<bml {BML} id="b"><speech id="s"><text>{TEXT}</text></speech></bml>'


class Talk:
    """A speech that plays, and a client that hears it."""

    def __init__(self, air: OnAir, socket: Socket, sound: dict[str, Any]) -> None:
        self.air = air
        self.socket = socket
        self.sound = sound
        self.inputs: list[AudioHeard] = []
        air.live.realizer.record(
            lambda entered: self.inputs.extend(each for each in entered.inputs if isinstance(each, AudioHeard))
        )

    async def report(self, late: float, socket: Socket | None = None, after: float = 0.2) -> dict[str, Any]:
        """The answer to a report, after some time, that the sound is late."""
        await self.air.tick_until(self.air.live.now + after)
        now = self.air.live.now
        position = round(now - self.sound["start"] - late, 6)
        return await (socket or self.socket).ask(type="heard", id=self.sound["id"], position=position, time=now)


async def talk(air: OnAir) -> Talk:
    socket = await air.connect("?streams=audio,feedback")
    await socket.say(type="bml", xml=SPEECH)
    while (sound := await next_sound(air, socket)) is None:
        pass
    await air.tick_until(sound["start"] + 1.0)
    return Talk(air, socket, sound)


async def next_sound(air: OnAir, socket: Socket) -> dict[str, Any] | None:
    await air.tick()
    await socket.say(type="ping", t=0)
    message = await socket.hear("audio", "pong")
    return message if message["type"] == "audio" else None


async def test_a_client_that_hears_the_speech_late_moves_it(on_air: Open) -> None:
    async with on_air(voice="espeak") as air:
        told = await talk(air)
        for _ in range(2):
            assert (await told.report(0.2))["type"] == "accepted"
        await air.tick()
        move = await told.socket.hear("audio_move")
        start = pytest.approx(told.sound["start"] + 0.2)
        now = air.live.realizer.time
        assert move == {"type": "audio_move", "id": "alice-speech-1", "start": start, "time": now}
        late = await air.connect("?streams=audio")
        assert (await late.hear("audio"))["start"] == move["start"]


@pytest.mark.parametrize(
    ("late", "code"), [(1.01, "far-off"), (-1.01, "far-off"), (-9.0, "outside-sound")], ids=["late", "early", "outside"]
)
async def test_what_cannot_be_heard_is_refused(on_air: Open, late: float, code: str) -> None:
    async with on_air(voice="espeak") as air:
        told = await talk(air)
        answer = await told.report(late)
        assert (answer["type"], answer["code"]) == ("error", code)
        assert (await told.report(0.0))["type"] == "accepted"


async def test_the_first_client_leads_until_it_is_silent(on_air: Open) -> None:
    async with on_air(voice="espeak") as air:
        told = await talk(air)
        other = await air.connect("?streams=audio")
        for _ in range(3):
            assert (await told.report(0.0))["type"] == "accepted"
            assert (await told.report(0.5, other, 0.0))["type"] == "accepted"
        await air.tick()
        assert [round(each.time - each.position - told.sound["start"], 3) for each in told.inputs] == [0.0] * 3
        await air.tick_until(air.live.now + 1.1)
        await told.report(0.3, other)
        await told.report(0.0)
        await air.tick()
        assert round(told.inputs[-1].time - told.inputs[-1].position - told.sound["start"], 3) == 0.3


async def test_reports_in_quick_succession_count_once(on_air: Open) -> None:
    async with on_air(voice="espeak") as air:
        told = await talk(air)
        for _ in range(50):
            await told.report(0.3, after=0.0)
        await air.tick()
        assert len(told.inputs) == 1


async def test_a_report_on_a_sound_that_has_ended_has_no_effect(on_air: Open) -> None:
    async with on_air(voice="espeak") as air:
        told = await talk(air)
        await told.socket.say(type="bml", xml=f'<bml {BML} id="r" composition="REPLACE"/>')
        await told.socket.say(type="clock")
        await told.socket.hear("clock")
        assert (await told.report(0.3))["type"] == "accepted"
        await air.tick()
        assert told.inputs == []
