"""Receives an event that a behavior emits, and answers with an event that a behavior waits for."""

import asyncio
from xml.etree import ElementTree

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback"
OWN = "{urn:reactive-realizer:1}"
BML = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="ask">
  <speech id="question"><text>Do you know the way?</text></speech>
  <bmla:emit id="asked" event="asked" start="question:end">the way</bmla:emit>
  <wait id="patience" event="answered" start="question:end" max-wait="5"/>
  <head id="nod" lexeme="NOD" start="patience:end"/>
</bml>
"""


async def main() -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket:
        await socket.send_json({"type": "bml", "xml": BML})
        async for message in socket:
            feedback = ElementTree.fromstring(message.json().get("xml", "<none/>"))
            event = feedback.find(OWN + "event")
            if event is not None:
                print(f"{event.get('name')}: {event.text}")
                await socket.send_json({"type": "event", "anticipator": "events", "event": "answered"})
            if feedback.get("id") == "ask:patience:end":
                print(f"the wait ended with its {feedback.get(OWN + 'ended')}")
            if feedback.get("id") == "ask:end":
                return


asyncio.run(main())
