"""One client of the socket, from hello to its close."""

import asyncio
import logging
from contextlib import ExitStack

from aiohttp import WSMessage, WSMsgType, web

from reactive_realizer.errors import ERRORS, RealizerError, error
from reactive_realizer.server.client_queue import ClientQueue
from reactive_realizer.server.intake import BlocksRefused, Intake
from reactive_realizer.server.live import Live
from reactive_realizer.server.protocol import Message, NoNumber, accepted, check, decode, encode, ref_of, refused
from reactive_realizer.server.rate_limit import RateLimit
from reactive_realizer.server.streams import Stream

logger = logging.getLogger(__name__)


class SocketClient:
    """Reads what one client says, and sends what it asked for.

    Args:
        live: the scene.
        intake: its door.
        socket: of the client, prepared.
        streams: what the client wants.
        after: number of the last feedback that it has; None if it wants only what comes.
    """

    def __init__(
        self, live: Live, intake: Intake, socket: web.WebSocketResponse, streams: frozenset[Stream], after: int | None
    ) -> None:
        self._live = live
        self._intake = intake
        self._socket = socket
        self._streams = streams
        self._rate = RateLimit(live.limits.messages_per_second, live.clock)
        self._queue = ClientQueue(live.limits, self._first(after), len(live.realizer.characters))
        self._reason = "going-away"

    async def serve(self) -> None:
        """Until the client goes or is sent away."""
        with ExitStack() as stack:
            self._follow(stack)
            async with asyncio.TaskGroup() as group:
                reading = group.create_task(self._read())
                await self._send()
                reading.cancel()
        await self._close()

    def leave(self) -> None:
        """Send the client away once it has what waits for it."""
        self._queue.end()

    # --- what the client is told

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
        gap = [encode(refused(error("feedback-gone", seq=log.forgotten)))] if after < log.forgotten else []
        return gap + [entry.text for entry in log.after(after)]

    def _follow(self, stack: ExitStack) -> None:
        if Stream.FEEDBACK in self._streams:
            stack.callback(self._live.feedback.audience.join(lambda entry: self._queue.put(entry.text)))
        if Stream.AUDIO in self._streams:
            stack.callback(self._live.sounds.audience.join(self._tell))
        if Stream.BOARD in self._streams:
            stack.callback(self._live.board.audience.join(self._tell))
        if Stream.FRAMES in self._streams:
            stack.callback(self._live.frames.join(self._queue.put_frame))

    def _tell(self, message: Message) -> None:
        self._queue.put(encode(message))

    async def _send(self) -> None:
        try:
            kept_up = await self._queue.send_all(self._send_one)
        except ConnectionError:
            return  # the client went without a word
        if not kept_up:
            self._reason = "too-slow"

    async def _send_one(self, entry: str | bytes) -> None:
        if isinstance(entry, str):
            await self._socket.send_str(entry)
        else:
            await self._socket.send_bytes(entry)

    async def _close(self) -> None:
        """One that reads again within aiohttp's patience learns why."""
        code = ERRORS[self._reason].close
        assert code is not None
        if await self._socket.close(code=code, message=self._reason.encode(), drain=False):
            logger.info("a client was sent away: %s", self._reason)

    # --- what the client says

    async def _read(self) -> None:
        async for message in self._socket:
            if not self._rate.allows():
                limit = self._live.limits.messages_per_second
                self._reason = "too-many-messages"
                self._tell(refused(error("too-many-messages", limit=limit)))
                break
            await self._take(message)
        self._queue.end()

    async def _take(self, received: WSMessage) -> None:
        ref = None
        try:
            if received.type is not WSMsgType.TEXT:
                raise error("binary-message")
            message = decode(received.data)
            ref = ref_of(message)
            check(message)
            blocks = await self._answer(message)
        except NoNumber as refusal:
            self._tell(refused(refusal, ref_of(refusal.message)))
        except BlocksRefused as refusal:
            self._tell(refused(refusal, ref, refusal.entered))
        except RealizerError as refusal:
            self._tell(refused(refusal, ref))
        else:
            if ref is not None:
                self._tell(accepted(ref, blocks))

    async def _answer(self, message: Message) -> list[str] | None:
        """The ids of the blocks that it had, if it is BML."""
        match message["type"]:
            case "ping":
                self._tell({"type": "pong", "t": message["t"], "time": round(self._live.now, 6)})
            case "clock":
                self._tell({"type": "clock", "time": round(self._live.now, 6)})
            case "bml":
                return await self._intake.blocks(message["xml"])
            case _:
                self._intake.message(message)
        return None
