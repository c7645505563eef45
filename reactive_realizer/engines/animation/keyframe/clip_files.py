"""Loads clips from files of any format, for one figure. The suffix of a file says what its format is."""

from functools import lru_cache
from pathlib import Path
from typing import Final

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.engines.animation.keyframe.bvh_reader import read_capture
from reactive_realizer.engines.animation.keyframe.capture import Capture
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.keyframe_files import read_interpolator_file
from reactive_realizer.engines.animation.keyframe.retarget import retargeted
from reactive_realizer.engines.animation.keyframe.skm_reader import read_motion
from reactive_realizer.errors import Fault, RealizerError

_BVH: Final = "bvh"
_SMARTBODY: Final = ("skm", "skmb")
_SKELETON: Final = ".sk"
CAPTURES: Final = (_BVH, *_SMARTBODY)
"""Suffixes of files with the motion of a figure of their own, in order of preference."""
CLIPS: Final = ("xml", *CAPTURES)
"""Suffixes of all files with clips, in order of preference."""
_USUAL_CUTOFF: Final = {_BVH: 20.0}
"""Cutoff frequency of captures with noise, Hz; the thesis recommends 15 to 25 Hz (3.2.2.2)."""


def is_capture(path: Path) -> bool:
    """Return whether a file has the motion of a figure of its own."""
    return _format(path) in CAPTURES


def _format(path: Path) -> str:
    return path.suffix.lower().removeprefix(".")


def load_clip(path: Path, skeleton: Skeleton, cutoff: float | None) -> Clip:
    """Load the motion of a file for one figure; changed files are read again.

    Args:
        path: of a SkeletonInterpolator, a capture in BVH, or a motion of SmartBody.
        skeleton: of the figure.
        cutoff: of the low-pass filter, Hz; 0 does not filter. None is the default of the format: captures in BVH have
            noise, the others have none.

    Raises:
        RealizerError: the file is invalid, or does not fit the figure.
    """
    clip = preload_clip(path, skeleton, cutoff)
    if isinstance(clip, Fault):
        raise RealizerError(clip)
    return clip


def preload_clip(path: Path, skeleton: Skeleton, cutoff: float | None) -> Clip | Fault:
    """Return the result or the fault of `load_clip`, and cache it: reading and filtering a capture may take seconds."""
    own = skeleton_beside(path) if _format(path) in _SMARTBODY else None
    return _read(path, own, tuple(file.stat().st_mtime_ns for file in (path, own) if file), skeleton, cutoff)


@lru_cache(32)
def _read(
    path: Path, own: Path | None, changed: tuple[int, ...], skeleton: Skeleton, cutoff: float | None
) -> Clip | Fault:
    try:
        return _clip(path, own, changed, skeleton, cutoff)
    except RealizerError as problem:
        return problem.fault


def _clip(path: Path, own: Path | None, changed: tuple[int, ...], skeleton: Skeleton, cutoff: float | None) -> Clip:
    clip = retargeted(_capture(path, own, changed), skeleton) if is_capture(path) else read_interpolator_file(path)
    return clip.filtered(_USUAL_CUTOFF.get(_format(path), 0.0) if cutoff is None else cutoff)


@lru_cache(8)
def _capture(path: Path, own: Path | None, changed: tuple[int, ...]) -> Capture:
    """Read a capture once for all figures."""
    return read_motion(path, own) if _format(path) in _SMARTBODY else read_capture(path)


def skeleton_beside(motion: Path) -> Path | None:
    """Return the skeleton that a motion of SmartBody is for; None if none is beside it.

    The motion ``ChrBrad@Wave01.skm`` is for ``ChrBrad.sk``, in its folder, in the one above, or in ``skeletons`` there,
    as in SmartBody's data. Otherwise it is for the only skeleton in its folder or in ``skeletons``.
    """
    above = motion.parent.parent
    found = {folder: sorted(folder.glob(f"*{_SKELETON}")) for folder in (motion.parent, above / "skeletons", above)}
    named = [
        file for files in found.values() for file in files if motion.stem.startswith((f"{file.stem}@", f"{file.stem}_"))
    ]
    if named:
        return max(named, key=lambda file: len(file.stem))
    found.pop(above, None)
    return next((files[0] for files in found.values() if len(files) == 1), None)
