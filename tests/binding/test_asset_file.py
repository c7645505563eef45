"""Reading asset files: the size limit, and boolean values."""

import os
from pathlib import Path

import pytest

from reactive_realizer.binding.asset_file import LARGEST, parse_boolean, read_bytes
from reactive_realizer.errors import RealizerError


def test_a_file_at_the_size_limit_is_read_and_a_larger_one_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "some.xml"
    path.touch()
    os.truncate(path, LARGEST)
    assert len(read_bytes(path)) == LARGEST
    os.truncate(path, LARGEST + 1)
    with pytest.raises(RealizerError, match=f"some.xml is {LARGEST + 1} bytes; the limit is {LARGEST}"):
        read_bytes(path)


@pytest.mark.parametrize(
    ("text", "value"), [("true", True), (" TRUE ", True), ("1", True), ("false", False), ("0", False)]
)
def test_booleans_are_spelled_as_in_bml(text: str, value: bool) -> None:
    assert parse_boolean("mirror", text) is value


@pytest.mark.parametrize("text", ["", "yes", "maybe", "2"])
def test_other_boolean_values_are_refused_by_name(text: str) -> None:
    with pytest.raises(RealizerError, match=f"mirror='{text}' must be true or false"):
        parse_boolean("mirror", text)
