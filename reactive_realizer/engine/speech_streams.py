"""Speech whose sound clients stream: keeps what has arrived until it is spoken."""

import asyncio
from collections import deque
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any, Final

from reactive_realizer.bml.speech import SoundStream
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.audio import StreamedAudio
from reactive_realizer.errors import CreationFault, Fault, RealizerError
from reactive_realizer.limits import Limits

_SAMPLE: Final = 2
"""Bytes of a sample."""
_FIRST: Final = (0.6, 1.0)
"""Shortest and longest first piece, s: the reserve with which a speech begins whose sound arrives in real time."""
_OTHERS: Final = (0.25, 2.0)
"""Shortest and longest other piece, s; the last one may be shorter."""
_HEADERS: Final = (b"RIFF", b"OggS", b"fLaC", b"ID3", b"\x1aE\xdf\xa3")
"""The first bytes of files with a header: WAV, Ogg, FLAC, MP3 and WebM."""
_REMEMBERED: Final = 1000
"""Number of ended streams whose names are remembered."""


class UnknownStream(Fault):
    """Sound for a stream that no speech uses."""

    code = "unknown-stream"
    template = "no accepted speech uses the stream '{stream}'; streams that wait for sound: {known}"
    unknown = "stream"
    stream: str
    known: tuple[str, ...]


class StreamOver(Fault):
    """Sound for a stream that has ended, or whose speech has ended."""

    code = "stream-over"
    template = "the stream '{stream}', or its speech, has ended; further messages for it are ignored"
    stream: str


class NotSamples(Fault):
    """A stream that begins with the header of a file."""

    code = "not-samples"
    template = "the stream '{stream}' begins with the header of a file; send raw samples: mono, 16 bits, little-endian"
    stream: str


class StreamTooLong(Fault):
    """A stream that exceeds the limit on its duration, s."""

    code = "stream-too-long"
    template = "the stream '{stream}' would last longer than {limit:g} s; this message is ignored"
    stream: str
    limit: float


class StreamTaken(CreationFault):
    """A second speech with the same stream."""

    code = "stream-taken"
    template = "another speech uses the stream '{stream}'"
    stream: str


class TooManyStreams(CreationFault):
    """A stream beyond the limit on their number."""

    code = "too-many-streams"
    template = "the limit of {limit} streamed speeches has been reached"
    limit: int


class StreamSilent(CreationFault):
    """A stream whose sound does not arrive."""

    code = "stream-silent"
    template = "no sound of the stream '{stream}' has arrived for {limit:g} s"
    stream: str
    limit: float


@dataclass(frozen=True, slots=True)
class SoundPiece:
    """A piece of a stream.

    Attributes:
        samples: mono PCM, int16 little-endian.
        words: that have arrived since the piece before, with their starts, s from the start of the stream.
        last: whether it is the last one.
        cut: whether the stream has ended in the middle of a sample.
    """

    samples: bytes
    words: tuple[tuple[str, float], ...]
    last: bool
    cut: bool = False


