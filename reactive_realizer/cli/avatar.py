"""The command ``avatar``: says what the realizer finds in an avatar file."""

import argparse
import json
from collections.abc import Iterable, Iterator
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.binding.viseme_binding import standard_binding
from reactive_realizer.embodiment.avatar import SKIN_COLORS, Avatar
from reactive_realizer.embodiment.face_map import STAND_INS, FaceMap, StandIns
from reactive_realizer.embodiment.face_names import ARKIT, OCULUS, VRM
from reactive_realizer.embodiment.glb import BadAvatar
from reactive_realizer.embodiment.mixamo import JOINTS
from reactive_realizer.errors import RealizerError

_VOCABULARIES = (("ARKit", ARKIT), ("Oculus", OCULUS), ("VRM", VRM))


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``avatar``."""
    parser.description = "Says which joints and which face an avatar has, what it lacks, and what stands in for that."
    parser.epilog = "example: reactive-realizer avatar my_assets/avatars/anna.vrm --write anna.toml"
    parser.add_argument("file", type=Path, metavar="FILE", help="a GLB or VRM file")
    parser.add_argument("--write", type=Path, metavar="HUMAN.toml", help="write a human file with this avatar")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status. If the file cannot be used, an error is raised."""
    if not options.file.exists():
        raise RealizerError(BadAvatar(file=options.file.name, reason=f"there is no file {options.file}"))
    avatar = Avatar.read(options.file)
    face = FaceMap(avatar, StandIns.read(PACKAGE_ASSETS / STAND_INS))
    print("\n".join((*_body(avatar), *_face(avatar, face), *(f"note: {note}" for note in avatar.notes))))
    if options.write:
        name = json.dumps(f"avatars/{options.file.name}", ensure_ascii=False)
        options.write.write_text(f"[character.alice]\navatar = {name}\n", encoding="utf-8")
    return 0


def _body(avatar: Avatar) -> Iterator[str]:
    for bone in avatar.bones:
        yield f"{bone.name:32} {bone.joint or '-'}"
    lacking = [joint for joint in JOINTS.values() if joint not in avatar.skeleton.joints]
    yield f"joints: {len(avatar.skeleton.joints)}; missing: {_listed(lacking)}"


def _face(avatar: Avatar, face: FaceMap) -> Iterator[str]:
    yield f"morph targets: {_listed(morph for morph in avatar.morphs if morph not in SKIN_COLORS)}"
    yield f"expressions of the file: {_listed(avatar.targets.expressions)}"
    for vocabulary, names in _VOCABULARIES:
        lacking = [name for name in names if name not in face.own]
        missing = f"; missing: {_listed(lacking)}" if len(lacking) < len(names) else ""
        yield f"{vocabulary}: {len(names) - len(lacking)} of {len(names)}{missing}"
    yield f"lip-sync: {standard_binding(face.own)}"
    for shape, weights in face.stand_ins.items():
        yield f"stand-in: {shape} = {' '.join(f'{weight:+g} {name}' for name, weight in weights.items())}"


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names) or "none"
