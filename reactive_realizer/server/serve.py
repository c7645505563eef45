"""Runs a server until it receives SIGTERM or is canceled."""

import asyncio
import logging
import signal
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager, closing, suppress
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from socket import socket

from aiohttp import web
from yarl import URL

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.capabilities import found_for
from reactive_realizer.server.connections import Connections, listen
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.keys import INTAKE
from reactive_realizer.server.live_scene import LiveScene, keep_from_ticks
from reactive_realizer.server.own_clients import OwnClient, accompanied
from reactive_realizer.server.recorder import Recorder
from reactive_realizer.server.recording_parts import RecordingParts
from reactive_realizer.server.security import Security
from reactive_realizer.server.sound_device import check_sound_device, sound_device

logger = logging.getLogger(__name__)

_PATIENCE = 2.0
"""Time for blocks to end, and for clients to disconnect, s."""
_LOOPBACK = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""The own address where a server listens on all addresses."""
_FADE = 0.3
"""Time for interrupted motions and sounds to fade out, s."""


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
        sound_device: name of the device of this machine that plays sounds, empty for the default one; None for none.
        record: the file that the session is recorded into; None for none.
        record_bytes: the size from which the recording goes on in another file.
        bridges: clients that run beside the server.
    """

    host: str = "127.0.0.1"
    port: int = 8088
    token: str | None = None
    origins: tuple[str, ...] = ()
    scene: SceneOptions = field(default_factory=SceneOptions)
    performance: str | None = None
    sound_device: str | None = None
    record: Path | None = None
    record_bytes: float = inf
    bridges: tuple[OwnClient, ...] = ()


async def serve(options: ServerOptions) -> None:
    """Serves a scene in real time until cancellation, or until what plays has ended after SIGTERM.

    Raises:
        RealizerError: the scene cannot be assembled, the sound device cannot be used, or the token is empty or missing.
        OSError: the address cannot be bound to, or the session cannot be recorded into its file.
    """
    if options.sound_device is not None:
        check_sound_device(options.sound_device)
    security = Security(options.host, options.token, options.origins)
    async with AsyncExitStack() as stack:
        listening = stack.enter_context(listen(options.host, options.port))
        parts = None
        if options.record:
            parts = stack.enter_context(closing(RecordingParts(options.record, options.record_bytes)))
        scene = await stack.enter_async_context(open_scene(options.scene))
        group = await stack.enter_async_context(asyncio.TaskGroup())
        found = found_for(scene)
        keep_from_ticks()  # this and reading files take long, so the clock starts after that
        live = LiveScene(scene, SystemClock(), options.performance, found)
        if parts is not None:
            recorder = Recorder(parts.write, options.scene, live.clock.epoch)
            stack.callback(recorder.close)
            live.realizer.record(recorder, recorder.forecast)
        ticking = group.create_task(live.run())
        try:
            async with serving(live, security, listening) as app:
                if options.sound_device is not None:
                    stack.enter_context(sound_device(live, app[INTAKE], options.sound_device))
                async with accompanied(options.bridges, _own_address(listening, options.token)):
                    await _termination()
                    await drain(live, app[INTAKE])
        finally:
            ticking.cancel()


@asynccontextmanager
async def serving(live: LiveScene, security: Security, listening: socket) -> AsyncIterator[web.Application]:
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
            yield app
            accepting.cancel()
    finally:
        await runner.cleanup()


async def drain(live: LiveScene, intake: Intake) -> None:
    """Refuses new documents, and ends what plays: motions fade out, and feedback reports every end."""
    intake.closed = True
    intake.stop()
    done, latest = asyncio.Event(), live.now + _PATIENCE
    ended: GlobalTime | None = None

    def look(now: GlobalTime) -> None:
        nonlocal ended
        if ended is None and not (live.realizer.busy or live.realizer.scheduler.blocks.alive):
            ended = now
        if now >= latest or (ended is not None and now >= ended + _FADE):
            done.set()

    unsubscribe = live.feedback.ticks.subscribe(look)
    with suppress(TimeoutError):  # it may stand still
        await asyncio.wait_for(done.wait(), 2 * _PATIENCE)
    unsubscribe()


def _address(listening: socket) -> str:
    host, port, *_ = listening.getsockname()
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


def _own_address(listening: socket, token: str | None) -> str:
    """The URL for clients on this machine."""
    host, port, *_ = listening.getsockname()
    url = URL.build(scheme="http", host=_LOOPBACK.get(host, host), port=port, path="/")
    return str(url if token is None else url.with_query(token=token))


async def _termination() -> None:
    """Waits for SIGTERM."""
    stopped = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, stopped.set)
    await stopped.wait()
