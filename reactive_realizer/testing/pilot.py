"""A realizer with its hand on the clock: the way to write a test of what comes out."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from textwrap import dedent

import numpy as np
import numpy.typing as npt

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.names import BML, BMLA, BMLT
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE, Tick, tick_time
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.inputs import BmlText, Event, Prediction, TargetMoved
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.feedback_list import FeedbackList


class RealizerPilot:
    """Gives BML, moves time on, and keeps everything that came out.

    Attributes:
        feedback: all messages.
        frames: of each character, once `watch` was called.
        sounds: what became audible.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.feedback = FeedbackList()
        self.frames: dict[str, list[Frame]] = {}
        self.sounds: list[AudioChange] = []
        self._number = 0
        scene.realizer.feedback.listen(self.feedback)
        scene.realizer.hear(self.sounds.append)

    @property
    def realizer(self) -> Realizer:
        """What is flown."""
        return self.scene.realizer

    @property
    def now(self) -> GlobalTime:
        """Time of the next tick."""
        return tick_time(self._number)

    def perform(self, text: str | bytes) -> None:
        """Have BML enter at the next tick, as it is."""
        self.realizer.put(BmlText(text), self.now)

    def block(self, id_: str, behaviors: str = "", **attributes: str) -> None:
        """Have a block enter at the next tick: namespaces are declared, attributes as given."""
        self.perform(block(id_, behaviors, **attributes))

    def predict(self, anticipator: str, sync: str, time: float | None) -> None:
        """Say at the next tick when a point is to be."""
        self.realizer.put(Prediction(anticipator, sync, None if time is None else GlobalTime(time)), self.now)

    def event(self, anticipator: str, name: str, value: float | None = None, text: str | None = None) -> None:
        """Have an event happen at the next tick."""
        self.realizer.put(Event(anticipator, name, value, text), self.now)

    def move(self, target: str, position: tuple[float, float, float] | None) -> None:
        """Put a target elsewhere at the next tick."""
        self.realizer.put(TargetMoved(target, position), self.now)

    def watch(self) -> None:
        """Look at the frames from now on."""
        self.realizer.watch(self._keep)

    def path(self, joint: str, character: str | None = None) -> npt.NDArray[np.float64]:
        """Where a joint was in each frame since `watch`, (F, 3), m, from the root of its character."""
        return np.array([subtract(body.place(joint).position, body.root) for body in self.bodies(character)])

    def bodies(self, character: str | None = None) -> list[Body]:
        """The figure in each frame since `watch`, in the axes of the world; of the first character, if none is named.

        So `place` and `root` say where it is in the world, too.
        """
        name = character or next(iter(self.realizer.characters))
        skeleton = self.realizer.characters[name].humanoid.avatar.skeleton
        return [_body(frame, skeleton) for frame in self.frames[name]]

    async def advance(self, seconds: float) -> None:
        """Play the ticks of so many seconds."""
        for _ in range(round(seconds * RATE)):
            await self.tick()

    async def tick(self) -> None:
        """Play one tick, and what it left to be done aside."""
        previous = tick_time(self._number - 1)
        await self.realizer.step(Tick(self._number, previous, self._number % FRAME_EVERY == 0))
        await self.realizer.settle()
        self._number += 1

    def _keep(self, character: Character, frame: Frame) -> None:
        self.frames.setdefault(character.id, []).append(frame)


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
