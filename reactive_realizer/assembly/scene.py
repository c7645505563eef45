"""Assembles and runs a scene."""

import logging
import math
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from inspect import Parameter, signature
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.assembly.binding_files import binding_files
from reactive_realizer.assembly.faults import BadHumanFile
from reactive_realizer.assembly.human_file import SPEECH, AnticipatorSpec, CharacterSpec, HumanFile, read_human_file
from reactive_realizer.assembly.registry import load, names
from reactive_realizer.assembly.speech_binding import read_speech_binding
from reactive_realizer.bml.dialects import Dialect, Dialects
from reactive_realizer.bml.expressivity import Expressivity
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import STAND_INS, StandIns
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.answer_checks import check_weights
from reactive_realizer.engine.context import EngineContext, LipSyncProvider
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engine.guarded_engine import FAILURES
from reactive_realizer.engine.speech_streams import SpeechStreams
from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.liveliness.fillers import read_fillers
from reactive_realizer.liveliness.word_classes import read_word_classes
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext
from reactive_realizer.reactive.cell import Source
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.strategy import SchedulingStrategy

_log = logging.getLogger(__name__)

DEFAULT_HUMAN = PACKAGE_ASSETS / "humans" / "default.toml"

WORD_CLASSES, FILLERS = "liveliness/english.toml", "liveliness/fillers.toml"
"""The asset with the words with which speakers move."""


@dataclass(frozen=True, slots=True)
class SceneOptions:
    """The options of a scene.

    Attributes:
        human: the human file.
        voice: id of the text-to-speech binding.
        assets: folders searched before the package's own.
        seed: of all randomness.
        strategy: id of the scheduling strategy.
        verify: whether plans are checked while they are played.
        liveliness: of the characters whose human file does not state it, 0 to 1; None if they only do what is asked.
    """

    human: Path = DEFAULT_HUMAN
    voice: str = "espeak"
    assets: tuple[Path, ...] = ()
    seed: int = 0
    strategy: str = "convex"
    verify: bool = False
    liveliness: float | None = None


@dataclass(frozen=True, slots=True)
class Scene:
    """An assembled scene.

    Attributes:
        specification: as it was read.
        avatars: name of the avatar file of each character.
        tts: the text-to-speech binding.
    """

    realizer: Realizer
    specification: HumanFile
    assets: Assets
    tts: TTSBinding
    avatars: Mapping[str, str] = field(default_factory=dict)


@asynccontextmanager
async def open_scene(options: SceneOptions) -> AsyncIterator[Scene]:
    """Assemble a scene and start its voice and its realizer; both end with the context.

    Raises:
        RealizerError: a file or plug-in does not exist or cannot be used, or a value is invalid.
    """
    specification = read_human_file(options.human)
    assets = Assets(options.assets)
    targets = specification.targets
    world = World(
        {id_: spec.position for id_, spec in targets.items()}, {id_: spec.radius for id_, spec in targets.items()}
    )
    tts: TTSBinding = load("tts", options.voice)()
    time = Source(Graph(), "time", GlobalTime(0.0))
    streams = SpeechStreams(specification.limits)
    characters = [
        _character(id_, spec, specification.limits, world, assets, tts, options, options.seed + rank, time, streams)
        for rank, (id_, spec) in enumerate(specification.characters.items())
    ]
    anticipators = _anticipators(options.human.name, specification.anticipators)
    strategy: SchedulingStrategy = load("strategies", options.strategy)()
    classes, fillers = read_word_classes(assets(WORD_CLASSES)), read_fillers(assets(FILLERS))
    realizer = Realizer(
        characters,
        world,
        anticipators,
        strategy,
        specification.limits,
        time,
        speech_streams=streams,
        word_classes=classes,
        fillers=fillers,
        autonomous={id_: spec.autonomous for id_, spec in specification.characters.items()},
        dialects=Dialects({name: load("dialects", name, Dialect) for name in names("dialects")}),
        verify=options.verify,
    )
    await tts.start()
    try:
        async with realizer:
            avatars = {id_: spec.avatar for id_, spec in specification.characters.items()}
            yield Scene(realizer, specification, assets, tts, avatars)
    finally:
        await tts.close()


