"""The engine of ``audiofile`` (thesis 8.12)."""

import asyncio
from collections.abc import Awaitable, Collection, Mapping
from types import MappingProxyType

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.extensions import AudioFile
from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.embodiment.sound_files import SoundFiles
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.sound_engine import SoundEngine
from reactive_realizer.engine.sound_unit import VOLUME_RANGE, SoundPart, SoundUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing


class AudioEngine(SoundEngine):
    """Plays sound files, any number at the same time.

    A file determines the duration of its behavior, which is neither stretched nor cut (thesis 8.12).
    """

    behaviors = frozenset({AudioFile})
    parameters: Mapping[type[Behavior], Mapping[str, Range]] = MappingProxyType({AudioFile: {"volume": VOLUME_RANGE}})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(context, "audio")
        self._asset = context.asset
        self._files = SoundFiles(context.limits.sound_seconds)
        self._graph = context.graph

    def check(self, behavior: Behavior) -> Collection[str]:
        """Start and end.

        Raises:
            RealizerError: "no-asset" or "forbidden-path".
        """
        self._asset(_file_name(behavior))
        return behavior.sync_points

    def prepare(self, behavior: Behavior) -> Awaitable[object]:
        """Read the file in another thread.

        Raises:
            RealizerError: as `check`; the awaitable raises "not-a-sound", "sound-too-long" or "sound-truncated".
        """
        return asyncio.to_thread(self._files.read, self._asset(_file_name(behavior)))

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> SoundUnit:
        """A unit with the duration of the sound."""
        if not isinstance(prepared, Sound):
            raise TypeError(prepared)
        timing = Timing(("start", "end"), (Phase(prepared.duration, PhaseKind.RIGID),))
        return SoundUnit(block, behavior, timing, [SoundPart(0.0, prepared)], self._graph)


def _file_name(behavior: Behavior) -> str:
    if not isinstance(behavior, AudioFile):
        raise TypeError(behavior)
    return behavior.file_name
