"""What planners without a socket ask for: BML, predictions, silence."""

from aiohttp import web

from reactive_realizer.errors import error
from reactive_realizer.server.charset import text_of
from reactive_realizer.server.keys import INTAKE
from reactive_realizer.server.protocol import check, decode

_XML = ("application/xml", "text/xml", "application/bml+xml")

routes = web.RouteTableDef()


@routes.post("/bml")
async def bml(request: web.Request) -> web.Response:
    """A document enters whole, or not at all."""
    if request.content_type not in _XML:
        raise error("wrong-media-type", type=request.content_type)
    text = text_of(await request.read(), request.charset)
    blocks = await request.app[INTAKE].document(text)
    return web.json_response({"blocks": blocks}, status=202)


@routes.post("/predict")
async def predict(request: web.Request) -> web.Response:
    """The prediction of the socket; the answer says for when it was understood."""
    message = decode(await request.read())
    message = {**message, "type": "predict"} if isinstance(message, dict) else message
    check(message)
    return web.json_response({"time": request.app[INTAKE].predict(message)}, status=202)


@routes.post("/stop")
async def stop(request: web.Request) -> web.Response:
    """End everything."""
    return web.json_response({"blocks": request.app[INTAKE].stop()}, status=202)
