"""``lexicon``: the words that play, and what is known of each."""

import argparse
import asyncio
import json
import math
import sys
from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.engine.lexicon import Changeable, LexiconEntry, words_of


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The options of ``lexicon``."""
    parser = commands.add_parser(
        "lexicon",
        help="list the words that play, with their sync points and parameters",
        description="Lists the words that the characters of a scene have a motion or a face for. What stands in a "
        "binding and does not play is told on stderr.",
        epilog="example: reactive-realizer lexicon --assets my_assets",
    )
    parser.add_argument("--human", type=Path, default=DEFAULT_HUMAN, metavar="FILE", help="who is there")
    parser.add_argument("--assets", type=Path, action="append", default=[], metavar="DIR", help="folder of assets")
    parser.add_argument("--json", action="store_true", help="everything as one JSON object, a list for each character")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 0, also where some words do not play."""
    lexicons = asyncio.run(_lexicons(SceneOptions(options.human, "text", tuple(options.assets))))
    if options.json:
        print(json.dumps({character: [_record(word) for word in words] for character, words in lexicons.items()}))
        return 0
    for character, words in lexicons.items():
        print("\n".join(_lines(character, [word for word in words if word.problem is None])))
        for word in words:
            if word.problem is not None:
                print(f"{character}: {word.element} {_asked(word)}: {word.problem}", file=sys.stderr)
    return 0


async def _lexicons(options: SceneOptions) -> dict[str, list[LexiconEntry]]:
    async with open_scene(options) as scene:
        return {id_: words_of(character.engines) for id_, character in scene.realizer.characters.items()}


def _lines(character: str, words: Iterable[LexiconEntry]) -> Iterable[str]:
    yield f"{character}:"
    by_element = sorted(words, key=lambda word: word.element)
    for element, group in groupby(by_element, key=lambda word: word.element):
        yield f"  {element}"
        yield from (f"    {_line(word)}" for word in group)


def _line(word: LexiconEntry) -> str:
    duration = "" if word.duration is None else f"{word.duration:.2f} s"
    columns = (f"{_asked(word):40}", f"{duration:>7}", " ".join(word.sync_points), _told(word.parameters), word.file)
    return "  ".join(filter(None, columns)).rstrip()


def _asked(word: LexiconEntry) -> str:
    asked = filter(None, [word.lexeme, *(f"{name}={value}" for name, value in word.constraints.items())])
    return " ".join(asked) or "-"


def _told(parameters: Mapping[str, Changeable]) -> str:
    return ", ".join(f"{name}={own.default:g}{_range(own)}" for name, own in parameters.items())


def _range(parameter: Changeable) -> str:
    low, high = parameter.range
    return f" ({low:g} to {high:g})" if math.isfinite(low) or math.isfinite(high) else ""


def _record(word: LexiconEntry) -> dict[str, object]:
    parameters = [
        {"name": name, "default": own.default, "low": _finite(own.range.low), "high": _finite(own.range.high)}
        for name, own in word.parameters.items()
    ]
    return {
        "element": word.element,
        "lexeme": word.lexeme,
        "constraints": dict(word.constraints),
        "syncPoints": word.sync_points,
        "duration": word.duration,
        "parameters": parameters,
        "file": word.file,
        "problem": word.problem,
    }


def _finite(bound: float) -> float | None:
    return bound if math.isfinite(bound) else None