class SpeechStream:
    """What has arrived of the sound of one speech, in pieces that depend on nothing but the ticks of its arrival.

    Attributes:
        source: its name and rate.
        claimed: whether a speech uses it.
        ended: whether its client has ended it.
        seconds: duration of what has arrived.
        deadline: when it fails if nothing more arrives, s.
    """

    def __init__(self, source: SoundStream, streams: "SpeechStreams") -> None:
        self.source = source
        self.claimed = self.ended = False
        self.seconds = 0.0
        self.deadline = GlobalTime(0.0)
        self._streams = streams
        self._pending = bytearray()
        self._words: list[tuple[str, float]] = []
        self._pieces: deque[SoundPiece] = deque()
        self._begun = self._cut_off = False
        self._failure: Fault | None = None
        self._waiting: tuple[asyncio.Future[None], asyncio.Task[Any]] | None = None

    async def next_piece(self) -> SoundPiece:
        """The next piece, when it has arrived; after the last one, there is none.

        Raises:
            RealizerError: "stream-silent".
        """
        while not self._pieces:
            if self._failure is not None:
                raise RealizerError(self._failure)
            await self._wait()
        return self._pieces.popleft()

    def close(self) -> None:
        """Stop taking its sound."""
        self._streams.forget(self)

    def add(self, audio: StreamedAudio, most_words: int) -> None:
        """Add what has arrived, with a limit on the number of words that wait for their sound."""
        self._pending += audio.audio
        self._words += audio.words[: most_words - len(self._words)]
        self.seconds += len(audio.audio) / _SAMPLE / self.source.rate
        self.ended |= audio.end

    def fail(self, failure: Fault) -> None:
        """Have its speech end after what has arrived."""
        self._failure = failure
        self._wake()

    def cut(self) -> None:
        """Make pieces of what has arrived."""
        while not self._cut_off:
            lengths = _OTHERS if self._begun else _FIRST
            least, most = (round(self.source.rate * seconds) * _SAMPLE for seconds in lengths)
            if len(self._pending) < least and not self.ended:
                return
            samples = bytes(self._pending[: min(most, len(self._pending) // _SAMPLE * _SAMPLE)])
            del self._pending[: len(samples)]
            last = self.ended and len(self._pending) < _SAMPLE
            self._pieces.append(SoundPiece(samples, tuple(self._words), last, last and bool(self._pending)))
            self._words.clear()
            self._begun, self._cut_off = True, last
            self._wake()

    async def _wait(self) -> None:
        task = asyncio.current_task()
        if task is None:
            raise RuntimeError("only a task can wait for sound")
        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._waiting = future, task
        self._streams.begin_wait(task)
        try:
            await future
        finally:
            self._streams.waiting.discard(task)

    def _wake(self) -> None:
        if self._waiting is not None:
            (future, task), self._waiting = self._waiting, None
            self._streams.waiting.discard(task)
            if not future.done():
                future.set_result(None)


class SpeechStreams:
    """The streams of all characters, by name.

    A stream is opened when the document with its speech enters, takes sound as inputs of ticks, and is over when its
    speech has taken all of it or has ended.

    Args:
        limits: on their number, duration and silence.

    Attributes:
        waiting: the tasks that wait for sound; only an input or a tick can wake them.
    """

    def __init__(self, limits: Limits) -> None:
        self.waiting: set[asyncio.Task[Any]] = set()
        self._wait_begun: asyncio.Future[None] | None = None
        self._limits = limits
        self._open: dict[str, SpeechStream] = {}
        self._over: dict[str, None] = {}
        self._now = GlobalTime(0.0)

    @property
    def wait_begun(self) -> "asyncio.Future[None]":
        """A future that is done when another task begins to wait."""
        if self._wait_begun is None or self._wait_begun.done():
            self._wait_begun = asyncio.get_running_loop().create_future()
        return self._wait_begun

    def begin_wait(self, task: "asyncio.Task[Any]") -> None:
        """Note that a task waits for sound."""
        self.waiting.add(task)
        if self._wait_begun is not None and not self._wait_begun.done():
            self._wait_begun.set_result(None)

    def open(self, source: SoundStream) -> None:
        """Have a stream take sound, unless there are too many or it is open."""
        if source.name not in self._open and len(self._open) < self._limits.streams:
            self._over.pop(source.name, None)
            self._open[source.name] = stream = SpeechStream(source, self)
            self._put_off(stream)

    def claim(self, source: SoundStream) -> SpeechStream:
        """The stream of a speech, from its beginning.

        Raises:
            RealizerError: "stream-taken" or "too-many-streams".
        """
        self.open(source)
        stream = self._open.get(source.name)
        if stream is None:
            raise RealizerError(TooManyStreams(limit=self._limits.streams))
        if stream.claimed or stream.source != source:
            raise RealizerError(StreamTaken(stream=source.name))
        stream.claimed = True
        self._put_off(stream)
        return stream

    def forget(self, stream: SpeechStream) -> None:
        """Stop taking sound for a stream."""
        name = stream.source.name
        if self._open.get(name) is stream:
            del self._open[name]
            self._over[name] = None
            if len(self._over) > _REMEMBERED:
                del self._over[next(iter(self._over))]

    @property
    def names(self) -> Collection[str]:
        """The names of the streams that take sound."""
        return self._open.keys()

    def check(self, audio: StreamedAudio, announced: Collection[str] = ()) -> None:
        """Check whether sound can be taken.

        Args:
            audio: of a client.
            announced: names of streams that will have been opened when it enters.

        Raises:
            RealizerError: it cannot.
        """
        name = audio.stream
        stream = self._open.get(name)
        if stream is None and name not in announced:
            over = name in self._over
            fault = StreamOver(stream=name) if over else UnknownStream(stream=name, known=(*self._open, *announced))
            raise RealizerError(fault)
        if stream is not None and stream.ended:
            raise RealizerError(StreamOver(stream=name))
        if (stream is None or not stream.seconds) and audio.audio.startswith(_HEADERS):
            raise RealizerError(NotSamples(stream=name))
        if stream is not None:
            more = len(audio.audio) / _SAMPLE / stream.source.rate
            if stream.seconds + more > self._limits.sound_seconds:
                raise RealizerError(StreamTooLong(stream=name, limit=self._limits.sound_seconds))

    def take(self, audio: StreamedAudio) -> None:
        """Take sound; ignore what cannot be taken."""
        try:
            self.check(audio)
        except RealizerError:
            return
        stream = self._open[audio.stream]
        stream.add(audio, self._limits.utterance_characters)
        if audio.audio:
            self._put_off(stream)

    def advance(self, now: GlobalTime) -> None:
        """After the inputs of a tick, pass what has arrived to the speeches, and fail the streams that are silent."""
        self._now = now
        for stream in tuple(self._open.values()):
            stream.cut()
            if is_due(stream.deadline, now) and not (stream.ended and stream.claimed):
                stream.fail(StreamSilent(stream=stream.source.name, limit=self._limits.stream_seconds))
                self.forget(stream)

    def _put_off(self, stream: SpeechStream) -> None:
        stream.deadline = GlobalTime(self._now + self._limits.stream_seconds)