def _character(
    id_: str,
    spec: CharacterSpec,
    limits: Limits,
    world: World,
    assets: Assets,
    tts: TTSBinding,
    options: SceneOptions,
    seed: int,
    time: Source[GlobalTime],
    streams: SpeechStreams,
) -> Character:
    heading = math.radians(spec.heading)
    file = _avatar_file(assets, spec.avatar, f"character.{id_}.avatar", options.human)
    avatar, stand_ins = Avatar.read(file), StandIns.read(assets(STAND_INS))
    for note in avatar.notes:
        _log.warning("%s: %s", file.name, note)
    humanoid = Humanoid(avatar, spec.position, heading, spec.weight, spec.simulation_steps, stand_ins)
    world.add_character(id_, humanoid.locate)
    mouth = _Mouth()
    context = EngineContext(
        id_,
        humanoid,
        world,
        assets,
        seed,
        tts,
        spec.voice_of(options.voice),
        binding_files(spec.bindings, file, assets),
        read_speech_binding(assets(spec.bindings[SPEECH]), assets, humanoid) if SPEECH in spec.bindings else None,
        mouth,
        folder=assets.folder,
        trajectories={name: load("trajectories", name) for name in names("trajectories")},
        functions={name: load("functions", name) for name in names("functions")},
        motions={name: load("motions", name) for name in names("motions")},
        time=time,
        idle=spec.idle,
        blink_rate=spec.blink_rate,
        limits=limits,
        liveliness=options.liveliness if spec.liveliness is None else spec.liveliness,
        speech_streams=streams,
        expressivity=Expressivity(**spec.expressivity),
    )
    engines: list[Engine] = [load("engines", name)(context) for name in spec.engines]
    mouth.voices = [engine for engine in engines if isinstance(engine, LipSyncProvider)]
    return Character(id_, humanoid, tuple(engines), spec.voice_of(options.voice))


class _Mouth:
    """The lip sync of a character, from the first of its engines that is speaking."""

    def __init__(self) -> None:
        self.voices: list[LipSyncProvider] = []
        self._told = ""
        """The failure that was logged last."""

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        return next((weights for voice in self.voices if (weights := self._weights(voice, time)) is not None), None)

    def _weights(self, voice: LipSyncProvider, time: GlobalTime) -> Mapping[str, float] | None:
        """Those of a voice; if its lip sync fails, it leaves the mouth closed, and faces as they are."""
        try:
            weights = voice.mouth(time)
            if weights is not None:
                check_weights(weights)
        except FAILURES as failure:
            if repr(failure) != self._told:  # it may fail in the same way in every frame
                self._told = repr(failure)
                _log.error("lip sync failed at %.2f s", time, exc_info=failure)
            return None
        return weights


def _anticipators(
    file: str, specs: Mapping[str, AnticipatorSpec]
) -> Callable[[Callable[[str], AnticipatorContext]], list[Anticipator]]:
    return lambda context: [_anticipator(file, id_, spec, context(id_)) for id_, spec in specs.items()]


def _anticipator(file: str, id_: str, spec: AnticipatorSpec, context: AnticipatorContext) -> Anticipator:
    cls: type[Anticipator] = load("anticipators", spec.kind)
    defaults = _parameters(cls)
    for name, value in spec.parameters.items():
        if name not in defaults:
            reason = f"unknown; known are {', '.join(['kind', *defaults])}"
        elif isinstance(value, tuple) is not isinstance(defaults[name], tuple):
            reason = f"expected a {'list of names' if isinstance(defaults[name], tuple) else 'number'}"
        else:
            continue
        raise RealizerError(BadHumanFile(file=file, key=f"anticipator.{id_}.{name}", reason=reason))
    try:
        return cls(context, **spec.parameters)
    except RealizerError as refused:
        reason = refused.fault.sentence
        raise RealizerError(BadHumanFile(file=file, key=f"anticipator.{id_}", reason=reason)) from refused


def _parameters(cls: type[Anticipator]) -> Mapping[str, object]:
    """The parameters of an anticipator that a human file can set, with defaults; not its keyword-only ones."""
    parameters = signature(cls).parameters.values()
    given = [own for own in parameters if own.kind is Parameter.POSITIONAL_OR_KEYWORD]
    return {own.name: own.default for own in given if own.name != "context"}


def _avatar_file(assets: Assets, name: str, key: str, human: Path) -> Path:
    """Return the file of an avatar that a key of a human file names."""
    try:
        return assets(name)
    except RealizerError as problem:
        raise RealizerError(BadHumanFile(file=human.name, key=key, reason=problem.fault.sentence)) from problem
