"""Reads attributes of a speech: whether its words are sync points, and how lively its character is meanwhile."""

from reactive_realizer.binding.asset_file import parse_boolean
from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.speech import FILLER, LIVELINESS, RIGID, WORDS
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.planunit.parameter import Range

LIVELINESS_RANGE = Range(0.0, 1.0)


class BadLiveliness(CreationFault):
    """A liveliness of a speech that is not a number from 0 to 1."""

    code = "bad-liveliness"
    template = "its liveliness must be a number from {low:g} to {high:g}, not '{value}'"
    value: str
    low: float
    high: float


def wants_words(behavior: Behavior) -> bool:
    """Whether the words of a speech are sync points.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(WORDS[1], behavior.extensions.get(WORDS, "false"))


def holds_floor(behavior: Behavior) -> bool:
    """Whether the character says fillers after a speech, until its next words arrive.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(FILLER[1], behavior.extensions.get(FILLER, "false"))


def is_rigid(behavior: Behavior) -> bool:
    """Whether a speech is never stretched.

    Raises:
        RealizerError: "not-a-flag".
    """
    return parse_boolean(RIGID[1], behavior.extensions.get(RIGID, "false"))


def liveliness_of(behavior: Behavior, default: float | None) -> float | None:
    """How lively a speech is to be, 0 to 1: as it says itself, or else a default.

    Raises:
        RealizerError: "bad-liveliness".
    """
    if (text := behavior.extensions.get(LIVELINESS)) is None:
        return default
    low, high = LIVELINESS_RANGE
    try:
        return Float(low, high).read(text, Limits())
    except RealizerError as problem:
        raise RealizerError(BadLiveliness(value=text, low=low, high=high)) from problem
