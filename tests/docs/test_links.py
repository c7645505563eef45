"""The links between the pages lead to existing files and headings."""

import re
from pathlib import Path

import pytest

from .conftest import DOCS, REPOSITORY

PAGES = [*REPOSITORY.glob("*.md"), *REPOSITORY.glob("docs/*.md")]
LINK = re.compile(r"\]\(([^)\s]+)\)")


def anchors(path: Path) -> set[str]:
    """The anchors that a reader of Markdown gives to headings."""
    headings = re.findall(r"^#+ (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in headings}


def test_every_link_leads_to_an_existing_file_and_heading(subtests: pytest.Subtests) -> None:
    for path in PAGES:
        with subtests.test(path.name):
            for link in LINK.findall(path.read_text(encoding="utf-8")):
                if link.startswith("http"):
                    continue
                file, _, anchor = link.partition("#")
                target = path.parent / file if file else path
                assert target.exists(), link
                assert not anchor or anchor in anchors(target), link


def test_the_readme_links_to_every_page(subtests: pytest.Subtests) -> None:
    for path in [path for path in PAGES if path.parent == DOCS]:
        with subtests.test(path.name):
            assert f"(docs/{path.name})" in (REPOSITORY / "README.md").read_text(encoding="utf-8")
