"""Pages that are made from the code are as the code is."""

import runpy

import pytest

from .conftest import DOCS, page


@pytest.mark.parametrize("name", ["support", "errors", "limits"])
def test_a_page_that_is_made_from_the_code_is_up_to_date(name: str) -> None:
    made = runpy.run_path(str(DOCS / f"make_{name}.py"))["page"]()
    assert page(f"docs/{name}.md") == made, "run `make docs`"
