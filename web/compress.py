"""Puts a compressed copy beside each file of some folders: ``python web/compress.py FOLDER...``.

The server sends the copy to browsers that accept it.
"""

import gzip
import sys
from pathlib import Path


def compress(folder: Path) -> None:
    """Compresses the files of a folder and of those in it; copies do not differ from one run to the next."""
    for file in folder.rglob("*"):
        if file.is_file() and file.suffix != ".gz":
            file.with_name(file.name + ".gz").write_bytes(gzip.compress(file.read_bytes(), 9, mtime=0))


if __name__ == "__main__":
    for name in sys.argv[1:]:
        compress(Path(name))
