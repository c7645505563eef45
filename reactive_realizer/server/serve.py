"""Runs a server until it receives SIGTERM or is canceled."""

import asyncio
import logging
import signal
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from socket import socket

from aiohttp import web

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.server.app import create_app
from reactive_realizer.server.connections import Connections, listen
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.recorder import Recorder, recording_file
from reactive_realizer.server.security import Security

logger = logging.getLogger(__name__)

_PATIENCE = 2.0
"""Time for clients to disconnect, s."""


@dataclass(frozen=True, slots=True)
class ServerOptions:
    """The options of a server.

    Attributes:
        host: address to bind to.
        port: 0 for any that is free.
        token: required of every client; None for no token, which only a server on the loopback interface may have.
        origins: origins of other pages that are accepted.
        scene: options of the scene.
        performance: BML of a demo; None for none.
        record: the file that the session is recorded into; None for none.
    """

    host: str = "127.0.0.1"
    port: int = 8088
    token: str | None = None
    origins: tuple[str, ...] = ()
    scene: SceneOptions = field(default_factory=SceneOptions)
    performance: str | None = None
    record: Path | None = None


async def serve(options: ServerOptions) -> None:
    """Serves a scene in real time until SIGTERM or cancellation.

    Raises:
        RealizerError: the scene cannot be assembled, or the token is empty or missing.
        OSError: the address cannot be bound to, or the session cannot be recorded into its file.
    """
    security = Security(options.host, options.token, options.origins)
    async with AsyncExitStack() as stack:
        listening = stack.enter_context(listen(options.host, options.port))
        record = stack.enter_context(recording_file(options.record)) if options.record else None
        scene = await stack.enter_async_context(open_scene(options.scene))
        group = await stack.enter_async_context(asyncio.TaskGroup())
        live = LiveScene(scene, SystemClock(), options.performance)
        if record is not None:
            recorder = Recorder(record, options.scene, live.clock.epoch)
            live.realizer.record(recorder, recorder.forecast)
        ticking = group.create_task(live.run())
        try:
            async with serving(live, security, listening):
                await _termination()
        finally:
            ticking.cancel()


@asynccontextmanager
async def serving(live: LiveScene, security: Security, listening: socket) -> AsyncIterator[None]:
    """Serves HTTP and sockets."""
    app = create_app(live, security)
    runner = web.AppRunner(
        app,
        handler_cancellation=True,  # a client that disconnects ends its stream
        shutdown_timeout=_PATIENCE,
        keepalive_timeout=live.limits.idle_seconds,
        access_log=None,  # addresses may contain tokens
    )
    await runner.setup()
    try:
        async with asyncio.TaskGroup() as group:
            accepting = group.create_task(Connections(app, runner, live.limits).accept(listening))
            logger.info("serving on %s", _address(listening))
            yield
            accepting.cancel()
    finally:
        await runner.cleanup()


def _address(listening: socket) -> str:
    host, port, *_ = listening.getsockname()
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


async def _termination() -> None:
    """Waits for SIGTERM."""
    stopped = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, stopped.set)
    await stopped.wait()
