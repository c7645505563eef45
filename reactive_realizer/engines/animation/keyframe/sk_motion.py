"""Motions of SmartBody without their skeleton, whatever the format of their file is (sk_channel of SmartBody)."""

import logging
from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

from reactive_realizer.engines.animation.keyframe.capture import Array

_log = logging.getLogger(__name__)

PLACES: Final = ("xpos", "ypos", "zpos")
"""Kinds of channels with a part of a position."""
ANGLES: Final = ("xrot", "yrot", "zrot")
"""Kinds of channels with an angle about an axis, degrees: the joint turns about y, then about x, and then about z."""
QUAT: Final = "quat"
"""Kind of a channel with a rotation: axis times angle, rad."""
KINDS: Final = (*PLACES, *ANGLES, QUAT)
UNPLAYED: Final = ("swing", "twist")
"""Kinds that SmartBody itself does not play."""
_ROUNDED: Final = 0.05
"""Time by which a sync point may be outside of its motion because it was rounded, s."""
ONE_POSE: Final = 1.0 / 30.0
"""Duration of a motion of one frame, s."""


class SkMotion(NamedTuple):
    """A motion without a skeleton.

    Attributes:
        channels: name of the joint and kind, in lower case, in the order of the values.
        times: of the frames, s, (F,).
        values: of all channels in each frame, (F, C).
        points: sync id -> time, s.
        meters: whether the file says that its lengths are in meters.
    """

    channels: tuple[tuple[str, str], ...]
    times: Array
    values: Array
    points: Mapping[str, float]
    meters: bool


def width(kind: str) -> int:
    """Return the number of values of a kind of channel."""
    return 3 if kind == QUAT else 1


def add_point(points: dict[str, float], sync: str, time: float, times: Sequence[float], place: str) -> None:
    """Add a sync point to those of a motion, unless it is outside.

    Args:
        points: sync id of BML -> time, s.
        sync: id of the point.
        time: of the point, s; below 0 if it is not set.
        times: of the frames, s.
        place: where it is written, for the log.
    """
    first, last = times[0], times[-1]
    if first - _ROUNDED <= time <= last + _ROUNDED:
        points[sync] = min(max(time, first), last)
    elif time >= 0.0:
        _log.warning("%s: %s at %g s is outside of the motion", place, sync, time)


def completed(points: Mapping[str, float], times: Sequence[float]) -> dict[str, float]:
    """Return sync points with those that are missing, at the times of others, because every motion has all of them."""
    ready, relax = points.get("ready", times[0]), points.get("relax", times[-1])
    stroke_start = points.get("strokeStart", ready)
    missing = {
        "ready": ready,
        "strokeStart": stroke_start,
        "stroke": points.get("stroke", stroke_start),
        "strokeEnd": relax,
        "relax": relax,
    }
    return {**missing, **points}
