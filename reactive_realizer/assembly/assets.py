"""Where files are found by name."""

import os
from functools import lru_cache
from pathlib import Path, PurePosixPath
from stat import S_ISREG

from reactive_realizer.assembly.asset_index import AssetIndex
from reactive_realizer.errors import error

PACKAGE_ASSETS = Path(__file__).parent.parent / "assets"

_ANYWHERE = "**/"
"""The beginning of a name that is looked for in all folders, however deep."""


class Assets:
    """Folders in which names of assets are resolved, in order; the package's own comes last.

    Args:
        folders: the user's.

    Raises:
        RealizerError: a folder does not exist.
    """

    def __init__(self, folders: tuple[Path, ...] = ()) -> None:
        for folder in folders:
            if not folder.is_dir():
                raise error("no-folder", folder=folder)
        self._folders = (*(folder.resolve() for folder in folders), PACKAGE_ASSETS)
        self._indices = {folder: AssetIndex(folder) for folder in self._folders}
        # Names are asked for again and again, and making paths takes longer than looking whether they are there.
        self._places = lru_cache(1000)(self._all_places)

    def __call__(self, name: str) -> Path:
        """The file of a name: as written, then without leading folders one by one; with ``**/`` before it, anywhere.

        Raises:
            RealizerError: the name leaves the folders, or no file has it, or several in the folders of one root.
        """
        if name.startswith(_ANYWHERE):
            return self._anywhere(_relative(name).relative_to(_ANYWHERE))
        for folder, file in self._places(name):
            if (found := _within(folder, file)) is not None:
                return found
        raise error("no-asset", name=name)

    def _all_places(self, name: str) -> list[tuple[Path, Path]]:
        """Where a file may be, as written and without its leading folders, each place with the root that it is in."""
        path = _relative(name)
        ends = [path.parts[start:] for start in range(len(path.parts))]
        return [(folder, folder.joinpath(*end)) for folder in self._folders for end in ends]

    def _anywhere(self, name: PurePosixPath) -> Path:
        for folder, index in self._indices.items():
            files = (file for file in index.files(name.name) if file.parts[-len(name.parts) :] == name.parts)
            found = sorted(filter(None, (_within(folder, file) for file in files)))
            if len(found) > 1:
                known = ", ".join(str(file.relative_to(folder)) for file in found)
                raise error("two-assets", name=name.name, known=known)
            if found:
                return found[0]
        raise error("no-asset", name=name.name)


def _relative(name: str) -> PurePosixPath:
    """The path of a name.

    Raises:
        RealizerError: "forbidden-path".
    """
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or "\\" in name or not path.parts:
        raise error("forbidden-path", name=name)
    return path


def _within(folder: Path, file: Path) -> Path | None:
    """The file, if it is one and no link leads out of its folder."""
    try:
        status = os.stat(file)
    except (OSError, ValueError):  # not there, or no name that a file could have
        return None
    return _resolved(folder, file, status.st_ino) if S_ISREG(status.st_mode) else None


@lru_cache(1000)
def _resolved(folder: Path, file: Path, inode: int) -> Path | None:
    """Where a file really is, None if that is not in its folder: found once for each file, for it takes its time."""
    found = file.resolve()
    return found if found.is_relative_to(folder.resolve()) else None
