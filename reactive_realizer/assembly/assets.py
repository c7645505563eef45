"""Where files are found by name."""

import os
from functools import lru_cache
from pathlib import Path, PurePosixPath
from stat import S_ISREG

from reactive_realizer.errors import error

PACKAGE_ASSETS = Path(__file__).parent.parent / "assets"


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

    def __call__(self, name: str) -> Path:
        """The file of a name: as written, then without leading folders one by one.

        Raises:
            RealizerError: the name leaves the folders, or no file has it.
        """
        path = PurePosixPath(name)
        if path.is_absolute() or ".." in path.parts or "\\" in name or not path.parts:
            raise error("forbidden-path", name=name)
        for folder in self._folders:
            for start in range(len(path.parts)):
                found = _within(folder, folder.joinpath(*path.parts[start:]))
                if found is not None:
                    return found
        raise error("no-asset", name=name)


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
