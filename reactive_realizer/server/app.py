"""The application: every route over one live scene."""

import logging

from aiohttp import web

from reactive_realizer.server import routes_page, routes_requests, routes_state, routes_streams, routes_watch
from reactive_realizer.server.client_names import ClientNames
from reactive_realizer.server.connections import count_used
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.keys import CLIENTS, INTAKE, LIVE, SECURITY, SHUTDOWN, TOKEN, USED
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.middleware import add_headers, let_in, shorten, tell_refusals
from reactive_realizer.server.security import Security
from reactive_realizer.server.subscribers import Subscribers
from reactive_realizer.server.token_check import TokenCheck


def create_app(live: LiveScene, security: Security) -> web.Application:
    """Creates the application. It does not tick the scene.

    Args:
        live: the scene.
        security: the hosts, origins and token that are accepted.
    """
    # aiohttp also refuses a body of exactly the limit.
    app = web.Application(middlewares=[count_used, tell_refusals, let_in], client_max_size=live.limits.bml_bytes + 1)
    app[LIVE] = live
    app[INTAKE] = Intake(live)
    app[SECURITY] = security
    app[USED] = set()
    app[CLIENTS] = ClientNames()
    app[TOKEN] = TokenCheck(security.token, live.clock)
    app[SHUTDOWN] = Subscribers()
    for module in (routes_page, routes_requests, routes_state, routes_streams, routes_watch):
        app.add_routes(module.routes)
    app.add_routes(routes_page.built_files())
    app.on_response_prepare.append(add_headers)
    logging.getLogger("aiohttp.server").addFilter(shorten)
    app.on_shutdown.append(_say_farewell)
    return app


async def _say_farewell(app: web.Application) -> None:
    app[SHUTDOWN].publish(None)
