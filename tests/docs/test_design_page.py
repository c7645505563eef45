"""docs/design.md: its program runs, and the files that it names exist."""

import re
import subprocess
import sys

import pytest

from .conftest import REPOSITORY, fences, page

DESIGN = page("docs/design.md")
PACKAGE = REPOSITORY / "reactive_realizer"


def test_the_program_on_the_page_prints_the_time_on_the_page() -> None:
    (program,) = fences("docs/design.md", "python")
    printed = subprocess.run([sys.executable, "-c", program.text], capture_output=True, text=True, check=True).stdout
    assert f"It prints {printed.strip()}." in DESIGN


NAMED_FILES = sorted(set(re.findall(r"`([a-z_]+/(?:[a-z_]+\.py)?|[a-z]+\.py)`", DESIGN)))


def test_the_files_on_the_page_exist(subtests: pytest.Subtests) -> None:
    for path in NAMED_FILES:
        with subtests.test(path):
            assert (PACKAGE / path).exists() or (REPOSITORY / path).exists()


def test_the_page_lists_every_package() -> None:
    rooms = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert {room for room in rooms if f"{room}/" not in DESIGN} == set()
