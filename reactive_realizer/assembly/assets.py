"""Finds asset files by name."""

import os
from collections.abc import Mapping, Sequence
from functools import cache, lru_cache
from itertools import chain
from pathlib import Path, PurePosixPath
from stat import S_ISREG
from typing import NamedTuple

from reactive_realizer.assembly.faults import ForbiddenPath, NoFolder, TwoAssets
from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.errors import RealizerError


class _Found(NamedTuple):
    """The files and folders that a walk found.

    Attributes:
        changed: folder -> when an entry of it was last added or removed, ns.
        files: name -> files with it, in any order.
        by_suffix: suffix, such as ``.xml`` -> names of files.
    """

    changed: Mapping[str, int]
    files: Mapping[str, Sequence[Path]]
    by_suffix: Mapping[str, Sequence[str]]


class AssetIndex:
    """An index of the files of a folder by name; walking the folder for each name would take longer than a tick.

    The folder is walked again when the modification time of any folder in it has changed. Several threads may use it.
    """

    def __init__(self, folder: Path) -> None:
        """Creates an index, which walks the folder: this takes milliseconds, so it is not for the midst of a tick."""
        self._folder = folder
        self._found = self._walk()

    def names(self, suffix: str) -> Sequence[str]:
        """The names of the files with a suffix, such as ``.xml``, when the folder was last walked."""
        return self._found.by_suffix.get(suffix, ())

    def files(self, name: str) -> Sequence[Path]:
        """The files with a name, in any order. Links to folders are not followed."""
        found = self._found
        if any(_changed(folder) != at for folder, at in found.changed.items()):
            found = self._found = self._walk()
        return found.files.get(name, ())

    def _walk(self) -> _Found:
        changed: dict[str, int] = {}
        found: dict[str, list[Path]] = {}
        by_suffix: dict[str, list[str]] = {}
        for folder, _, files in os.walk(self._folder):
            changed[folder] = _changed(folder)
            for name in files:
                found.setdefault(name, []).append(Path(folder, name))
        for name in found:
            by_suffix.setdefault(PurePosixPath(name).suffix, []).append(name)
        return _Found(changed, found, by_suffix)


def _changed(folder: str) -> int:
    """The time at which an entry of a folder was last added or removed, ns; 0 if the folder no longer exists."""
    try:
        return os.stat(folder).st_mtime_ns
    except OSError:
        return 0


PACKAGE_ASSETS = Path(__file__).parent.parent / "assets"


@cache
def _package_index() -> AssetIndex:
    """The index of the package's assets, shared by all scenes."""
    return AssetIndex(PACKAGE_ASSETS)


_ANYWHERE = "**/"
"""Prefix of a name that may be in a folder of any depth."""


class Assets:
    """Resolves names of assets in several folders, in order; the folder of the package comes last.

    Args:
        folders: the user's.

    Raises:
        RealizerError: a folder does not exist.
    """

    def __init__(self, folders: tuple[Path, ...] = ()) -> None:
        for folder in folders:
            if not folder.is_dir():
                raise RealizerError(NoFolder(folder=str(folder)))
        self._folders = (*(folder.resolve() for folder in folders), PACKAGE_ASSETS)
        users = {folder: AssetIndex(folder) for folder in self._folders[:-1]}
        self._indices = {**users, PACKAGE_ASSETS: _package_index()}
        # The same names are resolved again and again, and building paths takes longer than checking files.
        self._places = lru_cache(1000)(self._all_places)

    def __call__(self, name: str) -> Path:
        """The file of a name: first as written, then without its leading folders; with a prefix ``**/``, at any depth.

        Raises:
            RealizerError: the name leads out of the folders, or no file, or several files of one root, have it.
        """
        if name.startswith(_ANYWHERE):
            return self._anywhere(_relative(name).relative_to(_ANYWHERE))
        for folder, file in self._places(name):
            if (found := _within(folder, file)) is not None:
                return found
        raise RealizerError(self._missing(name))

    def folder(self, name: str) -> list[str]:
        """The names of the files directly in a folder, as written or without its leading folders; none without one.

        A file is left out if its name in the folder leads to another one, in an earlier root.

        Raises:
            RealizerError: "forbidden-path".
        """
        for root, path in self._places(name):
            try:
                if path.resolve().is_relative_to(root.resolve()):
                    with os.scandir(path) as entries:
                        files = [entry.name for entry in entries if entry.is_file()]
                    return [file for file in files if self(f"{name}/{file}") == (path / file).resolve()]
            except (OSError, ValueError):  # it does not exist, is no folder, or its name is not valid
                continue
        return []

    def _all_places(self, name: str) -> list[tuple[Path, Path]]:
        """The possible paths of a name, as written and without its leading folders, each with its root."""
        path = _relative(name)
        ends = [path.parts[start:] for start in range(len(path.parts))]
        return [(folder, folder.joinpath(*end)) for folder in self._folders for end in ends]

    def _anywhere(self, name: PurePosixPath) -> Path:
        for folder, index in self._indices.items():
            files = (file for file in index.files(name.name) if file.parts[-len(name.parts) :] == name.parts)
            found = sorted(filter(None, (_within(folder, file) for file in files)))
            if len(found) > 1:
                known = tuple(str(file.relative_to(folder)) for file in found)
                raise RealizerError(TwoAssets(name=name.name, known=known))
            if found:
                return found[0]
        raise RealizerError(self._missing(name.name))

    def _missing(self, name: str) -> NoAsset:
        """The fault of a name that no file has."""
        file = PurePosixPath(name)
        known = chain.from_iterable(index.names(file.suffix) for index in self._indices.values())
        return NoAsset(name=name, files=(file.name,), known=tuple(known))


def _relative(name: str) -> PurePosixPath:
    """The relative path of a name.

    Raises:
        RealizerError: "forbidden-path".
    """
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or "\\" in name or not path.parts:
        raise RealizerError(ForbiddenPath(name=name))
    return path


def _within(folder: Path, file: Path) -> Path | None:
    """The file, if it is a regular file inside its folder after resolving links."""
    try:
        status = os.stat(file)
    except (OSError, ValueError):  # it does not exist, or its name is not valid
        return None
    return _resolved(folder, file, status.st_ino) if S_ISREG(status.st_mode) else None


@lru_cache(1000)
def _resolved(folder: Path, file: Path, inode: int) -> Path | None:
    """The resolved file, None if it is outside its folder; cached because resolving is slow."""
    found = file.resolve()
    return found if found.is_relative_to(folder.resolve()) else None
