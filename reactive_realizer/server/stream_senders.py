"""Clients that send the sound of speeches: one for each stream."""

from reactive_realizer.embodiment.audio import StreamedAudio
from reactive_realizer.engine.speech_streams import StreamOver
from reactive_realizer.errors import RealizerError
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.faults import ForeignStream

_MOST_TOLD = 1000
"""Number of streams that are remembered because a client was told that they are over."""


class StreamSenders:
    """Passes the sound of each stream from the client that began to send it.

    When this client has disconnected, another one may go on, such as the same planner after it has connected again.
    """

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._senders: dict[str, object] = {}
        self._told: set[str] = set()
        """Streams of which a client has been told that they are over."""

    def take(self, audio: StreamedAudio, client: object) -> None:
        """Takes sound of a client. What comes after the end of its speech is ignored, after one error.

        Raises:
            RealizerError: the sound is refused.
        """
        try:
            self._realizer.check_streamed(audio)
        except RealizerError as problem:
            if not isinstance(problem.fault, StreamOver):
                raise
            self._senders.pop(audio.stream, None)
            if audio.stream in self._told:
                return
            if len(self._told) == _MOST_TOLD:
                self._told.clear()
            self._told.add(audio.stream)
            raise
        self._told.discard(audio.stream)
        if audio.stream not in self._senders:
            self._forget_ended()
        if self._senders.setdefault(audio.stream, client) is not client:
            raise RealizerError(ForeignStream(stream=audio.stream))
        self._realizer.put(audio)
        if audio.end:
            del self._senders[audio.stream]

    def leave(self, client: object) -> None:
        """Lets other clients send the streams of a client that has disconnected."""
        self._senders = {stream: sender for stream, sender in self._senders.items() if sender is not client}

    def _forget_ended(self) -> None:
        taking = self._realizer.streams
        self._senders = {stream: sender for stream, sender in self._senders.items() if stream in taking}
