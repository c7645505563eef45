"""Access control, and the security headers of every response."""

from collections.abc import Collection
from dataclasses import dataclass
from ipaddress import ip_address
from typing import Final
from urllib.parse import urlsplit

from aiohttp import web

from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import EmptyToken, ForeignHost, ForeignOrigin, ForeignPage, TokenRequired

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
    "Cross-Origin-Resource-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


@dataclass(frozen=True, slots=True)
class Security:
    """The access rules of a server.

    Attributes:
        host: the address that it is bound to.
        token: required of every client; None for no token, which only a server on the loopback interface may have.
        origins: origins of other pages that are accepted, ``http://localhost:3000``.

    Raises:
        RealizerError: "empty-token" or "token-required".
    """

    host: str = "127.0.0.1"
    token: str | None = None
    origins: Collection[str] = ()

    def __post_init__(self) -> None:
        if self.token is None and self.exposed:
            raise RealizerError(TokenRequired(host=self.host))
        if self.token is not None and not self.token.strip():
            raise RealizerError(EmptyToken())

    @property
    def exposed(self) -> bool:
        """Whether other machines can connect."""
        return not is_loopback(self.host)

    def check(self, request: web.Request) -> None:
        """Checks the host of a request, and the page that caused it.

        Raises:
            RealizerError: "foreign-host", "foreign-origin" or "foreign-page".
        """
        self._check_host(request)
        self._check_origin(request)
        _check_page(request)

    def cross_origin_headers(self, request: web.BaseRequest) -> dict[str, str]:
        """The headers that let a page of an accepted origin read the response."""
        origin = request.headers.get("Origin")
        if origin is None or origin not in self.origins:
            return {}
        return {
            "Access-Control-Allow-Origin": origin,
            "Access-Control-Allow-Headers": "Authorization, Content-Type, Last-Event-ID",
            "Vary": "Origin",
        }

    def _check_host(self, request: web.Request) -> None:
        """Accept only names and addresses of this machine.

        This prevents DNS rebinding, in which a foreign page reaches the server under a host name of its own.
        """
        name = _host_of(f"http://{request.host}")
        known = {self.host, *map(_host_of, self.origins)}
        named = name is not None and (name in known or is_loopback(name) or (self.exposed and _is_number(name)))
        if not named:
            raise RealizerError(ForeignHost(host=request.host))

    def _check_origin(self, request: web.Request) -> None:
        origin = request.headers.get("Origin")
        own = (f"http://{request.host}", f"https://{request.host}")
        if origin is not None and origin not in own and origin not in self.origins:
            raise RealizerError(ForeignOrigin(origin=origin))


def _check_page(request: web.Request) -> None:
    """Refuse what a page of another site embeds, such as a sound: browsers send no Origin then, but Sec-Fetch-Site.

    A link to the viewer may be followed from anywhere.
    """
    headers = request.headers
    own = headers.get("Sec-Fetch-Site", "none") in ("same-origin", "none") or "Origin" in headers
    followed = request.path == "/" and headers.get("Sec-Fetch-Dest") == "document"
    if not (own or followed):
        raise RealizerError(ForeignPage(path=request.path))


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


def is_loopback(host: str) -> bool:
    """Whether a name or an address is that of this machine for itself."""
    return host == "localhost" or (_is_number(host) and ip_address(host).is_loopback)
