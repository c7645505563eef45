"""What engines are made from, where there is no scene."""

from functools import cache
from pathlib import Path

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.binding_files import binding_files
from reactive_realizer.assembly.human_file import CharacterSpec
from reactive_realizer.assembly.registry import load, names
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.engines.speech.text_voice import TextVoice

CHARACTER = "alice"


def lone_context(tts: TTSBinding | None = None, *assets: Path) -> EngineContext:
    """Alice, alone before a target ``viewer``, with the text voice unless told otherwise.

    Args:
        tts: started already.
        assets: folders searched before the package's own.
    """
    spec, found = CharacterSpec(), Assets(assets)
    humanoid = Humanoid(_avatar(found(spec.avatar)))
    world = World({"viewer": (0.0, 1.6, 2.5)})
    world.add_character(CHARACTER, humanoid.locate)
    trajectories = {name: load("trajectories", name) for name in names("trajectories")}
    voice, bindings = tts or TextVoice(), binding_files(spec.bindings, found)
    return EngineContext(CHARACTER, humanoid, world, found, 0, voice, None, bindings, trajectories=trajectories)


@cache
def _avatar(path: Path) -> Avatar:
    return Avatar.read(path)
