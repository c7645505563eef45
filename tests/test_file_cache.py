"""Files are read again only when they have changed."""

import os
from pathlib import Path

import pytest

from reactive_realizer.file_cache import remembered


@remembered
def words(*paths: Path) -> list[str]:
    return [word for path in paths for word in path.read_text().split()]


@remembered
def parts(path: Path, separator: str) -> list[str]:
    return path.read_text().split(separator)


def test_what_has_not_changed_is_shared(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    one.write_text("a b")
    other.write_text("c")
    assert words(one, other) == ["a", "b", "c"]
    assert words(one, other) is words(one, other)
    assert words(other, one) == ["c", "a", "b"]


def test_other_arguments_are_taken_into_account(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("a,b;c")
    assert parts(file, ",") == ["a", "b;c"]
    assert parts(file, ";") == ["a,b", "c"]
    assert parts(file, ";") is parts(file, ";")


@pytest.mark.parametrize(("text", "later"), [("longer", 0), ("new", 1)])
def test_a_file_that_has_changed_is_read_again(tmp_path: Path, text: str, later: int) -> None:
    file = tmp_path / "file"
    file.write_text("old")
    read = words(file)
    before = file.stat().st_mtime_ns
    file.write_text(text)
    os.utime(file, ns=(before + later, before + later))
    assert words(file) == [text] != read


def test_a_failure_is_not_remembered(tmp_path: Path) -> None:
    file = tmp_path / "file"
    with pytest.raises(FileNotFoundError):
        words(file)
    file.write_text("there")
    assert words(file) == ["there"]
