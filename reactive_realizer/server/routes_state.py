"""Routes for the state and the capabilities of the realizer."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from itertools import islice

from aiohttp import web

from reactive_realizer import __version__
from reactive_realizer.errors import RealizerError
from reactive_realizer.scheduler.admission import UnknownCharacter
from reactive_realizer.server.capabilities import capabilities_of
from reactive_realizer.server.keys import INTAKE, LIVE
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.protocol import VERSION

_AT_ONCE = 5
"""Points that are explained in one turn; each may depend on a long chain of others."""

routes = web.RouteTableDef()


@routes.get("/status")
async def status(request: web.Request) -> web.Response:
    """The state of the server."""
    live = request.app[LIVE]
    blocks = live.realizer.scheduler.blocks
    states = [*(block.state for block in blocks.alive), *(block.state for block in blocks.ended)]
    worker = getattr(live.scene.tts, "worker", None)
    answer = {
        "version": __version__,
        "protocol": VERSION,
        "session": live.session,
        "time": round(live.now, 6),
        "ticks": _ticks(live),
        "clients": live.clients.number,
        "blocks": Counter(state.value for state in states),
        "worker": {name: getattr(worker, name, None) for name in ("alive", "restarts")},
        "limits": asdict(live.limits),
    }
    return web.json_response(answer)


@routes.get("/world")
async def world(request: web.Request) -> web.Response:
    """The positions of all targets, and the orientations of those that have one."""
    world = request.app[LIVE].realizer.world
    targets: dict[str, dict[str, Sequence[float]]] = {}
    for name, place in world.snapshot().items():
        orientation = world.orientation(name)
        targets[name] = {"position": place, **({} if orientation is None else {"orientation": orientation})}
    return web.json_response({"targets": targets})


@routes.get("/explain/{block}")
async def explain(request: web.Request) -> web.Response:
    """The pegs, constraints and commits that set the time of each sync point of a live block; some in each turn."""
    realizer, turns = request.app[LIVE].realizer, request.app[INTAKE].turns
    character = request.query.get("character", next(iter(realizer.characters)))
    if character not in realizer.characters:
        raise RealizerError(UnknownCharacter(character=character, known=tuple(realizer.characters)))
    key, explained = realizer.scheduler.explain(character, request.match_info["block"])
    points: list[str] = []
    while some := list(islice(explained, _AT_ONCE)):
        async with turns:
            points += (f"{json.dumps(name)}: {json.dumps(explanation)}" for name, explanation in some)
    block = json.dumps(key._asdict()).removesuffix("}")
    return web.json_response(text=block + ', "points": {' + ", ".join(points) + "}}")


@routes.get("/capabilities")
async def capabilities(request: web.Request) -> web.Response:
    """The capabilities of the scene."""
    live = request.app[LIVE]
    return web.json_response(await capabilities_of(live.scene, live.found))


def _ticks(live: LiveScene) -> dict[str, float | None]:
    """The lateness of ticks, ms: the median and the 99th percentile, null before the second tick; and the overruns."""
    late = live.ticker.late(0.5, 0.99)
    return {
        "late_p50_ms": _milliseconds(late.get(0.5)),
        "late_p99_ms": _milliseconds(late.get(0.99)),
        "overruns": live.ticker.overruns,
    }


def _milliseconds(seconds: float | None) -> float | None:
    return None if seconds is None else round(1000 * seconds, 3)
