"""Sends a gesture whose stroke is tied to a prediction, and moves the prediction while the arm moves."""

import asyncio
import re

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback"
BML = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="together">
  <gesture id="clap" lexeme="BEAT" mode="BOTH_HANDS" stroke="anticipators:partner:hit"/>
</bml>
"""


async def main() -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket:
        await socket.send_json({"type": "predict", "anticipator": "partner", "sync": "hit", "in": 2.0})
        await socket.send_json({"type": "bml", "xml": BML})
        async for message in socket:
            feedback = message.json().get("xml", "")
            if "together:clap:start" in feedback:  # the hands have started: the partner is late
                await socket.send_json({"type": "predict", "anticipator": "partner", "sync": "hit", "in": 2.0})
            if "Progress" in feedback and (point := re.search(r' id="(.+?)".* globalTime="(.+?)"', feedback)):
                print(*point.groups())
            if "together:end" in feedback:
                return


asyncio.run(main())
