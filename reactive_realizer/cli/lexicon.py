"""The command ``lexicon``: lists the available lexemes."""

import argparse
import asyncio
import json
import math
import sys
from collections.abc import Iterable, Mapping
from itertools import groupby

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.cli.scene_options import add_file_options
from reactive_realizer.engine.lexicon import Changeable, LexiconEntry, lexicon_of


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``lexicon``."""
    parser.description = (
        "Lists the lexemes for which the characters of a scene have a motion or a facial expression. Lexemes that are "
        "in a binding but cannot be played are listed on stderr."
    )
    parser.epilog = "example: reactive-realizer lexicon --assets my_assets"
    add_file_options(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object with a list for each character")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 0, even if some lexemes cannot be played."""
    lexicons = asyncio.run(_lexicons(SceneOptions(options.human, "text", tuple(options.assets))))
    if options.json:
        print(json.dumps({character: [_record(entry) for entry in entries] for character, entries in lexicons.items()}))
        return 0
    for character, entries in lexicons.items():
        print("\n".join(_lines(character, [entry for entry in entries if entry.problem is None])))
        for entry in entries:
            if entry.problem is not None:
                print(f"{character}: {entry.element} {_required(entry)}: {entry.problem}", file=sys.stderr)
    return 0


async def _lexicons(options: SceneOptions) -> dict[str, list[LexiconEntry]]:
    async with open_scene(options) as scene:
        return {id_: lexicon_of(character.engines) for id_, character in scene.realizer.characters.items()}


def _lines(character: str, entries: Iterable[LexiconEntry]) -> Iterable[str]:
    yield f"{character}:"
    by_element = sorted(entries, key=lambda entry: entry.element)
    for element, group in groupby(by_element, key=lambda entry: entry.element):
        yield f"  {element}"
        yield from (f"    {_line(entry)}" for entry in group)


def _line(entry: LexiconEntry) -> str:
    duration = "" if entry.duration is None else f"{entry.duration:.2f} s"
    columns = (
        f"{_required(entry):40}",
        f"{duration:>7}",
        " ".join(entry.sync_points),
        _parameters(entry.parameters),
        entry.file,
    )
    return "  ".join(filter(None, columns)).rstrip()


def _required(entry: LexiconEntry) -> str:
    required = filter(None, [entry.lexeme, *(f"{name}={value}" for name, value in entry.constraints.items())])
    return " ".join(required) or "-"


def _parameters(parameters: Mapping[str, Changeable]) -> str:
    return ", ".join(f"{name}={own.default:g}{_range(own)}" for name, own in parameters.items())


def _range(parameter: Changeable) -> str:
    low, high = parameter.range
    return f" ({low:g} to {high:g})" if math.isfinite(low) or math.isfinite(high) else ""


def _record(entry: LexiconEntry) -> dict[str, object]:
    parameters = [
        {"name": name, "default": own.default, "low": _finite(own.range.low), "high": _finite(own.range.high)}
        for name, own in entry.parameters.items()
    ]
    return {
        "element": entry.element,
        "lexeme": entry.lexeme,
        "constraints": dict(entry.constraints),
        "syncPoints": entry.sync_points,
        "duration": entry.duration,
        "parameters": parameters,
        "file": entry.file,
        "problem": entry.problem,
    }


def _finite(bound: float) -> float | None:
    return bound if math.isfinite(bound) else None
