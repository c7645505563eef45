"""Has the virtual human speak with a voice from elsewhere, whose sound arrives as it is generated.

    python examples/cloud_voice.py SOUND.wav "What the sound says."

The file (mono, 16 bits) stands in for the service of a cloud voice. Without a text, only the lips move.
"""

import asyncio
import sys
import wave
from base64 import b64encode
from collections.abc import AsyncIterator
from uuid import uuid4
from xml.etree import ElementTree
from xml.sax.saxutils import escape

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback&predictions=0"
OWN = "{urn:reactive-realizer:1}"
SAY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:rr="urn:reactive-realizer:1" id="{id}">
  <speech id="words" rr:words="true">
    <text>{text}</text>
    <description priority="1" type="audio/x-stream"><rr:stream name="{id}" rate="{rate}"/></description>
  </speech>
</bml>
"""


async def made_in_the_cloud(sound: wave.Wave_read) -> AsyncIterator[bytes]:
    """The sound in pieces of 0.1 s, three times as fast as it is spoken; request them from your voice instead."""
    while samples := sound.readframes(sound.getframerate() // 10):
        yield samples
        await asyncio.sleep(0.033)


async def send(socket: aiohttp.ClientWebSocketResponse, stream: str, sound: wave.Wave_read) -> None:
    async for samples in made_in_the_cloud(sound):
        await socket.send_json({"type": "speech", "stream": stream, "audio": b64encode(samples).decode()})
    await socket.send_json({"type": "speech", "stream": stream, "end": True})


async def main(file: str, text: str = "") -> None:
    block = f"say{uuid4().hex}"
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket, asyncio.TaskGroup() as tasks:
        with wave.open(file) as sound:
            bml = SAY.format(id=block, text=escape(text), rate=sound.getframerate())
            await socket.send_json({"type": "bml", "xml": bml})
            sending = tasks.create_task(send(socket, block, sound))
            async for message in socket:
                received = message.json()
                if received["type"] == "error":
                    raise SystemExit(received["message"])
                if received["type"] != "feedback":
                    continue
                feedback = ElementTree.fromstring(received["xml"])
                id_ = feedback.get("id", "")
                if feedback.tag.endswith("warningFeedback"):
                    print(feedback.text, file=sys.stderr)
                elif id_.startswith(f"{block}:words:word"):
                    print(f"{float(feedback.get('time', 0)):5.2f} s  {feedback.get(OWN + 'text')}")
                elif id_ == f"{block}:words:end":
                    print(f"{float(feedback.get('time', 0)):5.2f} s  heard {feedback.get(OWN + 'heard')} characters")
                elif id_ == f"{block}:end":
                    sending.cancel()
                    return


if __name__ == "__main__":
    asyncio.run(main(*sys.argv[1:]))
