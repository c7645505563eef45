"""Writes the output of a session: feedback as JSON lines, warnings, explanations as JSON; problems of documents."""

import json
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import IO, TextIO

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.bml_block import BMLBlock


class FeedbackWriter:
    """Writes each message as a line of JSON.

    Attributes:
        problem: why messages could not be written; None as long as they can, or if their reader has closed the pipe, as
            ``head`` does.
    """

    problem: OSError | None = None

    def __init__(self, stream: IO[str]) -> None:
        self._stream = stream

    def __call__(self, report: Report) -> None:
        """Write a report."""
        line = {"time": round(report.time, 6), "xml": report.xml}
        try:
            self._stream.write(json.dumps(line, ensure_ascii=False) + "\n")
            self._stream.flush()
        except OSError as problem:
            # The session continues without this output.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())
            if not isinstance(problem, BrokenPipeError):
                self.problem = OSError(f"the feedback cannot be written: {problem.strerror}")


class WarningPrinter:
    """Prints warnings to stderr, those of blocks without an id of their own with the files that contain them."""

    def __init__(self) -> None:
        self._files: dict[str, Path] = {}
        self._unread: list[tuple[Path, str]] = []

    def expect(self, path: Path, document: BmlText) -> None:
        """Expect warnings of a file, from what was read of it."""
        for parsed in document.parsed or ():
            if parsed.written is not None and parsed.written.id.startswith(document.name):
                self._files[parsed.written.id] = path
            self._unread += [(path, str(problem.fault)) for problem in parsed.problems if problem.id == BLOCK]

    def __call__(self, report: Report) -> None:
        """Print a report if it is a warning."""
        if isinstance(warning := report.message, WarningFeedback):
            print(f"{self._name(warning)}: {warning.text}", file=sys.stderr)

    def _name(self, warning: WarningFeedback) -> str:
        """The id of what a warning is about, with the file of a block that has no id."""
        if warning.id == BLOCK:
            return self._take_unread(warning.text)
        path = self._files.get(warning.id.partition(":")[0])
        return warning.id if path is None else f"{path}: {warning.id}"

    def _take_unread(self, text: str) -> str:
        """The file of a block that could not be read; of several with the same warning, the first."""
        found = next((each for each in self._unread if each[1] == text), None)
        if found is None:  # in a replay, whose files are not known
            return BLOCK
        self._unread.remove(found)
        return str(found[0])


class Explainer:
    """Collects the explanations of the times of all sync points."""

    def __init__(self, realizer: Realizer) -> None:
        self._scheduler = realizer.scheduler
        self._blocks: list[dict[str, object]] = []
        self._scheduler.listen(self._keep)

    def write(self, path: Path) -> None:
        """Write one JSON array: the blocks that ended, in order of ending, then the live ones."""
        for block in self._scheduler.blocks.alive:
            self._keep(block)
        path.write_text(json.dumps(self._blocks, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")

    def _keep(self, block: BMLBlock) -> None:
        key, points = self._scheduler.explain(block.key.character, block.key.block)
        self._blocks.append({**key._asdict(), "points": dict(points)})


def complain_of_inputs(paths: Iterable[Path]) -> bool:
    """Print to stderr which of these are folders, and which do not exist; return whether any cannot be read.

    A pipe can be read, as a shell gives it for ``<(program)`` or ``/dev/stdin``.
    """
    paths = tuple(paths)
    folders = [str(path) for path in paths if path.is_dir()]
    missing = [str(path) for path in paths if not path.exists()]
    if folders:
        print(f"a folder, not a file: {', '.join(folders)}", file=sys.stderr)
    if missing:
        print(f"no such file: {', '.join(missing)}", file=sys.stderr)
    return bool(folders or missing)


def print_problems(path: Path, problems: Iterable[Problem], stream: TextIO) -> None:
    """Prints problems in the order of the document."""
    for line, column, sentence in sorted(map(_placed, problems), key=lambda placed: placed[:2]):
        print(f"{path}:{line}:{column}: {sentence}", file=stream)


def _placed(problem: Problem) -> tuple[int, int, str]:
    return problem.fault.line or 1, problem.fault.column or 1, problem.fault.sentence
