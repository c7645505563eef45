"""A speech worker that is started again when it has ended."""

import asyncio
from typing import Any

from reactive_realizer.engines.speech.worker_messages import WorkerMessage
from reactive_realizer.engines.speech.worker_process import UNSENT, WorkerProcess
from reactive_realizer.errors import CreationFault, RealizerError


class VoiceFailed(CreationFault):
    """The speech worker failed or was killed."""

    code = "voice-failed"
    template = "the speech worker failed: {reason}"
    reason: str


class SpeechWorker:
    """Requests to a worker. When it ends or hangs, the one that it works on fails; a new worker answers the others.

    Args:
        module: the one that the worker runs.
        patience: time limit of the worker for one reply, s.

    Attributes:
        restarts: number of workers started after the first.
    """

    def __init__(self, module: str, patience: float) -> None:
        self.restarts = 0
        self._module = module
        self._patience = patience
        self._process: WorkerProcess | None = None
        self._starting = asyncio.Lock()

    @property
    def process(self) -> WorkerProcess | None:
        """The process that was started last."""
        return self._process

    @property
    def alive(self) -> bool:
        """Whether a process is running."""
        return self._process is not None and not self._process.ended.done()

    async def hello(self) -> dict[str, Any]:
        """What the worker says of itself when it is ready; starts it if necessary.

        Raises:
            RealizerError: "voice-failed": the worker ended at once.
        """
        return _succeeded(await asyncio.shield((await self._running()).hello)).header

    async def request(self, header: dict[str, Any], rank: int = 0) -> WorkerMessage:
        """The reply to a request; of those that wait, one of the lowest rank is next.

        Raises:
            RealizerError: "voice-failed".
        """
        reply = UNSENT
        while reply is UNSENT:  # each worker that ends fails a request, or all if it does not even begin
            await self.hello()
            reply = await (await self._running()).request(header, rank)
        return _succeeded(reply)

    async def close(self) -> None:
        """Ends the process, also one that is being started."""
        async with self._starting:
            if self._process is not None:
                await self._process.close()

    async def _running(self) -> WorkerProcess:
        async with self._starting:
            if self._process is None or self._process.ended.done():
                self.restarts += self._process is not None
                self._process = await WorkerProcess.start(self._module, self._patience)
        return self._process


def _succeeded(reply: WorkerMessage) -> WorkerMessage:
    if "failed" in reply.header:
        raise RealizerError(VoiceFailed(reason=reply.header["failed"]))
    return reply
