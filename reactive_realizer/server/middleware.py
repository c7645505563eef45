"""Middleware for every request: access control, and faults as JSON."""

import logging
from collections.abc import Mapping
from types import MappingProxyType

from aiohttp import web
from aiohttp.http_exceptions import HttpProcessingError
from aiohttp.typedefs import Handler

from reactive_realizer.bml.faults import TooManyBytes
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import BadRequest, NothingThere, WrongMethod
from reactive_realizer.server.keys import LIVE, SECURITY, TOKEN
from reactive_realizer.server.security import HEADERS
from reactive_realizer.server.statuses import status_of

_OPEN = ("/health", "/ready")
"""Paths without a token: a supervisor has none, and they tell nothing else."""

logger = logging.getLogger(__name__)


@web.middleware
async def tell_refusals(request: web.Request, handler: Handler) -> web.StreamResponse:
    """Answers each fault with JSON: its code, its sentence, and its place in the document, if any."""
    try:
        return await handler(request)
    except RealizerError as refusal:
        return answer_to(request, refusal)
    except web.HTTPRequestEntityTooLarge:
        limit = request.app[LIVE].limits.bml_bytes
        return answer_to(
            request, RealizerError(TooManyBytes(size=request.content_length or f"more than {limit}", limit=limit))
        )
    except web.HTTPMethodNotAllowed as refusal:
        answer = answer_to(request, RealizerError(WrongMethod(path=request.path, method=request.method)))
        answer.headers["Allow"] = refusal.headers["Allow"]
        return answer
    except (web.HTTPNotFound, web.HTTPForbidden):
        return answer_to(request, RealizerError(NothingThere(path=request.path)))
    except web.HTTPBadRequest as refusal:
        return answer_to(request, RealizerError(BadRequest(reason=refusal.text or refusal.reason)))
    except web.RequestPayloadError as problem:
        return answer_to(request, RealizerError(BadRequest(reason=_on_one_line(problem))))


@web.middleware
async def let_in(request: web.Request, handler: Handler) -> web.StreamResponse:
    """Checks host, origin and token, and answers the preflight requests of browsers."""
    request.app[SECURITY].check(request)
    if request.method == "OPTIONS":  # a preflight request carries no token
        return web.Response(status=204)
    if request.path not in _OPEN:
        await request.app[TOKEN].check(request)
    return await handler(request)


def shorten(record: logging.LogRecord) -> bool:
    """Makes one line of the traceback that aiohttp logs for a request that cannot be read: it is no fault of ours."""
    problem = record.exc_info[1] if record.exc_info else None
    if isinstance(problem, (HttpProcessingError, web.RequestPayloadError)):
        if isinstance(record.args, tuple) and record.args:
            record.address = record.args[0]
        record.msg, record.args = "a request cannot be read: %s", (_on_one_line(problem),)
        record.levelno, record.levelname, record.exc_info = logging.INFO, "INFO", None
    return True


def _on_one_line(problem: Exception) -> str:
    return " ".join(str(problem).split())


async def add_headers(request: web.Request, response: web.StreamResponse) -> None:
    """Adds the headers of every response."""
    response.headers.update(HEADERS)
    response.headers.update(request.app[SECURITY].cross_origin_headers(request))


def answer_to(
    request: web.Request, refusal: RealizerError, more: Mapping[str, object] = MappingProxyType({})
) -> web.Response:
    """The HTTP response to a request for a fault; ``more`` stands beside it."""
    fault = refusal.fault
    logger.info("%s: %s", fault.code, fault, extra={"address": request.remote})
    place = {"line": fault.line, "column": fault.column}
    body = {"code": fault.code, "message": fault.sentence, **place}
    return web.json_response({"error": body, **more}, status=status_of(fault))
