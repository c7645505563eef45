"""The check of the token that a server requires."""

import hmac

from aiohttp import web

from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import NoToken

COOKIE = "reactive-realizer-token"
"""The cookie in which the page keeps its token."""

PAUSE = 1.0
"""Time after a wrong token during which no further token from the same address is examined, s."""


class TokenCheck:
    """Compares the token of each request with that of the server.

    After a wrong token, further ones from its address are examined late, also the right one: otherwise, guessing would
    be as fast as the network, because a wrong token could be told by the missing answer.

    Args:
        token: required of every client; None for no token.
        clock: measures the pauses.
    """

    def __init__(self, token: str | None, clock: Clock) -> None:
        self._token = None if token is None else _bytes(token)
        self._clock = clock
        self._pauses: dict[str | None, GlobalTime] = {}
        """Address -> the end of its pause."""

    @property
    def required(self) -> bool:
        """Whether the server requires a token."""
        return self._token is not None

    async def check(self, request: web.Request) -> None:
        """Checks a request.

        Raises:
            RealizerError: "no-token".
        """
        if self._token is None:
            return
        shown = _shown(request)
        if not shown:
            raise RealizerError(NoToken())
        if (end := self._pauses.get(request.remote)) is not None and end > self._clock.now():
            await self._clock.wait_until(end)
        if not hmac.compare_digest(_bytes(shown), self._token):
            self._pause(request.remote)
            raise RealizerError(NoToken())

    def _pause(self, address: str | None) -> None:
        now = self._clock.now()
        self._pauses = {each: end for each, end in self._pauses.items() if end > now}
        self._pauses[address] = GlobalTime(now + PAUSE)


def _shown(request: web.Request) -> str:
    return _bearer(request) or request.query.get("token") or request.cookies.get(COOKIE, "")


def _bearer(request: web.Request) -> str:
    scheme, _, token = request.headers.get("Authorization", "").partition(" ")
    return token if scheme.lower() == "bearer" else ""


def _bytes(token: str) -> bytes:
    return token.encode("utf-8", "surrogateescape")
