"""What the handlers find in the application."""

from aiohttp import web

from reactive_realizer.server.audience import Audience
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live import Live
from reactive_realizer.server.security import Security

LIVE = web.AppKey("live", Live)
INTAKE = web.AppKey("intake", Intake)
SECURITY = web.AppKey("security", Security)
FAREWELLS = web.AppKey("farewells", Audience[None])
"""Those who must be told when the server ends: connections last until then."""
