"""Files for the command line."""

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def bml(tmp_path: Path) -> Callable[..., str]:
    def write(text: str, name: str = "a.xml") -> str:
        (tmp_path / name).write_text(text)
        return str(tmp_path / name)

    return write
