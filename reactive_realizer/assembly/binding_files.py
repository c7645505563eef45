"""The bindings of a character: what a user says, and under it what the package does."""

from collections.abc import Mapping
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.assembly.human_file import DEFAULT_BINDINGS


def binding_files(names: Mapping[str, str], assets: Assets) -> dict[str, tuple[Path, ...]]:
    """Files by kind of binding, those that count more first; the package's own comes last.

    Args:
        names: kind -> name of the file that the character has.
        assets: where it is found.

    Raises:
        RealizerError: it is not there.
    """
    own = {kind: PACKAGE_ASSETS / file for kind, file in DEFAULT_BINDINGS.items()}
    return {kind: tuple(dict.fromkeys((assets(name), own[kind]))) for kind, name in names.items()}
