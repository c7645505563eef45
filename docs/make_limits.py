"""Writes docs/limits.md from the limits and their docstrings."""

import ast
import inspect
from collections.abc import Mapping
from dataclasses import fields
from itertools import pairwise
from pathlib import Path

from reactive_realizer.limits import Limits

PAGE = Path(__file__).with_name("limits.md")

_HEAD = """\
# Limits

The realizer limits all input. Set these limits in the section `[limits]` of the [human file](human.md). Input that
exceeds a limit is rejected with [an error](errors.md) that names the limit; of stored history, the oldest is dropped.
 `make docs` generates this page from `reactive_realizer/limits.py`.

| key | default | meaning |
|---|---|---|
"""


def page() -> str:
    """The page as Markdown."""
    meanings = _meanings()
    rows = (f"| `{each.name}` | {each.default:,} | {meanings.get(each.name, '')} |\n" for each in fields(Limits))
    return _HEAD + "".join(rows)


def _meanings() -> Mapping[str, str]:
    """The docstring of each field."""
    (body,) = (node.body for node in ast.parse(inspect.getsource(Limits)).body if isinstance(node, ast.ClassDef))
    return {
        before.target.id: str(after.value.value)
        for before, after in pairwise(body)
        if isinstance(before, ast.AnnAssign) and isinstance(before.target, ast.Name)
        if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
    }


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
