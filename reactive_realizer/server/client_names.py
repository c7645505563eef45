"""Names of clients, by which the realizer shares its work among them."""

from itertools import count
from weakref import WeakKeyDictionary

from aiohttp import web

from reactive_realizer.server.security import is_loopback


class ClientNames:
    """Names the sender of each request: all connections of another machine are one client.

    Those of this machine, also of a proxy on it, are a client each, because they are told apart by nothing else.
    """

    def __init__(self) -> None:
        self._numbers = count(1)
        self._local: WeakKeyDictionary[object, str] = WeakKeyDictionary()
        """By transport."""

    def of(self, request: web.Request) -> str:
        """The name of the client that has sent a request."""
        if request.remote is not None and not is_loopback(request.remote):
            return request.remote
        known = self._local.get(request.transport) if request.transport is not None else None
        name = f"local-{next(self._numbers)}" if known is None else known
        if request.transport is not None:
            self._local[request.transport] = name
        return name
