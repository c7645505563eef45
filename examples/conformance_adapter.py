"""Lets the conformance suite test a realizer over lines: a document of BML in each line of stdin, feedback on stdout.

``reactive-realizer conformance --program "python conformance_adapter.py URL"`` tests this realizer. An adapter for
another one sends the documents to that, and prints its feedback.
"""

import asyncio
import sys

from reactive_realizer.client.realizer_socket import RealizerSocket


async def main(url: str) -> None:
    """Carry documents and feedback until stdin ends."""
    async with RealizerSocket(url) as realizer, asyncio.TaskGroup() as group:
        printing = group.create_task(print_feedback(realizer))
        while document := await asyncio.to_thread(sys.stdin.readline):
            await realizer.send(type="bml", xml=document)
        printing.cancel()


async def print_feedback(realizer: RealizerSocket) -> None:
    """Print each feedback in a line."""
    while True:
        message = await realizer.receive()
        if message["type"] == "feedback":
            print(" ".join(message["xml"].splitlines()), flush=True)


if __name__ == "__main__":
    asyncio.run(main(sys.argv[1]))
