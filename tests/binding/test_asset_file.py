"""How much of a file is read."""

import os

import pytest

from reactive_realizer.binding.asset_file import LARGEST, read_bytes
from reactive_realizer.errors import RealizerError


def test_a_file_is_read_up_to_the_limit_and_not_a_byte_beyond(tmp_path):
    path = tmp_path / "some.xml"
    path.touch()
    os.truncate(path, LARGEST)
    assert len(read_bytes(path)) == LARGEST
    os.truncate(path, LARGEST + 1)
    with pytest.raises(RealizerError, match=f"some.xml has {LARGEST + 1} bytes, the limit is {LARGEST}"):
        read_bytes(path)
