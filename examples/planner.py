"""Sends a block to a server and prints the feedback until the block ends."""

import asyncio
from pathlib import Path

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback"


async def main(bml: str) -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket:
        await socket.send_json({"type": "bml", "xml": bml})
        async for message in socket:
            feedback = message.json().get("xml", "connected")
            print(feedback)
            if 'id="hello:end"' in feedback:
                return


asyncio.run(main(Path("examples/say_hello.xml").read_text(encoding="utf-8")))
