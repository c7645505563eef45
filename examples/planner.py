import asyncio
from pathlib import Path

import aiohttp


async def main(bml: str) -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect("http://127.0.0.1:8088/ws?streams=feedback") as socket:
        await socket.send_json({"type": "bml", "xml": bml})
        async for message in socket:
            print(message.json().get("xml", "connected"))


asyncio.run(main(Path("examples/say_hello.xml").read_text(encoding="utf-8")))
