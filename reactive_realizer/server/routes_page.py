"""Routes of the page and the files that it loads: avatars, pictures, sounds, the schema. No other assets are served."""

import asyncio
from io import BytesIO
from mimetypes import guess_type
from pathlib import Path
from typing import Final

from aiohttp import web
from aiohttp.typedefs import Handler

from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.embodiment.picture import is_picture
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import NoClip, NoPage
from reactive_realizer.server.keys import LIVE, TOKEN
from reactive_realizer.server.protocol import DOCUMENT
from reactive_realizer.server.token_check import COOKIE

STATIC = Path(__file__).parent / "static"
"""The folder of the built page."""

_IMMUTABLE: Final = {"Cache-Control": "max-age=31536000, immutable"}
"""Of files whose names contain a hash of their content."""
_CHECKED: Final = {"Cache-Control": "no-cache"}
"""Of files that browsers store, but ask for again: unchanged ones are answered with 304."""

routes = web.RouteTableDef()


@routes.get("/")
async def page(request: web.Request) -> web.StreamResponse:
    """The page. A token in the address is stored in a cookie, so that later addresses do not contain it."""
    if not (STATIC / "index.html").is_file():
        raise RealizerError(NoPage())
    if "token" in request.query and request.app[TOKEN].required:
        answer = web.HTTPSeeOther(request.rel_url.with_query(_without_token(request)))
        answer.set_cookie(COOKIE, request.query["token"], httponly=True, samesite="Strict", secure=_is_secure(request))
        raise answer
    return web.FileResponse(STATIC / "index.html", headers=_CHECKED)


@routes.get("/protocol.json")
async def protocol(_: web.Request) -> web.Response:
    """The JSON Schema of every message."""
    return web.Response(text=DOCUMENT, content_type="application/schema+json")


@routes.get("/avatars/{name:.+}")
async def avatar(request: web.Request) -> web.StreamResponse:
    """The file of an avatar."""
    name = "avatars/" + request.match_info["name"]
    path = await asyncio.to_thread(request.app[LIVE].scene.assets, name)
    if path.suffix not in (".glb", ".vrm"):
        raise RealizerError(NoAsset(name=name))
    return web.FileResponse(path, headers={"Content-Type": "model/gltf-binary", **_CHECKED})


@routes.get("/pictures/{name:.+}")
async def picture(request: web.Request) -> web.StreamResponse:
    """A picture that shows a character in place of its body."""
    name = request.match_info["name"]
    path = await asyncio.to_thread(request.app[LIVE].scene.assets, name)
    if not is_picture(name):
        raise RealizerError(NoAsset(name=name))
    kind, _ = guess_type(name)
    return web.FileResponse(path, headers={"Content-Type": kind or "application/octet-stream", **_CHECKED})


@routes.get("/audio/{clip}.wav")
async def audio(request: web.Request) -> web.Response:
    """An announced sound that is still available."""
    clip = request.match_info["clip"]
    wav = request.app[LIVE].sounds.wav(clip)
    if wav is None:
        raise RealizerError(NoClip(clip=clip))
    body = BytesIO(wav)  # is written in pieces, as the client reads them
    return web.Response(body=body, content_type="audio/wav", headers={"Cache-Control": "no-store"})


def built_files() -> list[web.RouteDef]:
    """A route for each file of the built page. Browsers that accept it get the compressed copy beside the file."""
    files = [file for file in STATIC.rglob("*") if file.is_file() and file.suffix != ".gz"]
    return [web.get(f"/{file.relative_to(STATIC).as_posix()}", _sender(file)) for file in files]


def _sender(file: Path) -> Handler:
    caching = _IMMUTABLE if file.parent == STATIC / "assets" else _CHECKED

    async def send(_: web.Request) -> web.StreamResponse:
        return web.FileResponse(file, headers=caching)

    return send


def _is_secure(request: web.Request) -> bool:
    """Whether the browser reached the server by TLS, itself or through a proxy: only then it returns such a cookie."""
    return request.secure or request.headers.get("X-Forwarded-Proto") == "https"


def _without_token(request: web.Request) -> dict[str, str]:
    return {name: value for name, value in request.query.items() if name != "token"}
