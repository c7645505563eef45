"""Yes and no in what people write."""

from reactive_realizer.bml.attribute_types import Boolean
from reactive_realizer.errors import RealizerError, error
from reactive_realizer.limits import Limits


def flag(name: str, text: str) -> bool:
    """Whether a value is yes, in the words of attributes of BML.

    Args:
        name: what has the value, for messages.
        text: the value.

    Raises:
        RealizerError: "not-a-flag": it is neither yes nor no.
    """
    try:
        return Boolean().read(text, Limits())
    except RealizerError as problem:
        raise error("not-a-flag", name=name, value=text) from problem
