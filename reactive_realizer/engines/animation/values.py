"""What a behavior, or its binding, says for the parameters of a motion."""

from collections.abc import Mapping

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.errors import error
from reactive_realizer.planunit.parameter import Range


def values_of(texts: Mapping[str, str], ranges: Mapping[str, Range]) -> dict[str, float]:
    """The values that are said for some parameters.

    Args:
        texts: name -> what is said, other names among them.
        ranges: name -> the values that it may have.

    Raises:
        RealizerError: "bad-parameter": one is no number, or not within its range.
    """
    found = numbers(texts)
    said = {name: found.get(name, texts[name]) for name in ranges if name in texts}
    check(said, ranges)
    return {name: found[name] for name in said}


def check(values: Mapping[str, float | str], ranges: Mapping[str, Range]) -> None:
    """Whether each value is one that means something.

    Raises:
        RealizerError: "bad-parameter": one does not.
    """
    for name, value in values.items():
        if value not in ranges[name]:
            said = value if isinstance(value, str) else f"{value:g}"
            raise error("bad-parameter", name=name, value=said, low=ranges[name].low, high=ranges[name].high)
