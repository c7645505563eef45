"""The command ``avatar``: says what the realizer finds in an avatar file."""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path

from reactive_realizer.embodiment.avatar import SKIN_COLORS, Avatar
from reactive_realizer.embodiment.mixamo import JOINTS


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``avatar``."""
    parser.description = "Says which joints and morph targets an avatar has, and which it lacks."
    parser.epilog = "example: reactive-realizer avatar my_assets/avatars/anna.vrm --write anna.toml"
    parser.add_argument("file", type=Path, metavar="FILE", help="a GLB or VRM file")
    parser.add_argument("--write", type=Path, metavar="HUMAN.toml", help="write a human file with this avatar")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status. If the file cannot be used, an error is raised."""
    avatar = Avatar.read(options.file)
    print("\n".join(_lines(avatar)))
    if options.write:
        name = json.dumps(f"avatars/{options.file.name}", ensure_ascii=False)
        options.write.write_text(f"[character.alice]\navatar = {name}\n", encoding="utf-8")
    return 0


def _lines(avatar: Avatar) -> Iterator[str]:
    for bone in avatar.bones:
        yield f"{bone.name:32} {bone.joint or '-'}"
    lacking = [joint for joint in JOINTS.values() if joint not in avatar.skeleton.joints]
    yield f"joints: {len(avatar.skeleton.joints)}; missing: {', '.join(lacking) or 'none'}"
    morphs = [morph for morph in avatar.morphs if morph not in SKIN_COLORS]
    yield f"morph targets: {', '.join(morphs) or 'none'}"
