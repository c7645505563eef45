"""The options that describe a scene, which several commands have."""

import argparse
from pathlib import Path

from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions


def add_file_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that choose the files of a scene."""
    parser.add_argument("--human", type=Path, default=DEFAULT_HUMAN, metavar="FILE", help="the human file of the scene")
    parser.add_argument(
        "--assets",
        type=Path,
        action="append",
        default=[],
        metavar="DIR",
        help="a folder of assets, searched before the package's; can be repeated",
    )


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    """Add all options of a scene."""
    add_file_options(parser)
    parser.add_argument(
        "--voice", choices=names("tts"), default="espeak", help="the text-to-speech system; text is silent"
    )
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="the seed of idle animation and noise")
    parser.add_argument("--strategy", choices=names("strategies"), default="convex", help="the scheduling strategy")
    parser.add_argument("--verify", action="store_true", help="check the constraints of plans during playback")


def scene_options(options: argparse.Namespace) -> SceneOptions:
    """The values of `add_scene_options`."""
    assets = tuple(options.assets)
    return SceneOptions(options.human, options.voice, assets, options.seed, options.strategy, options.verify)
