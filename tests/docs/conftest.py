"""The pages, and what stands in them as code."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
EXAMPLES = REPOSITORY / "examples"

_FENCE = re.compile(
    r"(?:^<!-- (?P<note>[^>\n]*) -->\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)


@dataclass(frozen=True, slots=True)
class Fence:
    """A fenced block of a page.

    Attributes:
        line: of the page, from 1, where it begins.
        note: the comment right above it, which readers do not see.
    """

    page: str
    line: int
    language: str
    note: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}"


def page(name: str) -> str:
    """The text of a page by its path in the repository."""
    return (REPOSITORY / name).read_text(encoding="utf-8")


def fences(name: str, language: str) -> list[Fence]:
    """The fenced blocks of a language on a page, in order."""
    return [fence for fence in _fences(name) if fence.language == language]


def _fences(name: str) -> Iterator[Fence]:
    text = page(name)
    for found in _FENCE.finditer(text):
        line = text.count("\n", 0, found.start("language")) + 1
        yield Fence(name, line, found["language"], found["note"] or "", found["text"])
