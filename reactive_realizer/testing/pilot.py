"""Drives a realizer in tests: gives BML, advances time, and records all output."""

import asyncio
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from textwrap import dedent

import numpy as np
import numpy.typing as npt

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.names import BML, BMLA, BMLT
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE, Tick, tick_time
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioHeard, StreamedAudio
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.realizer.inputs import BmlText, Event, Prediction, Push, TargetMoved
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.feedback_list import FeedbackList

_TURNS = 5
"""Turns of the event loop after a tick, in which slow work that is not waited for takes notice of what has happened."""


class RealizerPilot:
    """Gives BML to a realizer, advances its time, and records its output.

    Attributes:
        scene: the scene of the realizer.
        feedback: all messages.
        frames: the frames of each character since `watch` was called.
        sounds: the changes of sounds.
        patient: whether time stands still while slow work is done, as on a virtual clock.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.feedback = FeedbackList()
        self.frames: dict[str, list[Frame]] = {}
        self.sounds: list[AudioChange] = []
        self.patient = True
        self._bodies: dict[str, tuple[list[Frame], list[Body]]] = {}
        self._number = 0
        self._left_out = 0
        scene.realizer.feedback.listen(self.feedback)
        scene.realizer.hear(self.sounds.append)

    @property
    def realizer(self) -> Realizer:
        """The realizer of the scene."""
        return self.scene.realizer

    @property
    def now(self) -> GlobalTime:
        """The time of the next tick."""
        return tick_time(self._number)

    def perform(self, text: str | bytes) -> None:
        """Sends a BML document, which enters at the next tick."""
        self.realizer.put(BmlText(text), self.now)

    def block(self, id_: str, behaviors: str = "", **attributes: str) -> None:
        """Sends a block with the usual namespaces declared, which enters at the next tick."""
        self.perform(block(id_, behaviors, **attributes))

    def predict(self, anticipator: str, sync: str, time: float | None) -> None:
        """Predicts the time of a point, s, at the next tick."""
        self.realizer.put(Prediction(anticipator, sync, None if time is None else GlobalTime(time)), self.now)

    def event(self, anticipator: str, name: str, value: float | None = None, text: str | None = None) -> None:
        """Sends an event to an anticipator at the next tick."""
        self.realizer.put(Event(anticipator, name, value, text), self.now)

    def heard(self, clip: str, position: float, time: float) -> None:
        """Reports at the next tick that a position (s) of a clip was heard at a time (s)."""
        self.realizer.put(AudioHeard(clip, position, GlobalTime(time)), self.now)

    def stream(self, name: str, audio: bytes = b"", *words: tuple[str, float], end: bool = False) -> None:
        """Sends sound of a streamed speech at the next tick: mono PCM, int16, with the starts (s) of words in it."""
        self.realizer.put(StreamedAudio(name, audio, words, end), self.now)

    def move(
        self,
        target: str,
        position: tuple[float, float, float] | None,
        orientation: tuple[float, float, float, float] | None = None,
    ) -> None:
        """Moves a target at the next tick, and turns it, if there is an orientation (w, x, y, z); None removes it."""
        self.realizer.put(TargetMoved(target, position, orientation), self.now)

    def push(
        self, joint: str, force: tuple[float, float, float], duration: float, character: str | None = None
    ) -> None:
        """Pushes a character, by default the first, at the next tick: with a force, N, for a duration, s."""
        name = character or next(iter(self.realizer.characters))
        self.realizer.put(Push(name, joint, force, duration), self.now)

    def watch(self) -> None:
        """Records frames from now on."""
        self.realizer.watch(self._keep)

    def path(self, joint: str, character: str | None = None) -> npt.NDArray[np.float64]:
        """The position of a joint in each frame since `watch`, (F, 3), m, relative to the root of its character."""
        return np.array([subtract(body.transform(joint).position, body.root) for body in self.bodies(character)])

    def bodies(self, character: str | None = None) -> list[Body]:
        """The body in each frame since `watch`, in world coordinates; by default of the first character."""
        name = character or next(iter(self.realizer.characters))
        skeleton = self.realizer.characters[name].humanoid.avatar.skeleton
        frames = self.frames[name]
        # A body caches its transforms, and tests ask for the same ones again.
        known, bodies = self._bodies.get(name, (frames, []))
        if known is not frames:
            bodies = []
        bodies += [_body(frame, skeleton) for frame in frames[len(bodies) :]]
        self._bodies[name] = frames, bodies
        return bodies[:]

    async def advance(self, seconds: float) -> None:
        """Plays the ticks of some seconds."""
        for _ in range(round(seconds * RATE)):
            await self.tick()

    def skip(self, ticks: int) -> None:
        """Leaves some ticks out: the next one is late, and covers them."""
        self._number += ticks
        self._left_out += ticks

    async def tick(self) -> None:
        """Plays one tick, and waits for the slow work that it started, if it is patient."""
        previous = tick_time(self._number - 1 - self._left_out)
        self._left_out = 0
        await self.realizer.step(Tick(self._number, previous, self._number % FRAME_EVERY == 0))
        if self.patient:
            await self.realizer.settle()
        for _ in range(1 if self.patient else _TURNS):
            await asyncio.sleep(0)
        self._number += 1

    def _keep(self, frames: Mapping[str, Frame]) -> None:
        for id_, frame in frames.items():
            self.frames.setdefault(id_, []).append(frame)


def _body(frame: Frame, skeleton: Skeleton) -> Body:
    pose = dict(zip(skeleton.joints, map(tuple, frame.rotations.tolist()), strict=True))
    x, y, z = frame.root.tolist()
    return Body(skeleton, pose, subtract((x, y, z), skeleton.offset(ROOT)))


def block(id_: str, behaviors: str = "", **attributes: str) -> str:
    """A ``<bml>`` element with the usual namespaces declared."""
    own = "".join(f' {name}="{value}"' for name, value in attributes.items())
    spaces = f'xmlns="{BML}" xmlns:bmla="{BMLA}" xmlns:bmlt="{BMLT}"'
    return f'<bml {spaces} id="{id_}"{own}>{dedent(behaviors)}</bml>'


@asynccontextmanager
async def open_pilot(options: SceneOptions | None = None) -> AsyncIterator[RealizerPilot]:
    """A pilot of a scene, with the text voice unless options say otherwise."""
    async with open_scene(options or SceneOptions(voice="text")) as scene:
        yield RealizerPilot(scene)
