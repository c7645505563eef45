"""Writes docs/errors.md from the table of errors."""

from collections.abc import Iterator
from pathlib import Path

from reactive_realizer.errors import ERRORS, ErrorKind

PAGE = Path(__file__).with_name("errors.md")

_HEAD = """\
# Errors

Everything that the realizer refuses, warns of or closes a connection for has a code. This page is made by `make docs`
from the table in `reactive_realizer/errors.py`, the one place where these sentences stand; words in braces are filled
in.

A *warning* is the `type` of a `<warningFeedback>`, *HTTP* the status that answers a request, *close* the code with
which a socket is closed. A row with none of these is told on stderr, in an `error` message of the socket, or as the
reason inside another sentence.

| code | sentence | warning | HTTP | close |
|---|---|---|---|---|
"""


def page() -> str:
    """The page as Markdown."""
    return _HEAD + "\n".join(_rows()) + "\n"


def _rows() -> Iterator[str]:
    for code, kind in ERRORS.items():
        cells = (f"`{code}`", _escaped(kind.sentence), *map(_or_nothing, _shows(kind)))
        yield f"| {' | '.join(cells)} |"


def _shows(kind: ErrorKind) -> tuple[object, ...]:
    return kind.warning, kind.status, kind.close


def _or_nothing(value: object) -> str:
    return "" if value is None else str(value)


def _escaped(sentence: str) -> str:
    """Markdown takes angle brackets for HTML."""
    return sentence.replace("<", "&lt;").replace(">", "&gt;").replace("|", "\\|")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
