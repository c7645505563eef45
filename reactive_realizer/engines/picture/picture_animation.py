"""Sequences of pictures: from files in AsapRealizer's format xmlanim, and from folders."""

from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from reactive_realizer.binding.asset_file import (
    XmlElement,
    asset_error,
    attribute,
    by_sync_id,
    is_placed,
    number,
    read_xml,
)
from reactive_realizer.embodiment.picture import PICTURE_SUFFIXES, is_picture
from reactive_realizer.errors import CreationFault, RealizerError
from reactive_realizer.file_cache import remembered

_TAG = "xmlanim"
_FRAME, _SYNC = "frame", "sync"

_USUAL = 1.0
"""Duration of a picture, and of the pictures of a folder, s; the latter as in AsapRealizer."""

_MOST_FRAMES = 1000
"""Limit of the pictures of a sequence."""


_LONGEST = 3600.0
"""Limit of the duration of a sequence, s."""


class NotAPicture(CreationFault):
    """A file that browsers do not show as a picture."""

    code = "not-a-picture"
    template = "'{file}' is not a picture; their names end in {known}"
    file: str
    known: tuple[str, ...] = PICTURE_SUFFIXES


class NoPictures(CreationFault):
    """A folder without pictures."""

    code = "no-pictures"
    template = "there are no pictures in the folder '{folder}'"
    folder: str


class TooManyPictures(CreationFault):
    """A sequence with more pictures than the limit allows."""

    code = "too-many-pictures"
    template = "'{name}' has more than {limit} pictures"
    name: str
    limit: int = _MOST_FRAMES


@dataclass(frozen=True, slots=True)
class PictureAnimation:
    """A sequence of pictures.

    Attributes:
        files: names among the assets, in order; one or more.
        ends: when each one ends, s from the start, increasing.
        points: sync id -> time, s, in the order of time; from start to end.
    """

    files: tuple[str, ...]
    ends: tuple[float, ...]
    points: Mapping[str, float]

    @property
    def duration(self) -> float:
        """Of the whole sequence, s."""
        return self.ends[-1]

    @property
    def phases(self) -> dict[str, float]:
        """The phase of each sync point, 0 to 1."""
        return {sync: time / self.duration for sync, time in self.points.items()}

    def file(self, phase: float) -> str:
        """The picture at a phase, 0 to 1."""
        return self.files[min(bisect_right(self.ends, phase * self.duration), len(self.files) - 1)]


def still(file: str) -> PictureAnimation:
    """A single picture."""
    return PictureAnimation((file,), (_USUAL,), {"start": 0.0, "end": _USUAL})


def read_folder(name: str, files: Sequence[str]) -> PictureAnimation:
    """The pictures of a folder, in the order of their names, each for the same time.

    Args:
        name: of the folder among the assets.
        files: names of all files in it.

    Raises:
        RealizerError: "no-pictures" or "too-many-pictures".
    """
    pictures = tuple(f"{name}/{file}" for file in sorted(files) if is_picture(file))
    if not pictures:
        raise RealizerError(NoPictures(folder=name))
    if len(pictures) > _MOST_FRAMES:
        raise RealizerError(TooManyPictures(name=name))
    ends = tuple(_USUAL * (number + 1) / len(pictures) for number in range(len(pictures)))
    return PictureAnimation(pictures, ends, {"start": 0.0, "end": _USUAL})


@remembered
def read_animation(path: Path) -> PictureAnimation:
    """The sequence of a file.

    The root ``xmlanim`` has the attribute ``picturePath``, the folder of the pictures; inside, ``frame`` has a picture
    ``imgsrc`` and its ``duration``, s, and ``sync`` a sync point ``type`` between two of them.

    Raises:
        RealizerError: "bad-asset", with file, line and element; "too-many-pictures".
        OSError: the file cannot be read.
    """
    root = read_xml(path, _TAG)
    unknown = next((element for element in root if element.tag not in (_FRAME, _SYNC)), None)
    if unknown is not None:
        raise asset_error(unknown, f"known are {_FRAME} and {_SYNC}")
    frames = root.findall(_FRAME)
    if not frames:
        raise asset_error(root, f"no {_FRAME} inside")
    if len(frames) > _MOST_FRAMES:
        raise RealizerError(TooManyPictures(name=path.name))
    folder = attribute(root, "picturePath").strip("/")
    files = tuple("/".join(filter(None, (folder, attribute(frame, "imgsrc")))) for frame in frames)
    ends = tuple(accumulate(map(_duration, frames)))
    if ends[-1] > _LONGEST:
        raise asset_error(root, f"it lasts {ends[-1]:g} s; the limit is {_LONGEST:g} s")
    return PictureAnimation(files, ends, _points(root, ends))


def _points(root: XmlElement, ends: Sequence[float]) -> dict[str, float]:
    """Return the times of the sync points, s: each is where the frames before it end."""
    points = {"start": 0.0}
    for sync, element in by_sync_id(root.iterfind(_SYNC), "type").items():
        before = sum(1 for _ in element.itersiblings(_FRAME, preceding=True))
        time = ends[before - 1] if before else 0.0
        if not is_placed(sync, time / ends[-1]):
            raise asset_error(element, f"{sync} is where the sequence {'starts' if sync == 'start' else 'ends'}")
        points[sync] = time
    points.pop("end", None)
    return {**points, "end": ends[-1]}


def check_pictures(files: Iterable[str], asset: Callable[[str], Path]) -> None:
    """Check that pictures exist.

    Raises:
        RealizerError: "no-asset", "forbidden-path" or "not-a-picture".
    """
    for file in dict.fromkeys(files):
        if not is_picture(file):
            raise RealizerError(NotAPicture(file=file))
        asset(file)


def _duration(element: XmlElement) -> float:
    duration = number(element, "duration")
    if duration <= 0.0:
        raise asset_error(element, f"duration='{duration:g}' is not above 0")
    return duration
