"""Keys of the objects that request handlers find in the application."""

from aiohttp import web

from reactive_realizer.server.client_names import ClientNames
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.security import Security
from reactive_realizer.server.subscribers import Subscribers
from reactive_realizer.server.token_check import TokenCheck

LIVE = web.AppKey("live", LiveScene)
INTAKE = web.AppKey("intake", Intake)
SECURITY = web.AppKey("security", Security)
USED = web.AppKey("used", set[web.RequestHandler])
"""The connections on which a request is being answered."""
CLIENTS = web.AppKey("clients", ClientNames)
TOKEN = web.AppKey("token", TokenCheck)
SHUTDOWN = web.AppKey("shutdown", Subscribers[None])
"""Called when the server shuts down, so that open connections end."""
