"""Routes for those who run a server: health, readiness, and metrics for Prometheus."""

from collections import Counter
from collections.abc import Iterator, Mapping

from aiohttp import web

from reactive_realizer.clock.ticker import tick_time
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.client_limits import Clients
from reactive_realizer.server.faults import GoingAway, StandsStill
from reactive_realizer.server.keys import INTAKE, LIVE
from reactive_realizer.server.live_scene import LiveScene

_STANDSTILL = 5.0
"""Time without a tick after which a server is not healthy, s."""

routes = web.RouteTableDef()


@routes.get("/health")
async def health(request: web.Request) -> web.Response:
    """Whether the session goes on; if not, only a restart helps."""
    live = request.app[LIVE]
    idle = live.now - tick_time(live.tick)
    if idle > _STANDSTILL:
        raise RealizerError(StandsStill(seconds=idle))
    return web.json_response({"status": "healthy"})


@routes.get("/ready")
async def ready(request: web.Request) -> web.Response:
    """Whether blocks are accepted."""
    if request.app[INTAKE].closed:
        raise RealizerError(GoingAway())
    return web.json_response({"status": "ready"})


@routes.get("/metrics")
async def metrics(request: web.Request) -> web.Response:
    """The state of the server in the text format of Prometheus."""
    lines = "".join(f"{line}\n" for line in _exposition(request.app[LIVE]))
    return web.Response(body=lines.encode(), headers={"Content-Type": "text/plain; version=0.0.4; charset=utf-8"})


def _exposition(live: LiveScene) -> Iterator[str]:
    ticks, tts = live.ticker, live.scene.tts
    yield from _metric("ticks_total", "counter", "Ticks since the start of the session.", {"": live.tick})
    yield from _metric("skipped_ticks_total", "counter", "Ticks that were skipped, because others were late.", {
        "": ticks.overruns
    })  # fmt: skip
    yield from _metric("tick_lateness_seconds", "gauge", "Lateness of the last ticks.", {
        f'{{quantile="{quantile}"}}': late for quantile, late in ticks.late(0.5, 0.99).items()
    })  # fmt: skip
    yield from _metric("clients", "gauge", "Open sockets and feedback streams.", {"": live.clients.number})
    yield from _queues(live.clients)
    yield from _metric("feedback_messages_total", "counter", "Feedback messages.", {"": live.feedback.seq})
    blocks = live.realizer.scheduler.blocks
    states = Counter(block.state.value for block in blocks.alive)
    yield from _metric("blocks", "gauge", "Blocks that have not ended, by state.", {
        f'{{state="{state}"}}': number for state, number in sorted(states.items())
    })  # fmt: skip
    yield from _metric("unplanned_blocks", "gauge", "Blocks and procedures that wait for the work of a tick.", {
        "": live.realizer.scheduler.unplanned
    })  # fmt: skip
    worker = getattr(tts, "worker", None)
    if worker is not None:
        yield from _metric("voice_restarts_total", "counter", "Restarts of the speech process.", {"": worker.restarts})


def _queues(clients: Clients) -> Iterator[str]:
    """What waits to be sent, because clients read slowly."""
    sizes = [queue.bytes for queue in clients.queues]
    yield from _metric("queued_bytes", "gauge", "Bytes that wait to be sent to clients.", {"": sum(sizes)})
    yield from _metric("longest_queue_bytes", "gauge", "Bytes that wait to be sent to one client, at most.", {
        "": max(sizes, default=0)
    })  # fmt: skip
    yield from _metric("longest_queue_messages", "gauge", "Messages that wait to be sent to one client, at most.", {
        "": max((queue.messages for queue in clients.queues), default=0)
    })  # fmt: skip


def _metric(name: str, kind: str, text: str, samples: Mapping[str, float]) -> Iterator[str]:
    """A metric with its samples by label."""
    yield f"# HELP realizer_{name} {text}"
    yield f"# TYPE realizer_{name} {kind}"
    for labels, value in samples.items():
        yield f"realizer_{name}{labels} {value:.10g}"
