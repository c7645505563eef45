"""Captions: the texts of speeches with the times of their words, in the stream ``audio``."""

from xml.etree import ElementTree

import pytest

from .conftest import BML, Open

SAY = f'<bml {BML} id="b1"><speech id="s" start="0.5"><text>One,  two <sync id="m"/>three.</text></speech></bml>'
STOP = f'<bml {BML} id="b2" composition="REPLACE"/>'


async def test_a_speech_without_sound_has_only_a_caption_which_stops_at_the_word_that_feedback_gives(
    on_air: Open,
) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=audio,feedback")
        assert (await socket.ask(type="bml", xml=SAY))["type"] == "accepted"
        await air.tick()
        caption = await socket.hear("audio", "caption")
        words = caption.pop("words")
        assert caption == {
            "type": "caption",
            "character": "alice",
            "id": "alice-speech-1",
            "text": "One, two three.",
            "start": 0.5,
            "duration": 0.98,
            "gain": 1.0,
        }
        assert [caption["text"][first:last] for _, first, last in words] == ["One", "two", "three"]
        assert (await air.client.get("/audio/alice-speech-1.wav")).status == 404

        await air.tick_until(caption["start"] + words[1][0] + 0.1)
        late = await air.connect("?streams=audio")
        assert await late.hear("audio", "caption") == caption | {"words": words}
        await socket.ask(type="bml", xml=STOP)
        await air.tick()
        stop = await socket.hear("audio_stop")
        end = ElementTree.fromstring((await socket.hear_feedback("b1:s:end"))["xml"])
        begun = [word for word in words if caption["start"] + word[0] < stop["time"]]
        assert int(end.get("{urn:reactive-realizer:1}heard", "")) == begun[-1][2]


@pytest.mark.speech
async def test_the_caption_of_a_sound_comes_before_it_and_has_its_id(on_air: Open) -> None:
    async with on_air(voice="espeak") as air:
        socket = await air.connect("?streams=audio")
        await socket.ask(type="bml", xml=SAY)
        for _ in range(2):
            await air.tick()
        caption, sound = await socket.hear("audio", "caption"), await socket.hear("audio", "caption")
        assert [caption["type"], sound["type"]] == ["caption", "audio"]
        assert [caption[key] for key in ("id", "start", "duration")] == [
            sound[key] for key in ("id", "start", "duration")
        ]
