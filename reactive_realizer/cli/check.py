"""The command ``check``: reports mistakes in BML files without playing them."""

import argparse
import asyncio
import sys
from pathlib import Path

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.cli.output import complain_of_inputs, print_problems
from reactive_realizer.cli.scene_options import add_file_options
from reactive_realizer.realizer.document_checker import Findings
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``check``."""
    parser.description = (
        "Reports mistakes in BML files. Valid BML that this scene cannot play, such as a lexeme without an entry in a "
        "binding, is reported on stderr."
    )
    parser.epilog = "example: reactive-realizer check hello.xml"
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    add_file_options(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if there are mistakes, 2 if a file does not exist."""
    if complain_of_inputs([*options.files, options.human]):
        return 2
    return 1 if asyncio.run(_check(options)) else 0


async def _check(options: argparse.Namespace) -> bool:
    """Prints the findings; returns whether there are mistakes."""
    wrong = False
    async with open_scene(SceneOptions(options.human, "text", tuple(options.assets))) as scene:
        check = _Check(scene.realizer)
        for path in options.files:
            found = await check.findings(path.read_bytes())
            print_problems(path, found.mistakes, sys.stdout)
            print_problems(path, found.notes, sys.stderr)
            wrong = wrong or bool(found.mistakes)
    return wrong


class _Check:
    """Checks documents as if their blocks were to enter one after another."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._checker = realizer.checker()
        self._procedures: dict[str, int] = {}

    async def findings(self, text: bytes) -> Findings:
        """The findings in a document."""
        admission = self._realizer.scheduler.admission(self._procedures)
        found = Findings([], [])
        document = self._realizer.read(BmlText(text)).parsed or ()
        self._checker.begin(document)
        for parsed in document:
            mistakes, notes = await self._checker.check(parsed, admission.refusal(parsed))
            found.mistakes.extend(mistakes)
            found.notes.extend(notes)
            if parsed.procedure is not None:
                self._procedures[parsed.procedure.id] = len(parsed.procedure.behaviors)
        return found
