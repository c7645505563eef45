"""Reads AsapRealizer's keyframe animations: a SkeletonInterpolator, in a file or inside of BML.

More general here: `<KeyPosition id="catch" time="0.8"/>` elements inside name times of the file, s, as sync points;
with `leave="true"`, as points where the motion may well be left.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
from lxml import etree

from reactive_realizer.binding.sync_id import ENDS, by_sync_id, is_placed
from reactive_realizer.binding.xml_file import Element, bad, boolean, number, read_xml
from reactive_realizer.embodiment.pose import FARTHEST
from reactive_realizer.engines.animation.keyframe.clip import Clip, KeyPoint, continuous
from reactive_realizer.engines.animation.keyframe.pose_table import read_pose_table
from reactive_realizer.limits import Limits

_TAG = "SkeletonInterpolator"
_POINT = "KeyPosition"
_LONGEST = Limits().time_seconds


def read_interpolator_file(path: Path) -> Clip:
    """The animation in a file.

    Raises:
        RealizerError: "bad-asset", with file, line and what is wrong; or the file is too big.
        OSError: the file cannot be read.
    """
    return read_interpolator(read_xml(path, _TAG))


def read_interpolator_text(text: str, name: str) -> Clip:
    """The animation in XML that has been read as part of BML.

    Args:
        text: of the element.
        name: for messages.

    Raises:
        RealizerError: "bad-asset", with the name, the line in the text and what is wrong.
    """
    element = etree.fromstring(text, base_url=name)
    for part in element.iter("*"):  # without a namespace of their own they stand in that of BML
        part.tag = etree.QName(part).localname
    return read_interpolator(element)


def read_interpolator(element: Element) -> Clip:
    """The animation of an element.

    A place of the root is that of another body: it is taken as the way from its first row.

    Raises:
        RealizerError: "bad-asset", with file, line and what is wrong.
    """
    table = read_pose_table(element, timed=True)
    times = tuple(table.times.tolist())
    if len(times) < 2:
        raise bad(element, "a motion needs two rows")
    if any(b <= a for a, b in pairwise(times)):
        raise bad(element, "the times of the rows do not rise")
    if times[-1] - times[0] > _LONGEST:
        raise bad(element, f"it would last longer than {_LONGEST:g} s")
    roots = None if table.roots is None else table.roots - table.roots[0]
    if roots is not None and not (np.linalg.norm(roots, axis=-1) <= FARTHEST).all():
        raise bad(element, f"it goes further than {FARTHEST:g} m")
    points = _points(element, times[0], times[-1])
    name = Path(element.base or "").name
    return Clip(name, times, table.joints, continuous(table.rotations), roots, points)


def _points(element: Element, first: float, last: float) -> dict[str, KeyPoint]:
    points: dict[str, KeyPoint] = {}
    for child in element:
        if child.tag != _POINT:
            raise bad(child, f"only {_POINT} may stand in {_TAG}")
    for sync, child in by_sync_id(element).items():
        time = number(child, "time")
        if not is_placed(sync, (time - first) / (last - first)):
            raise bad(child, f"{sync} at {time:g} s: it lasts from its start at {first:g} s to its end at {last:g} s")
        if sync not in ENDS:
            points[sync] = KeyPoint(time, leave=boolean(child, "leave", False))
    return points
