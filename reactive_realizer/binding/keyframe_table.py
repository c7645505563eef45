"""Reads what all keyframe animations have in common: rows of numbers with times, and sync points among them."""

from itertools import pairwise

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from reactive_realizer.binding.asset_file import ENDS, XmlElement, asset_error, by_sync_id, is_placed, number
from reactive_realizer.limits import Limits

_POINT = "KeyPosition"
_LONGEST = Limits().time_seconds
_LARGEST = 1e100
"""Squares of larger numbers would overflow."""


def inline_element(text: str, name: str) -> XmlElement:
    """Return the element of an animation that was part of a BML block.

    Args:
        text: of the element.
        name: for messages.
    """
    element = etree.fromstring(text, base_url=name)
    for part in element.iter("*"):  # elements without a namespace of their own have that of BML
        part.tag = etree.QName(part).localname
    return element


def number_rows(element: XmlElement, width: int) -> NDArray[np.float64]:
    """Return the numbers in an element as rows, (R, width), at least one.

    Raises:
        RealizerError: "bad-asset": the text has other content, or they do not form rows.
    """
    texts = [element.text, *(child.tail for child in element)]
    try:
        numbers = np.array(" ".join(filter(None, texts)).split(), dtype=np.float64)
    except ValueError as problem:
        raise asset_error(element, str(problem)) from problem
    if not numbers.size or numbers.size % width:
        raise asset_error(element, f"{numbers.size} numbers do not form rows of {width}")
    rows = numbers.reshape(-1, width)
    beyond = np.argwhere(~(np.abs(rows) <= _LARGEST))
    if beyond.size:
        raise asset_error(element, f"a number in row {beyond[0][0] + 1} is beyond {_LARGEST:g}, or undefined")
    return rows


def increasing_times(element: XmlElement, times: NDArray[np.float64]) -> tuple[float, ...]:
    """Return the times of rows, s.

    Raises:
        RealizerError: "bad-asset": there are fewer than two, they do not increase, or the animation would be too long.
    """
    found = tuple(times.tolist())
    if len(found) < 2:
        raise asset_error(element, "a motion needs two rows")
    if any(b <= a for a, b in pairwise(found)):
        raise asset_error(element, "the times of the rows do not increase")
    if found[-1] - found[0] > _LONGEST:
        raise asset_error(element, f"it would last longer than {_LONGEST:g} s")
    return found


def key_points(element: XmlElement, first: float, last: float) -> dict[str, tuple[float, XmlElement]]:
    """Return the KeyPosition elements inside an animation: sync id -> time, s, and element; not start and end.

    Args:
        element: of the animation.
        first: time of its first row, s.
        last: time of its last row, s.

    Raises:
        RealizerError: "bad-asset": one is invalid, or another element is inside.
    """
    points: dict[str, tuple[float, XmlElement]] = {}
    for child in element:
        if child.tag != _POINT:
            raise asset_error(child, f"only {_POINT} is allowed in {element.tag}")
    for sync, child in by_sync_id(element).items():
        time = number(child, "time")
        if not is_placed(sync, (time - first) / (last - first)):
            raise asset_error(
                child, f"{sync} at {time:g} s: it lasts from its start at {first:g} s to its end at {last:g} s"
            )
        if sync not in ENDS:
            points[sync] = (time, child)
    return points
