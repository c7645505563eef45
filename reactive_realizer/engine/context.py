"""The context from which engines are made."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from reactive_realizer.binding.viseme_file import MouthTables
from reactive_realizer.bml.expressivity import NEUTRAL, Expressivity
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.speech_streams import SpeechStreams
from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.limits import Limits
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph

TrajectoryFunction = Callable[[float], float]
"""Maps a share of the duration of a change to a share of the change; both 0 to 1, and 1 at 1."""


@runtime_checkable
class LipSyncProvider(Protocol):
    """Visemes over time, from the speech engine; `assembly` gives it to the face engine."""

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        """Weights (0..1) of morph targets at a time; empty in a pause of an utterance, None without an utterance."""
        ...


def _no_files(folder: str) -> Sequence[str]:
    return ()


@dataclass(frozen=True, slots=True)
class EngineContext:
    """The context of the engines of one character. The constructor of each engine takes it.

    Attributes:
        character: its id.
        humanoid: its figure.
        world: the targets of gaze and pointing.
        asset: finds a file by name.
        seed: of the random numbers of this character.
        tts: the text-to-speech binding that all characters share.
        voice: name of this character's voice, None for the binding's default.
        bindings: the character's binding files, by kind, if it has any; entries of earlier files take precedence.
        speech_binding: the mouth by joints, which takes precedence over that of `bindings`; None for none.
        lip_sync: visemes of this character's speech.
        folder: returns the names of the files in a folder among the assets, none if there is no such folder.
        time: the time of the present tick, s, for cells that change with time.
        trajectories: for changes of parameters, by name.
        functions: pure functions that formulas of animations may call besides the built-in ones, by name.
        motions: makers of motions of plug-ins, by the name of their kind in gesture bindings; each is called with the
            context of the makers of the animation engine.
        idle: degree of its idle animation, 0 to 1; 0 for none.
        blink_rate: blinks per minute of idle animation; None for the usual rate.
        limits: on what the engines read.
        liveliness: how lively it is while it speaks, 0 to 1; None if only a speech may ask for that.
        speech_streams: the sound of speeches that clients send, of all characters.
        expressivity: of its gestures and pointing, unless they ask for another one.
    """

    character: str
    humanoid: Humanoid
    world: World
    asset: Callable[[str], Path]
    seed: int
    tts: TTSBinding
    voice: str | None
    bindings: Mapping[str, tuple[Path, ...]]
    speech_binding: MouthTables | None = None
    lip_sync: LipSyncProvider | None = None
    folder: Callable[[str], Sequence[str]] = _no_files
    time: Source[GlobalTime] = field(default_factory=lambda: Source(Graph(), "time", GlobalTime(0.0)))
    trajectories: Mapping[str, TrajectoryFunction] = field(default_factory=dict)
    functions: Mapping[str, Callable[..., float]] = field(default_factory=dict)
    motions: Mapping[str, Callable[[Any], Any]] = field(default_factory=dict)
    idle: float = 1.0
    blink_rate: float | None = None
    limits: Limits = field(default_factory=Limits)
    liveliness: float | None = None
    speech_streams: SpeechStreams = field(default_factory=lambda: SpeechStreams(Limits()))
    expressivity: Expressivity = NEUTRAL

    @property
    def graph(self) -> Graph:
        """The graph of the cells of behavior parameters."""
        return self.time.graph
