"""Routes for planners without a socket: BML, predictions and stop."""

import asyncio
import codecs
from typing import Final

from aiohttp import web

from reactive_realizer.bml.faults import BadEncoding
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import BadRequest, SlowRequest, WrongCharset
from reactive_realizer.server.intake import BlocksRefused
from reactive_realizer.server.keys import CLIENTS, INTAKE, LIVE
from reactive_realizer.server.middleware import answer_to
from reactive_realizer.server.protocol import bml_answer

_MARKS: Final = (codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_CHARSETS: Final = {
    "utf-8": "utf-8",
    "ascii": "ascii",
    "iso8859-1": "iso8859-1",
    "utf-16": "utf-16-be",  # without a byte order mark: RFC 2781, 4.3
    "utf-16-be": "utf-16-be",
    "utf-16-le": "utf-16-le",
}
"""Supported encodings: Python's name of a charset -> the codec that decodes it."""


def text_of(body: bytes, charset: str | None) -> str | bytes:
    """Decodes a body by the charset of its header; without one, the body is returned, and the parser decodes it.

    A byte order mark precedes the header, and the header precedes the declaration in the document (RFC 7303, 3).
    Invalid bytes become lone surrogates; the parser stops there and reports the line.

    Raises:
        RealizerError: "wrong-charset", "bad-encoding".
    """
    if charset is None or body.startswith(_MARKS):
        return body
    encoding = _encoding(charset)
    try:
        return body.decode(encoding, "surrogateescape")
    except UnicodeDecodeError as problem:
        raise RealizerError(BadEncoding(line=1, column=1)) from problem


def _encoding(charset: str) -> str:
    try:
        return _CHARSETS[codecs.lookup(charset).name]
    except (LookupError, ValueError) as problem:  # ValueError: not a valid name
        raise RealizerError(WrongCharset(charset=charset)) from problem


routes = web.RouteTableDef()


@routes.post("/bml")
async def bml(request: web.Request) -> web.Response:
    """Accepts a document completely, or not at all."""
    text = text_of(await _body(request), request.charset)
    limit = request.app[LIVE].limits.answered_warnings
    try:
        answer = await request.app[INTAKE].document(text, request.app[CLIENTS].of(request), request.content_type)
    except BlocksRefused as refusal:
        return answer_to(request, refusal, bml_answer(*refusal.answer, limit))
    return web.json_response(bml_answer(*answer, limit), status=202)


@routes.post("/predict")
async def predict(request: web.Request) -> web.Response:
    """Accepts a prediction, and returns its time."""
    intake = request.app[INTAKE]
    message, _, refusal = await intake.read(await _body(request), "predict")
    if refusal is not None:
        raise refusal
    return web.json_response({"time": intake.predict(message)}, status=202)


@routes.post("/stop")
async def stop(request: web.Request) -> web.Response:
    """Ends all blocks."""
    return web.json_response({"blocks": request.app[INTAKE].stop()}, status=202)


async def _body(request: web.Request) -> bytes:
    """The body of a request.

    Raises:
        RealizerError: "slow-request": the client has not sent it in time; "bad-request": its connection has closed.
    """
    limit = request.app[LIVE].limits.body_seconds
    try:
        async with asyncio.timeout(limit):
            return await request.read()
    except TimeoutError:
        raise RealizerError(SlowRequest(limit=limit)) from None
    except RuntimeError:
        if request.protocol.connected:
            raise
        raise RealizerError(BadRequest(reason="its connection has closed")) from None
