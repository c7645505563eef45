"""Who is let in, and what a page from here may do."""

import hmac
from collections.abc import Collection
from dataclasses import dataclass
from ipaddress import ip_address
from typing import Final
from urllib.parse import urlsplit

from aiohttp import web

from reactive_realizer.errors import error

HEADERS: Final = {
    "Content-Security-Policy": "; ".join(
        (
            "default-src 'none'",
            "script-src 'self'",
            "style-src 'self'",
            "img-src 'self' blob: data:",
            "font-src 'self'",
            "media-src 'self' blob:",
            "connect-src 'self' blob:",  # three.js fetches the textures inside a GLB as blobs
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        )
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}
COOKIE = "reactive-realizer-token"
"""Where the page keeps the token that it was opened with."""


@dataclass(frozen=True, slots=True)
class Security:
    """What a server asks of those who come.

    Attributes:
        host: the address that it is bound to.
        token: that everybody must show; None: nobody must.
        origins: of other pages that are let in, ``http://localhost:3000``.
    """

    host: str = "127.0.0.1"
    token: str | None = None
    origins: Collection[str] = ()

    @property
    def exposed(self) -> bool:
        """Whether other machines can come."""
        return not _is_loopback(self.host)

    def check(self, request: web.Request) -> None:
        """Let a request in.

        Raises:
            RealizerError: "foreign-host", "foreign-origin" or "no-token".
        """
        self._check_host(request)
        self._check_origin(request)
        # A browser asks whether a page may send a token before it sends one.
        if self.token is not None and request.method != "OPTIONS":
            self._check_token(request, self.token)

    def cross_origin_headers(self, request: web.BaseRequest) -> dict[str, str]:
        """What lets a page of an allowed origin read the answer."""
        origin = request.headers.get("Origin")
        if origin is None or origin not in self.origins:
            return {}
        return {
            "Access-Control-Allow-Origin": origin,
            "Access-Control-Allow-Headers": "Authorization, Content-Type, Last-Event-ID",
            "Vary": "Origin",
        }

    def _check_host(self, request: web.Request) -> None:
        """A name of this machine, or its number: a page elsewhere that had its own name resolve to here has neither.

        See DNS rebinding.
        """
        name = _host_of(f"http://{request.host}")
        known = {self.host, *map(_host_of, self.origins)}
        named = name is not None and (name in known or _is_loopback(name) or (self.exposed and _is_number(name)))
        if not named:
            raise error("foreign-host", host=request.host)

    def _check_origin(self, request: web.Request) -> None:
        origin = request.headers.get("Origin")
        own = (f"http://{request.host}", f"https://{request.host}")
        if origin is not None and origin not in own and origin not in self.origins:
            raise error("foreign-origin", origin=origin)

    def _check_token(self, request: web.Request, token: str) -> None:
        shown = _bearer(request) or request.query.get("token") or request.cookies.get(COOKIE, "")
        if not hmac.compare_digest(shown.encode("utf-8", "surrogateescape"), token.encode()):
            raise error("no-token")


def _bearer(request: web.Request) -> str:
    scheme, _, token = request.headers.get("Authorization", "").partition(" ")
    return token if scheme.lower() == "bearer" else ""


def _host_of(url: str) -> str | None:
    try:
        return urlsplit(url).hostname
    except ValueError:
        return None


def _is_number(host: str) -> bool:
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def _is_loopback(host: str) -> bool:
    return host == "localhost" or (_is_number(host) and ip_address(host).is_loopback)
