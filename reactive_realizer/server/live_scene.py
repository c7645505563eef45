"""A running scene: its clock, its ticks and the streams that clients follow."""

import gc
import sys
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from reactive_realizer import __version__
from reactive_realizer.assembly.scene import Scene
from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.ticker import Tick, Ticker
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.limits import Limits
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.audio_stream import AudioStream
from reactive_realizer.server.board_stream import BoardStream
from reactive_realizer.server.capabilities import Found, found_for
from reactive_realizer.server.client_limits import Clients
from reactive_realizer.server.feedback_log import FeedbackLog
from reactive_realizer.server.frame_stream import FrameStream
from reactive_realizer.server.pictures_stream import PicturesStream
from reactive_realizer.server.protocol import VERSION, Message
from reactive_realizer.server.steps_stream import StepsStream
from reactive_realizer.server.world_stream import WorldStream

_YOUNG, _OLDER = 7_000, 3_000
"""Number of new objects that trigger a collection of these, which takes about a millisecond: the planning of a tick
leaves as many. And number of these collections after which what they left is searched too, which takes longer the more
is alive."""

_SWITCH = 0.0005
"""Time after which a thread that parses or solves lets a tick begin, s; Python's default is 5 ms."""


def keep_from_ticks() -> None:
    """Keeps the garbage collector and other threads from delaying ticks.

    Existing objects are frozen, so that they are not scanned in the middle of a tick.

    Ended behaviors are freed by reference counting, because they leave no cycles. Only failures, by their tracebacks,
    and behaviors that are dropped during planning leave garbage to collect.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(_YOUNG, _OLDER)
    sys.setswitchinterval(_SWITCH)


@contextmanager
def _collecting_later() -> Iterator[None]:
    """Have the garbage collector wait, if it is enabled; then what is left is searched at once, between two ticks."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class LiveScene:
    """One run of a scene, and its streams.

    Args:
        scene: assembled and started.
        clock: of the session. With a `ManualClock`, the caller calls `step`; otherwise `run` does.
        performance: BML that the demo plays; None for no demo.
        found: files found at the start; None to look for them now.

    Attributes:
        session: id of this run.
        ticker: source of the ticks.
        tick: number of the last tick.
        feedback, sounds, frames, steps, world, pictures, board: the streams.
        clients: the connected clients.
        found: files found at the start, for `capabilities_of`.
    """

    def __init__(self, scene: Scene, clock: Clock, performance: str | None = None, found: Found | None = None) -> None:
        self.scene = scene
        self.clock = clock
        self.performance = performance
        self.session = str(uuid.uuid4())
        self.ticker = Ticker(clock)
        self.tick = 0
        self.feedback = FeedbackLog(self.session, clock.epoch, self.limits)
        self.sounds = AudioStream(self.limits.sound_bytes)
        self.frames = FrameStream(self.realizer)
        self.steps = StepsStream(self.realizer)
        self.world = WorldStream(self.realizer)
        self.pictures = PicturesStream(self.realizer)
        self.board = BoardStream(self.realizer.board, lambda: self.realizer.time)
        self.clients = Clients(self.limits.clients)
        self.found = found_for(scene) if found is None else found
        self.realizer.feedback.listen(self.feedback.append)
        self.realizer.hear(self.sounds.take)

    @property
    def realizer(self) -> Realizer:
        """The realizer of the scene."""
        return self.scene.realizer

    @property
    def limits(self) -> Limits:
        """The limits of the human file."""
        return self.scene.specification.limits

    @property
    def now(self) -> GlobalTime:
        """Realizer time, also between ticks."""
        return self.clock.now()

    async def run(self) -> None:
        """Ticks until it is canceled."""
        async for tick in self.ticker.ticks():
            await self.step(tick)

    async def step(self, tick: Tick) -> None:
        """Plays one tick and publishes its results."""
        with _collecting_later():
            self.feedback.begin_tick()
            await self.realizer.step(tick)
            self.tick = tick.number
            self.feedback.end_tick(tick.time)
            self.sounds.tidy(tick.time)
            self.board.publish()

    def hello(self) -> Message:
        """The first message of a connection."""
        return {
            "type": "hello",
            "protocol": VERSION,
            "version": __version__,
            "session": self.session,
            "time": round(self.now, 6),
            "tick": self.tick,
            "characters": [self._character(index, id_) for index, id_ in enumerate(self.realizer.characters)],
            "demo": self.performance is not None,
        }

    def _character(self, index: int, id_: str) -> Mapping[str, object]:
        avatar = self.realizer.characters[id_].humanoid.avatar
        targets = {
            name: [each._asdict() for each in avatar.targets.named[name]]
            for name in avatar.morphs
            if name in avatar.targets.unnamed
        }
        return {
            "id": id_,
            "index": index,
            "avatar": "/avatars/" + self.scene.avatars[id_].removeprefix("avatars/"),
            "joints": [bone.name for bone in avatar.bones],
            "morphs": list(avatar.morphs),
            **({"targets": targets} if targets else {}),
        }
