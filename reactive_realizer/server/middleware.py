"""What holds for every request: who comes in, and how a refusal is told."""

import logging

from aiohttp import web
from aiohttp.typedefs import Handler

from reactive_realizer.errors import RealizerError, error
from reactive_realizer.server.keys import LIVE, SECURITY
from reactive_realizer.server.security import HEADERS

logger = logging.getLogger(__name__)

_BAD_REQUEST = 400


@web.middleware
async def tell_refusals(request: web.Request, handler: Handler) -> web.StreamResponse:
    """Every refusal is answered by JSON with its code, its sentence, and its place in the document if it has one."""
    try:
        return await handler(request)
    except RealizerError as refusal:
        return answer_to(refusal)
    except web.HTTPRequestEntityTooLarge:
        limit = request.app[LIVE].limits.bml_bytes
        return answer_to(error("too-many-bytes", size=request.content_length or f"more than {limit}", limit=limit))
    except web.HTTPMethodNotAllowed as refusal:
        answer = answer_to(error("wrong-method", path=request.path, method=request.method))
        answer.headers["Allow"] = refusal.headers["Allow"]
        return answer
    except (web.HTTPNotFound, web.HTTPForbidden):
        return answer_to(error("nothing-there", path=request.path))
    except web.HTTPBadRequest as refusal:
        return answer_to(error("bad-request", reason=refusal.text))


@web.middleware
async def let_in(request: web.Request, handler: Handler) -> web.StreamResponse:
    """Ask for host, origin and token; what a browser asks before it asks is answered here."""
    request.app[SECURITY].check(request)
    if request.method == "OPTIONS":
        return web.Response(status=204)
    return await handler(request)


async def add_headers(request: web.Request, response: web.StreamResponse) -> None:
    """Signal of the application: what every answer bears."""
    response.headers.update(HEADERS)
    response.headers.update(request.app[SECURITY].cross_origin_headers(request))


def answer_to(refusal: RealizerError) -> web.Response:
    """A refusal as an answer of HTTP."""
    fault = refusal.fault
    logger.info("%s: %s", fault.code, fault)
    place = {"line": fault.line, "column": fault.column}
    body = {"code": fault.code, "message": fault.sentence, **place}
    return web.json_response({"error": body}, status=fault.kind.status or _BAD_REQUEST)
