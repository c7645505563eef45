"""Clients that a server starts beside itself, such as bridges."""

import asyncio
import logging
from collections.abc import AsyncIterator, Callable, Coroutine, Iterable
from contextlib import asynccontextmanager
from typing import Any, NamedTuple

from reactive_realizer.errors import RealizerError

logger = logging.getLogger(__name__)

_PATIENCE = 2.0
"""Time that clients have to end when the server does, s."""


class OwnClient(NamedTuple):
    """A client of the server in its process, which connects as any other.

    Attributes:
        name: for the log.
        run: is given the URL of the server, with its token; it is canceled when the server ends.
    """

    name: str
    run: Callable[[str], Coroutine[Any, Any, None]]


@asynccontextmanager
async def accompanied(clients: Iterable[OwnClient], url: str) -> AsyncIterator[None]:
    """Run clients meanwhile. The end of one is logged, and ends nothing else; one that does not end is left behind."""
    # Not in a TaskGroup, which would wait for a client that does not end.
    tasks = [asyncio.create_task(_run(client, url)) for client in clients]  # noqa: TID251
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks, timeout=_PATIENCE)


async def _run(client: OwnClient, url: str) -> None:
    task = asyncio.current_task()
    assert task is not None
    try:
        await client.run(url)
    except RealizerError as problem:
        logger.error("the bridge %s has ended: %s", client.name, problem.fault.sentence)
    except OSError as problem:
        logger.error("the bridge %s has ended: %s", client.name, problem)
    except (Exception, SystemExit, asyncio.CancelledError) as problem:
        if isinstance(problem, asyncio.CancelledError) and task.cancelling():
            raise  # the server cancels it; otherwise, what it waited for was canceled
        logger.exception("the bridge %s has failed", client.name)
    else:
        logger.info("the bridge %s has ended", client.name)
