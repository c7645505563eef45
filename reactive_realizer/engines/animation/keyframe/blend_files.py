"""Reads files of blends: clips, each at a place in the space of the parameters x, y and z.

A `Motion` has its `file`, its place, `at`, with a number for each parameter, and, if wanted, `times` (s) that
correspond to those of the other motions. With two or three parameters, each `Cell` names the `motions` (ids) at its
three or four corners, as the triangles and tetrahedrons of SmartBody's blends do.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, read_xml
from reactive_realizer.engines.animation.faults import BadKeys
from reactive_realizer.engines.animation.keyframe.blend_space import BlendSpace
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.errors import RealizerError

BLEND: Final = "blend.xml"
"""Suffix of these files."""
AXES: Final = ("x", "y", "z")
"""Names of the parameters."""
_MOST: Final = 50
"""Limit of the number of motions."""
_MOST_CELLS: Final = 200


class BlendFile(NamedTuple):
    """A blend.

    Attributes:
        files: of the motions.
        times: of each motion, that correspond, s from its beginning; None if the sync points correspond.
        space: with the places of the motions.
    """

    files: tuple[str, ...]
    times: tuple[tuple[float, ...], ...] | None
    space: BlendSpace

    def marks(self, clips: Sequence[Clip]) -> list[list[float]] | None:
        """Return the corresponding times of its clips, s of each clip; None if sync points correspond.

        Raises:
            RealizerError: "bad-keys": a time is not within its clip.
        """
        if self.times is None:
            return None
        for clip, own in zip(clips, self.times, strict=True):
            outside = next((time for time in own if not 0.0 < time < clip.duration), None)
            if outside is not None:
                raise RealizerError(BadKeys(animation=clip.name, reason=f"{outside:g} s is not between its ends"))
        return [[clip.times[0] + time for time in own] for clip, own in zip(clips, self.times, strict=True)]


def read_blend(path: Path) -> BlendFile:
    """Read a file.

    Raises:
        RealizerError: "bad-asset", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    root = read_xml(path, "Blend")
    for element in root:
        if element.tag not in ("Motion", "Cell"):
            raise asset_error(element, "known are Motion, Cell")
    motions, cells = root.findall("Motion"), root.findall("Cell")
    if not 1 <= len(motions) <= _MOST or len(cells) > _MOST_CELLS:
        raise asset_error(root, f"it needs 1 to {_MOST} motions, and at most {_MOST_CELLS} cells")
    files = tuple(attribute(motion, "file") for motion in motions)
    return BlendFile(files, _times(motions), _space(root, motions, cells))


def _space(root: XmlElement, motions: Sequence[XmlElement], cells: Sequence[XmlElement]) -> BlendSpace:
    places = [_numbers(motion, "at") for motion in motions]
    size = len(places[0])
    for motion, place in zip(motions, places, strict=True):
        if len(place) != size or size > len(AXES) or (size == 0 and len(motions) > 1):
            raise asset_error(motion, "at needs as many numbers, up to three, as that of the first motion")
    if (size > 1) != bool(cells):
        raise asset_error(root, "cells are needed with two or three parameters, and only then")
    names = {motion.get("id", ""): number for number, motion in enumerate(motions)}
    try:
        return BlendSpace(places, [_corners(cell, names, size + 1) for cell in cells])
    except ValueError as problem:
        raise asset_error(root, str(problem)) from problem


def _corners(cell: XmlElement, names: dict[str, int], count: int) -> list[int]:
    ids = attribute(cell, "motions").split()
    unknown = next((name for name in ids if name not in names), None)
    if unknown is not None:
        raise asset_error(cell, f"there is no motion with the id '{unknown}'")
    if len(ids) != count:
        raise asset_error(cell, f"it needs {count} motions")
    return [names[name] for name in ids]


def _times(motions: Sequence[XmlElement]) -> tuple[tuple[float, ...], ...] | None:
    if not any("times" in motion.attrib for motion in motions):
        return None
    times = [_numbers(motion, "times") for motion in motions]
    for motion, own in zip(motions, times, strict=True):
        if len(own) != len(times[0]) or list(own) != sorted(set(own)) or min(own, default=0.0) < 0.0:
            raise asset_error(motion, "each motion needs as many times as the first one, from 0 on and increasing")
    return tuple(times)


def _numbers(element: XmlElement, name: str) -> tuple[float, ...]:
    text = element.get(name, "")
    try:
        found = tuple(map(float, text.split()))
    except ValueError:
        found = (math.nan,)
    if not all(map(math.isfinite, found)):
        raise asset_error(element, f"{name}='{text}': these are not numbers")
    return found
