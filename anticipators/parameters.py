"""What an anticipator may be told."""

from reactive_realizer.errors import error


def within(name: str, value: float | None, low: float, high: float) -> float:
    """A parameter or the value of an event, if it is in its range, bounds included.

    Raises:
        RealizerError: "bad-number": it is not, or there is none.
    """
    if value is None or not low <= value <= high:
        raise error("bad-number", name=name, value="nothing" if value is None else f"{value:g}", low=low, high=high)
    return value
