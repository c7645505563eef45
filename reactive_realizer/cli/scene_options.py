"""The options that describe a scene, which several commands have."""

import argparse
from pathlib import Path

from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions

LIVELINESS = 0.5
"""The liveliness of characters, unless the human file or an option states it."""


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
    parser.add_argument(
        "--liveliness",
        type=_share,
        default=LIVELINESS,
        metavar="N",
        help="how much the characters move while they speak, 0 (only as asked) to 1, if the human file does not say it",
    )
    parser.add_argument("--verify", action="store_true", help="check the constraints of plans during playback")


def scene_options(options: argparse.Namespace) -> SceneOptions:
    """The values of `add_scene_options`."""
    assets = tuple(options.assets)
    return SceneOptions(
        options.human,
        options.voice,
        assets,
        options.seed,
        options.strategy,
        options.verify,
        options.liveliness,
    )


def _share(text: str) -> float:
    value = float(text)
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"{text} is not from 0 to 1")
    return value
