"""Checks of the parameters and events of anticipators."""

from reactive_realizer.errors import Fault, RealizerError


class BadNumber(Fault):
    """A number outside of its range, or missing."""

    code = "bad-number"
    template = "{name}={value} is not between {low:g} and {high:g}"
    name: str
    value: str
    low: float
    high: float


def within(name: str, value: float | None, low: float, high: float) -> float:
    """A parameter or the value of an event, which has to be in its range, bounds included.

    Raises:
        RealizerError: "bad-number": it is out of range, or missing.
    """
    if value is None or not low <= value <= high:
        raise RealizerError(
            BadNumber(name=name, value="nothing" if value is None else f"{value:g}", low=low, high=high)
        )
    return value
