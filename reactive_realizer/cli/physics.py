"""The command ``physics``: writes the physical model of a character for MuJoCo."""

import argparse
from pathlib import Path

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.faults import NoCharacter
from reactive_realizer.assembly.human_file import read_human_file
from reactive_realizer.cli.scene_options import add_file_options
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.errors import RealizerError
from reactive_realizer.physics.mjcf import mjcf


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``physics``."""
    parser.description = "Writes the physical model of a character as MJCF, the XML format of MuJoCo."
    parser.epilog = "example: reactive-realizer physics alice.xml"
    parser.add_argument("out", type=Path, metavar="OUT.xml", help="the file to write")
    parser.add_argument("--character", metavar="ID", help="a character of the human file; by default its first")
    add_file_options(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status. If a file cannot be used, an error is raised."""
    characters = read_human_file(options.human).characters
    id_ = options.character or next(iter(characters))
    if id_ not in characters:
        raise RealizerError(NoCharacter(file=options.human.name, name=id_, known=tuple(characters)))
    spec = characters[id_]
    avatar = Avatar.read(Assets(tuple(options.assets))(spec.avatar))
    options.out.write_bytes(mjcf(avatar.skeleton, spec.weight))
    return 0
