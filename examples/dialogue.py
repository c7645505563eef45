"""Explains the way to somebody who types: a line interrupts what is being said, and the answer knows what was heard.

The present word is finished first, except for a line that ends with an exclamation mark: that interrupts at once. A
line about a place of the way is answered; after any other line, what has not been heard yet is said. The program ends
with its input (Ctrl-D), when all has been said.
"""

import asyncio
import sys
import threading
from uuid import uuid4
from xml.etree import ElementTree
from xml.sax.saxutils import escape

import aiohttp

ADDRESS = "http://127.0.0.1:8088/ws?streams=feedback&predictions=0"
OWN = "{urn:reactive-realizer:1}"
SAY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="{id}">
  <speech id="words"><text>{text}</text></speech>
</bml>
"""
INTERRUPT = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="after-{id}">
  <bmla:interrupt id="stop" target="{id}" speech="{when}"/>
  <head id="nod" lexeme="NOD" start="stop:start"/>
</bml>
"""
WAY = {
    "door": "first you take the left door",
    "river": "then you follow the river",
    "mill": "at the old mill you turn right",
    "museum": "and there is the museum, which is closed on Mondays",
}


def reply(line: str, heard: str) -> str:
    """Returns the answer to a line, given the part of the way that was heard."""
    asked = next((step for place, step in WAY.items() if place in line.lower()), None)
    told = [step for step in WAY.values() if step.lower() in heard.lower()]
    rest = ", ".join(step for step in WAY.values() if step not in told and step != asked)
    if asked is None:
        opening = "All right." if line else "Welcome."
    else:
        opening = f"As I said, {asked}." if asked in told else f"I was coming to that: {asked}."
    return f"{opening} {rest[0].upper()}{rest[1:]}." if rest else opening


class Speaker:
    """Says one text at a time.

    Attributes:
        heard: the part of the present text that was heard, when it has ended.
    """

    heard: asyncio.Future[str]

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self.socket = socket
        self.block = self.text = ""

    async def say(self, text: str) -> None:
        self.block, self.text, self.characters = f"say{uuid4().hex}", " ".join(text.split()), 0
        self.heard = asyncio.get_running_loop().create_future()
        print(f"says:  {self.text}")
        await self.socket.send_json({"type": "bml", "xml": SAY.format(id=self.block, text=escape(self.text))})

    async def interrupt(self, when: str) -> None:
        """Ends the speech if it goes on: at the end of the present 'word', or 'now'."""
        if not self.heard.done():
            await self.socket.send_json({"type": "bml", "xml": INTERRUPT.format(id=self.block, when=when)})

    async def listen(self) -> None:
        """Reads the messages of the server."""
        async for message in self.socket:
            received = message.json()
            if received["type"] == "error":
                raise SystemExit(received["message"])
            if received["type"] == "feedback":
                self.take(ElementTree.fromstring(received["xml"]))
        raise SystemExit("the server has closed the connection")

    def take(self, feedback: ElementTree.Element) -> None:
        block, _, point = feedback.get("id", "").partition(":")
        if block != self.block:
            return
        if feedback.tag.endswith("warningFeedback"):
            print(feedback.text, file=sys.stderr)
        elif point == "words:end":
            self.characters = int(feedback.get(OWN + "heard", 0))
        elif point == "end":  # comes exactly once, also if nothing could be said
            print(f"heard: {self.text[: self.characters]}")
            self.heard.set_result(self.text[: self.characters])


def read_lines(typed: "asyncio.Queue[str | None]", loop: asyncio.AbstractEventLoop) -> None:
    """Puts the lines of the standard input into a queue, and None at its end."""
    for line in sys.stdin:
        loop.call_soon_threadsafe(typed.put_nowait, line.strip())
    loop.call_soon_threadsafe(typed.put_nowait, None)


async def converse(speaker: Speaker) -> None:
    typed: asyncio.Queue[str | None] = asyncio.Queue()
    # A daemon thread, because a program cannot end while another thread waits for a line.
    threading.Thread(target=read_lines, args=(typed, asyncio.get_running_loop()), daemon=True).start()
    line: str | None = ""
    heard = ""
    while line is not None:
        await speaker.say(reply(line, heard))
        line = await typed.get()
        if line is not None:
            await speaker.interrupt("now" if line.endswith("!") else "word")
        heard += await speaker.heard + "\n"


async def main() -> None:
    async with aiohttp.ClientSession() as http, http.ws_connect(ADDRESS) as socket, asyncio.TaskGroup() as tasks:
        speaker = Speaker(socket)
        listening = tasks.create_task(speaker.listen())
        await converse(speaker)
        listening.cancel()


asyncio.run(main())
