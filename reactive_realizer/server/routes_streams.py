"""Routes of streams: the socket, and feedback as server-sent events."""

import asyncio
import logging
import socket
from contextlib import ExitStack

from aiohttp import web

from reactive_realizer.server.client_limits import ClientQueue
from reactive_realizer.server.feedback_log import LogEntry
from reactive_realizer.server.keys import CLIENTS, INTAKE, LIVE, SHUTDOWN
from reactive_realizer.server.prediction_rate import follow_feedback
from reactive_realizer.server.socket_client import SocketClient
from reactive_realizer.server.stream_query import Stream, after_of, predictions_of, streams_of

logger = logging.getLogger(__name__)

_HEARTBEAT = 30.0
"""Time between two pings, s; the answer has to come within half of it."""
_SEND_BUFFER = 128 * 1024
"""Send buffer of the operating system, bytes. It is small, so that a slow client is detected early."""

routes = web.RouteTableDef()


@routes.get("/ws")
async def ws(request: web.Request) -> web.WebSocketResponse:
    """The socket."""
    live, intake = request.app[LIVE], request.app[INTAKE]
    query = request.query
    streams, after, predictions = streams_of(query), after_of(query), predictions_of(query)
    with live.clients.one():
        answer = web.WebSocketResponse(
            heartbeat=_HEARTBEAT,
            autoping=False,  # pings count as messages, so that their rate is limited
            compress=False,
            max_msg_size=live.limits.message_bytes,
            writer_limit=_SEND_BUFFER // 2,
        )
        await answer.prepare(request)
        _keep_buffer_small(request)
        name = request.app[CLIENTS].of(request)
        if (transport := request.transport) is None:
            return answer  # the client has disconnected
        client = SocketClient(live, intake, answer, transport, name, streams, after, predictions)
        if Stream.FRAMES in streams:
            intake.demo.page_opened()
        with ExitStack() as stack:
            stack.callback(request.app[SHUTDOWN].subscribe(lambda _: client.leave()))
            try:
                await client.serve()
            except asyncio.CancelledError as vanished:
                _free_frames(vanished)
                raise
            finally:
                _hang_up(request)
                await answer.close()  # else, its heartbeat keeps the memory of a client that has vanished for a while
                _say_why(request, answer.exception())
                _free_frames(answer.exception())
                # The connection and the socket refer to each other. Only a collection, which is rare, would free them.
                request.protocol._data_received_cb = None
    return answer


@routes.get("/feedback")
async def feedback(request: web.Request) -> web.StreamResponse:
    """Server-sent events; the id of each is its number."""
    live = request.app[LIVE]
    after = after_of(request.query, request.headers.get("Last-Event-ID"))
    predictions = predictions_of(request.query)
    with live.clients.one():
        answer = web.StreamResponse(headers={"Content-Type": "text/event-stream", "Cache-Control": "no-store"})
        await answer.prepare(request)
        _keep_buffer_small(request)
        log = live.feedback
        missed, gap = ([], None) if after is None else (log.after(after), log.gap(after))
        queue: ClientQueue[LogEntry] = ClientQueue(live.limits, missed)

        async def write(entry: LogEntry) -> None:
            await answer.write(f"id: {entry.seq}\ndata: {entry.text}\n\n".encode())

        with ExitStack() as stack:
            stack.enter_context(live.clients.served(queue))
            follow_feedback(log, predictions, queue.put, stack)
            stack.callback(request.app[SHUTDOWN].subscribe(lambda _: queue.end()))
            if gap is not None:
                await answer.write(f"event: gone\ndata: {gap}\n\n".encode())
            kept_up = await queue.send_all(write)
        if not kept_up:
            _hang_up(request)
    return answer


def _say_why(request: web.Request, failure: BaseException | None) -> None:
    """Logs why the connection of a client has failed; one that a client has closed has not."""
    if failure is not None:
        silent = isinstance(failure, TimeoutError)
        reason = f"no answer to a ping within {_HEARTBEAT / 2:g} s" if silent else str(failure)
        logger.info("the connection of a client was closed: %s", reason, extra={"address": request.remote})


def _free_frames(failure: BaseException | None) -> None:
    """Cuts a failure off from the frames that it has passed.

    They refer to it, and to everything about a client. Without this, only a collection, which is rare, frees them.
    """
    if failure is not None:
        failure.__traceback__ = failure.__context__ = None


def _keep_buffer_small(request: web.Request) -> None:
    connection = request.get_extra_info("socket")
    if connection is not None:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _SEND_BUFFER)


def _hang_up(request: web.Request) -> None:
    """Drops unsent data, which a client that does not read would keep forever."""
    if request.transport is not None:
        request.transport.abort()
