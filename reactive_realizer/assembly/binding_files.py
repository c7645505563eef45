"""The binding files of a character: those of the user take precedence over those of the package."""

from collections.abc import Mapping
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.assembly.human_file import DEFAULT_BINDINGS, VISEMES


def binding_files(names: Mapping[str, str], avatar: Path, assets: Assets) -> dict[str, tuple[Path, ...]]:
    """The binding files by kind, in order of precedence: the character's own, its avatar's, the package's.

    Args:
        names: kind -> name of the character's file.
        avatar: the file of the avatar. The viseme binding of NAME.glb is NAME.visemes.toml in the same folder, if there
            is one.
        assets: finds the files of the character.

    Raises:
        RealizerError: a file of the character does not exist.
    """
    files: dict[str, tuple[Path, ...]] = {kind: (assets(name),) for kind, name in names.items()}
    own = avatar.with_suffix(f".{VISEMES}.toml")
    if own.is_file():
        files[VISEMES] = (*files.get(VISEMES, ()), own)
    for kind, name in DEFAULT_BINDINGS.items():
        files[kind] = tuple(dict.fromkeys((*files.get(kind, ()), PACKAGE_ASSETS / name)))
    return files
