"""Where files are, by name, in a folder and all below it."""

import os
from collections.abc import Sequence
from pathlib import Path


class AssetIndex:
    """The files of a folder by name: a walk through all of it for each name would take more than a tick has.

    A folder in which files come or go has another time of change; then all are walked again.
    """

    def __init__(self, folder: Path) -> None:
        """Of a folder, which is walked when the first name is asked for."""
        self._folder = folder
        self._changed: dict[str, int] = {}
        self._files: dict[str, list[Path]] = {}

    def files(self, name: str) -> Sequence[Path]:
        """The files of a name, in no order; links to folders are not followed."""
        if not self._changed or any(_changed(folder) != at for folder, at in self._changed.items()):
            self._walk()
        return self._files.get(name, ())

    def _walk(self) -> None:
        self._changed, self._files = {}, {}
        for folder, _, files in os.walk(self._folder):
            self._changed[folder] = _changed(folder)
            for name in files:
                self._files.setdefault(name, []).append(Path(folder, name))


def _changed(folder: str) -> int:
    """When something came into a folder or left it, ns; 0 for one that is not there any more."""
    try:
        return os.stat(folder).st_mtime_ns
    except OSError:
        return 0
