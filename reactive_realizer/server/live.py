"""A scene on the air: what its realizer tells, for whoever connects."""

import uuid
from collections.abc import Mapping

from reactive_realizer import __version__
from reactive_realizer.assembly.scene import Scene
from reactive_realizer.clock.clock import Clock
from reactive_realizer.clock.ticker import Tick, Ticker
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.limits import Limits
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.board_watch import BoardWatch
from reactive_realizer.server.capabilities import found_for
from reactive_realizer.server.client_count import ClientCount
from reactive_realizer.server.feedback_log import FeedbackLog
from reactive_realizer.server.frame_stream import FrameStream
from reactive_realizer.server.garbage import keep_from_ticks
from reactive_realizer.server.protocol import VERSION, Message
from reactive_realizer.server.sound_shelf import SoundShelf


class Live:
    """One run of a scene, and its streams.

    Args:
        scene: assembled and started.
        clock: what time it is; with a `ManualClock` somebody calls `step`, else `run` does.
        performance: BML of several blocks that is played on demand; None for no demo.

    Attributes:
        session: id of this run.
        ticker: makes the ticks.
        tick: number of the last one.
        feedback, sounds, frames, board: the streams.
        clients: those connected.
        found: what there was on disk when it began.
    """

    def __init__(self, scene: Scene, clock: Clock, performance: str | None = None) -> None:
        self.scene = scene
        self.clock = clock
        self.performance = performance
        self.session = str(uuid.uuid4())
        self.ticker = Ticker(clock)
        self.tick = 0
        self.feedback = FeedbackLog(self.session, clock.epoch, self.limits)
        self.sounds = SoundShelf(self.limits.sound_bytes)
        self.frames = FrameStream(self.realizer)
        self.board = BoardWatch(self.realizer.board, lambda: self.realizer.time)
        self.clients = ClientCount(self.limits.clients)
        self.found = found_for(scene)
        self.realizer.feedback.listen(self.feedback.append)
        self.realizer.hear(self.sounds.take)

    @property
    def realizer(self) -> Realizer:
        """What everything comes from."""
        return self.scene.realizer

    @property
    def limits(self) -> Limits:
        """Of the human file."""
        return self.scene.specification.limits

    @property
    def now(self) -> GlobalTime:
        """Realizer time, between ticks too."""
        return self.clock.now()

    async def run(self) -> None:
        """Tick for ever."""
        keep_from_ticks()
        async for tick in self.ticker.ticks():
            await self.step(tick)

    async def step(self, tick: Tick) -> None:
        """One tick, and what is sent because of it."""
        await self.realizer.step(tick)
        self.tick = tick.number
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
        return {
            "id": id_,
            "index": index,
            "avatar": "/avatars/" + self.scene.avatars[id_].removeprefix("avatars/"),
            "joints": [bone.name for bone in avatar.bones],
            "morphs": list(avatar.morphs),
        }
