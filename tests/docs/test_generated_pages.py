"""Pages that are generated from the code."""

import runpy

import pytest

from .conftest import DOCS, page


@pytest.mark.parametrize("name", ["support", "errors", "limits"])
def test_a_generated_page_is_up_to_date(name: str) -> None:
    made = runpy.run_path(str(DOCS / f"make_{name}.py"))["page"]()
    assert page(f"docs/{name}.md") == made, "run `make docs`"
