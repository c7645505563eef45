"""Makes the frames of all characters from what their engines show, and gives them to listeners."""

import asyncio
import os
from collections.abc import Callable, Iterator, Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.engine.effects import Output
from reactive_realizer.engine.engine_task import EngineTasks
from reactive_realizer.engine.guarded_engine import GuardedEngine
from reactive_realizer.realizer.character import Character

_CORES = os.cpu_count() or 1

FramesListener = Callable[[Mapping[str, Frame]], None]


class FrameMaker:
    """Makes frames."""

    def __init__(
        self, characters: Sequence[Character], engines: Mapping[str, Sequence[GuardedEngine]], showing: EngineTasks
    ) -> None:
        """Prepare to make frames.

        Args:
            characters: in the order in which they move.
            engines: of each character, by its id.
            showing: the engines that show something in frames.
        """
        self._characters = characters
        self._engines = engines
        self._showing = showing
        self._listeners: list[FramesListener] = []

    def watch(self, listener: FramesListener) -> Callable[[], None]:
        """Call a listener with the frames of each tick, by the ids of all characters in their order.

        The returned function ends that.
        """
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    @property
    def watched(self) -> bool:
        """Whether there are listeners."""
        return bool(self._listeners)

    @property
    def needed(self) -> bool:
        """Whether a listener wants frames, or an engine needs them itself."""
        return self.watched or self._showing.need_frames

    async def publish(self, time: GlobalTime, outputs: Sequence[Output]) -> None:
        """Make the frames of a tick.

        Args:
            time: of the tick, s.
            outputs: of the engines that show something, in their order.
        """
        by_engine = dict(zip((task.engine for task in self._showing.tasks), outputs, strict=True))
        shown = [
            (character, [by_engine[engine] for engine in self._engines[character.id] if engine in by_engine])
            for character in self._characters
        ]
        simulations = [simulation for character, own in shown for simulation in character.move(time, own)]
        # One thread a core: more of them would only wait for the interpreter's lock.
        threads, waiting = min(_CORES, len(simulations)), iter(simulations)
        await asyncio.gather(*(asyncio.to_thread(_call_all, waiting) for _ in range(threads)))
        # Eyes look at the positions that other characters, and the character's own hands, have in this frame.
        frames = {character.id: character.look(own) for character, own in shown}
        for listener in tuple(self._listeners):
            listener(frames)


def _call_all(waiting: Iterator[Callable[[], None]]) -> None:
    """Call what is left of an iterator that threads share."""
    for call in waiting:
        call()
