"""Yes and no in what people write."""

import pytest

from reactive_realizer.binding.flag import flag
from reactive_realizer.errors import RealizerError


@pytest.mark.parametrize(
    ("text", "yes"), [("true", True), (" TRUE ", True), ("1", True), ("false", False), ("0", False)]
)
def test_yes_and_no_are_said_as_in_bml(text, yes):
    assert flag("mirror", text) is yes


@pytest.mark.parametrize("text", ["", "yes", "maybe", "2"])
def test_what_is_neither_is_refused_by_its_name(text):
    with pytest.raises(RealizerError, match=f"mirror='{text}' is neither true nor false"):
        flag("mirror", text)
