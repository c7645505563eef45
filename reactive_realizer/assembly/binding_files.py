"""The binding files of a character: those of the user take precedence over those of the package."""

from collections.abc import Mapping
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.assembly.human_file import DEFAULT_BINDINGS


def binding_files(names: Mapping[str, str], assets: Assets) -> dict[str, tuple[Path, ...]]:
    """The binding files by kind, in order of precedence; that of the package is last.

    Args:
        names: kind -> name of the character's file.
        assets: finds the file.

    Raises:
        RealizerError: a file does not exist.
    """
    own = {kind: PACKAGE_ASSETS / file for kind, file in DEFAULT_BINDINGS.items()}
    return {kind: tuple(dict.fromkeys((assets(name), own[kind]))) for kind, name in names.items()}
