"""Accepts connections, up to limits in all and by address; an unused connection makes room for a new one."""

import asyncio
import errno
import logging
import resource
import socket

from aiohttp import web
from aiohttp.typedefs import Handler

from reactive_realizer.limits import Limits
from reactive_realizer.server.keys import USED
from reactive_realizer.server.security import is_loopback

logger = logging.getLogger(__name__)

_EXHAUSTED = frozenset((errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM))
"""Errors of accepting that last until connections have been closed."""
RETRY = 0.5
"""Time until connections are accepted again after such an error, s."""

_SOCKET_OPTIONS = {"TCP_KEEPIDLE": 30, "TCP_KEEPINTVL": 10, "TCP_KEEPCNT": 3, "TCP_USER_TIMEOUT": 60_000}
"""Options of Linux that end the connection of a client that has vanished or reads nothing after a minute."""


def listen(host: str, port: int) -> socket.socket:
    """Binds an address.

    Raises:
        OSError: the address is in use, or is none of this machine.
    """
    listening = socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    listening.setblocking(False)
    for name, value in _SOCKET_OPTIONS.items():
        if hasattr(socket, name):  # accepted connections inherit it
            listening.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)
    return listening


@web.middleware
async def count_used(request: web.Request, handler: Handler) -> web.StreamResponse:
    """Counts a connection as used until the answer has been sent, with which the task of the request ends."""
    used, task = request.app[USED], asyncio.current_task()
    if task is not None:
        used.add(request.protocol)
        task.add_done_callback(lambda _: used.discard(request.protocol))
    return await handler(request)


class Connections:
    """Accepts connections for an application, because aiohttp has no limit on their number.

    Args:
        app: with the middleware `count_used`.
        runner: of the application, set up.
        limits: on connections.
    """

    def __init__(self, app: web.Application, runner: web.AppRunner, limits: Limits) -> None:
        if runner.server is None:
            raise ValueError("the runner has not been set up")
        self._server = runner.server
        self._used = app[USED]
        self._most = _affordable(limits.connections)
        self._most_of_one = limits.connections_per_address
        self._exhausted = False

    async def accept(self, listening: socket.socket) -> None:
        """Accepts connections until it is canceled."""
        loop = asyncio.get_running_loop()
        while True:
            try:
                connection, (host, *_) = await loop.sock_accept(listening)
                self._exhausted = False
                if self._admits(host):
                    await loop.connect_accepted_socket(self._server, connection)
                else:
                    connection.close()
                    await asyncio.sleep(0)  # a crowd at the door must not hold up the session
            except OSError as problem:
                await self._report(problem)

    def _admits(self, host: str) -> bool:
        """Whether there is room for a connection, if need be that of the one that has been unused for longest."""
        connected = [each for each in self._server.connections if each.transport is not None]
        crowd = [] if is_loopback(host) else [each for each in connected if _host(each) == host]
        if len(connected) >= self._most:
            crowd = connected
        elif len(crowd) < self._most_of_one:
            return True
        unused = next((each for each in crowd if each not in self._used), None)
        if unused is not None:
            unused.force_close()
        return unused is not None

    async def _report(self, problem: OSError) -> None:
        """Waits, if descriptors or memory are exhausted; says so once, until a connection is accepted again."""
        if problem.errno not in _EXHAUSTED:
            return  # the client has gone
        if not self._exhausted:
            logger.error("no connections can be accepted for now: %s", problem)
        self._exhausted = True
        await asyncio.sleep(RETRY)


def _affordable(connections: int) -> int:
    """As many connections as there are descriptors, of which half remain for files, the voice and the session."""
    descriptors, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = descriptors // 2
    if descriptors == resource.RLIM_INFINITY or most >= connections:
        return connections
    logger.warning("%d open files are allowed, so at most %d connections are accepted (ulimit -n)", descriptors, most)
    return most


def _host(connection: web.RequestHandler) -> str | None:
    peer = connection.peername
    return None if peer is None else peer[0]
