"""One client of the socket: the streams that it requests, its messages, and the answers."""

import asyncio
import logging
from contextlib import ExitStack

from aiohttp import WSMessage, WSMsgType, web

from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.server.client_limits import ClientQueue, RateLimit
from reactive_realizer.server.faults import BinaryMessage, GoingAway, TooSlow
from reactive_realizer.server.intake import Answer, BlocksRefused, Intake
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.prediction_rate import follow_feedback
from reactive_realizer.server.protocol import Message, accepted, bml_answer, encode, refused
from reactive_realizer.server.socket_writer import write_at_once
from reactive_realizer.server.statuses import CLOSE_CODES
from reactive_realizer.server.stream_query import Stream

logger = logging.getLogger(__name__)


class SocketClient:
    """Reads the messages of one client and sends the streams that it requested.

    Args:
        live: the scene.
        intake: receives the requests.
        socket: of the client, prepared.
        transport: of the socket.
        name: of the client, for the realizer.
        streams: those that the client requested.
        after: number of the last feedback that it has; None for new feedback only.
        predictions: how many a second it wants of each block, at most; None for all.
    """

    def __init__(
        self,
        live: LiveScene,
        intake: Intake,
        socket: web.WebSocketResponse,
        transport: asyncio.WriteTransport,
        name: str,
        streams: frozenset[Stream],
        after: int | None,
        predictions: float | None,
    ) -> None:
        self._live = live
        self._intake = intake
        self._socket = socket
        self._transport = transport
        self._name = name
        self._streams = streams
        self._predictions = predictions
        self._rate = RateLimit(live.limits.messages_per_second)
        self._queue: ClientQueue[str | bytes] = ClientQueue(live.limits, self._first(after))
        self._greeted = False
        self._reason: type[Fault] = GoingAway

    async def serve(self) -> None:
        """Serves the client until it disconnects or is disconnected."""
        with ExitStack() as stack:
            stack.enter_context(self._live.clients.served(self._queue))
            stack.callback(self._intake.leave, self)
            self._follow(stack)
            async with asyncio.TaskGroup() as group:
                reading = group.create_task(self._read())
                await self._send()
                reading.cancel()
        await self._close()

    def leave(self) -> None:
        """Closes the connection after the queued messages."""
        self._queue.end()

    # --- to the client

    def _first(self, after: int | None) -> list[str]:
        messages = [self._live.hello()]
        if Stream.AUDIO in self._streams:
            messages += self._live.sounds.sounding(self._live.now)
        if Stream.BOARD in self._streams:
            messages.append(self._live.board.picture())
        return [*map(encode, messages), *self._missed(after)]

    def _missed(self, after: int | None) -> list[str]:
        log = self._live.feedback
        if after is None or Stream.FEEDBACK not in self._streams:
            return []
        gap = log.gap(after)
        return [*([] if gap is None else [gap]), *(entry.text for entry in log.after(after))]

    def _follow(self, stack: ExitStack) -> None:
        if Stream.FEEDBACK in self._streams:
            follow_feedback(self._live.feedback, self._predictions, lambda entry: self._queue.put(entry.text), stack)
        if Stream.AUDIO in self._streams:
            stack.callback(self._live.sounds.subscribers.subscribe(self._queue.put))
        if Stream.SOUND in self._streams:
            stack.callback(self._live.sounds.takers.subscribe(self._queue.put))
        if Stream.BOARD in self._streams:
            stack.callback(self._live.board.subscribers.subscribe(self._queue.put))
        if Stream.STEPS in self._streams:
            stack.callback(self._live.steps.subscribe(self._queue.put))
        if Stream.WORLD in self._streams:
            stack.callback(self._live.world.subscribe(self._queue.put))
        if Stream.PICTURES in self._streams:
            stack.callback(self._live.pictures.subscribe(self._queue.put))
        if Stream.FRAMES in self._streams:
            stack.callback(self._live.frames.subscribe(self._show))

    def _show(self, frames: bytes) -> None:
        """Writes the frames of a tick past the queue, but not before hello and not after the end."""
        if self._greeted and not self._socket.closed:
            write_at_once(self._transport, frames)

    def _enqueue(self, message: Message) -> None:
        self._queue.put(encode(message))

    async def _send(self) -> None:
        try:
            kept_up = await self._queue.send_all(self._send_one)
        except ConnectionError:
            return  # the client disconnected
        if not kept_up:
            self._reason = TooSlow

    async def _send_one(self, message: str | bytes) -> None:
        self._greeted = True  # the first message is hello
        if isinstance(message, str):
            await self._socket.send_str(message)
        else:
            await self._socket.send_bytes(message)

    async def _close(self) -> None:
        """Closes the socket; a client that still reads receives the reason."""
        code, reason = CLOSE_CODES[self._reason], self._reason.code
        if await self._socket.close(code=code, message=reason.encode(), drain=False):
            address = self._socket.get_extra_info("peername", ("unknown",))[0]
            logger.info("the connection of a client was closed: %s", reason, extra={"address": address})

    # --- from the client

    async def _read(self) -> None:
        async for message in self._socket:
            if message.type is WSMsgType.ERROR:
                break  # no answer to a ping
            await self._rate.take()
            if message.type is WSMsgType.PING:
                await self._socket.pong(message.data)
            elif message.type is not WSMsgType.PONG:
                await self._take(message)
        self._queue.end()

    async def _take(self, received: WSMessage) -> None:
        ref = None
        try:
            if received.type is not WSMsgType.TEXT:
                raise RealizerError(BinaryMessage())
            message, ref, refusal = await self._intake.read(received.data)
            if refusal is not None:
                raise refusal
            more = self._answer(message)
            if message["type"] == "bml":
                answer = await self._intake.blocks(message["xml"], self._name, message.get("mediaType", ""))
                more = self._about(answer)
        except BlocksRefused as problem:
            self._enqueue(refused(problem, ref, self._about(problem.answer)))
        except RealizerError as problem:
            self._enqueue(refused(problem, ref))
        else:
            if ref is not None:
                self._enqueue(accepted(ref, more))

    def _answer(self, message: Message) -> Message:
        """Handles a message other than BML; what its answer says beyond that it is accepted."""
        match message["type"]:
            case "ping":
                self._enqueue({"type": "pong", "t": message["t"], "time": round(self._live.now, 6)})
            case "clock":
                self._enqueue({"type": "clock", "time": round(self._live.now, 6)})
            case "bml":
                pass
            case _:
                self._intake.message(message, self)
        return {}

    def _about(self, answer: Answer) -> Message:
        return bml_answer(answer.blocks, answer.warnings, self._live.limits.answered_warnings)
