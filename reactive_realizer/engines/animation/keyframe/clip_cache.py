"""Clips read once."""

from functools import lru_cache
from pathlib import Path

from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.capture_reader import read_capture
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.retarget import retargeted
from reactive_realizer.engines.animation.keyframe.skeleton_interpolator import read_interpolator_file
from reactive_realizer.errors import Fault, RealizerError

_CAPTURE_CUTOFF = 20.0
"""Hz; of 15 to 25 Hz the thesis says that they work well (3.2.2.2)."""


def clip_in(path: Path, skeleton: Skeleton, cutoff: float | None) -> Clip:
    """The motion in a file, for one figure; a file that was saved anew is read anew.

    Args:
        path: of a SkeletonInterpolator, or of a capture in BVH.
        skeleton: of the figure.
        cutoff: what is faster is filtered out, Hz; 0 filters nothing, None leaves it to the kind of the file: captures
            have noise, what somebody has keyed has none.

    Raises:
        RealizerError: it cannot be read, or does not fit the figure.
    """
    clip = read_ahead(path, skeleton, cutoff)
    if isinstance(clip, Fault):
        raise RealizerError(clip)
    return clip


def read_ahead(path: Path, skeleton: Skeleton, cutoff: float | None) -> Clip | Fault:
    """What `clip_in` will find, or what it will raise: to read and to filter a capture may take seconds."""
    return _read(path, path.stat().st_mtime_ns, skeleton, cutoff)


@lru_cache(32)
def _read(path: Path, changed: int, skeleton: Skeleton, cutoff: float | None) -> Clip | Fault:
    try:
        return _clip(path, changed, skeleton, cutoff)
    except RealizerError as problem:
        return problem.fault


def _clip(path: Path, changed: int, skeleton: Skeleton, cutoff: float | None) -> Clip:
    captured = path.suffix.lower() == ".bvh"
    clip = retargeted(_capture(path, changed), skeleton) if captured else read_interpolator_file(path)
    usual = _CAPTURE_CUTOFF if captured else 0.0
    return clip.filtered(usual if cutoff is None else cutoff)


@lru_cache(8)
def _capture(path: Path, changed: int) -> Capture:
    """The same for all figures."""
    return read_capture(path)
