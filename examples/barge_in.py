"""Tells a story until the user barges in, finishes the current word, and prints what was heard."""

import asyncio
from xml.etree import ElementTree

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback"
OWN = "{urn:reactive-realizer:1}"
BML = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="talk">
  <speech id="words"><text>It is a long story, and nobody has ever heard the end of it.</text></speech>
</bml>
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="yield">
  <bmla:interrupt id="stop" target="talk" speech="word" start="anticipators:user:barges_in"/>
  <head id="nod" lexeme="NOD" start="stop:start"/>
</bml>
"""


async def barge_in(socket: aiohttp.ClientWebSocketResponse) -> None:
    """Stand in for a voice detector: predict once, after a second."""
    await asyncio.sleep(1.0)
    await socket.send_json({"type": "predict", "anticipator": "user", "sync": "barges_in", "in": 0})


async def main() -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket, asyncio.TaskGroup() as tasks:
        # Withdraw the prediction of an earlier run.
        await socket.send_json({"type": "predict", "anticipator": "user", "sync": "barges_in", "time": None})
        await socket.send_json({"type": "bml", "xml": BML, "ref": "story"})
        async for message in socket:
            received = message.json()
            if received["type"] == "error":
                raise SystemExit(received["message"])
            if received["type"] != "feedback":
                continue
            feedback = ElementTree.fromstring(received["xml"])
            if feedback.get("id") == "talk:words:start":
                tasks.create_task(barge_in(socket))
            if feedback.get("id") == "talk:words:end":
                print(f"heard {feedback.get(OWN + 'heard')} characters, up to the word {feedback.get(OWN + 'text')!r}")
            if feedback.get("id") == "yield:end":
                return


asyncio.run(main())
