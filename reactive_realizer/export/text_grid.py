"""Writes what was really played as a TextGrid, the format of Praat, which ELAN imports too."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple

from praatio import textgrid

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioChange, AudioMove, AudioStart, AudioStop
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress, PredictionFeedback, SyncPointProgress

_DIGITS: Final = 4
"""Decimals of times. With more, small numbers would have exponents, which few programs read."""
_SHORTEST: Final = 10.0**-_DIGITS
"""The shortest interval and the shortest session, s: the format has none of length 0."""
_EARLY: Final = 1e-3
"""A word that begins so long before its sound still belongs to it, s."""

_Interval = tuple[float, float, str]
"""Start and end, s, and label."""


class _Key(NamedTuple):
    """A behavior, or a block, of which ``behavior`` is empty."""

    character: str
    block: str
    behavior: str

    @property
    def label(self) -> str:
        return f"{self.block}:{self.behavior}" if self.behavior else self.block


@dataclass(slots=True)
class _Heard:
    """A sound with the words of a speech."""

    announced: AudioStart
    start: float | None
    stop: float = float("inf")


class PlayedLog:
    """Collects feedback and captions, and writes them as tiers.

    Each character has a tier ``ID words``, one for its blocks, one for each kind of behavior, such as ``ID gesture``
    (a second one for those that overlap), and one with its sync points.
    """

    def __init__(self) -> None:
        self._kinds: dict[_Key, str] = {}
        self._progress: list[tuple[_Key, str, float]] = []
        self._heard: dict[str, _Heard] = {}

    def report(self, report: Report) -> None:
        """Note feedback (`FeedbackManager.listen`)."""
        match report.message:
            case PredictionFeedback(character=character, block=block, behaviors=behaviors):
                for each in behaviors:
                    self._kinds[_Key(character, block, each.behavior.id)] = each.behavior.name
            case BlockProgress(character, block, sync, time):
                self._progress.append((_Key(character, block, ""), sync, round(time, _DIGITS)))
            case SyncPointProgress(character, block, behavior, sync, time=time):
                self._progress.append((_Key(character, block, behavior), sync, round(time, _DIGITS)))
            case _:
                pass

    def hear(self, change: AudioChange) -> None:
        """Note a sound, or a change of one (`Realizer.hear`)."""
        match change:
            case AudioStart(clip=clip, start=start) if clip.caption is not None:
                self._heard[clip.id] = _Heard(change, start)
            case AudioMove(id_, start) if id_ in self._heard:
                self._heard[id_].start = start
            case AudioStop(id_, time) if id_ in self._heard:
                self._heard[id_].stop = time
            case _:
                pass

    def write(self, path: Path, end: GlobalTime) -> None:
        """Write the tiers of all characters.

        Args:
            path: of the file.
            end: of the session, s.

        Raises:
            OSError: the file cannot be written.
        """
        tiers = self._intervals(round(end, _DIGITS))
        last = max(round(end, _DIGITS), _SHORTEST, *(until for tier in tiers.values() for _, until, _ in tier))
        grid = textgrid.Textgrid(0.0, last)
        for name, intervals in _without_overlaps(tiers):
            grid.addTier(textgrid.IntervalTier(name, intervals, 0.0, last))
        for name, points in self._points().items():
            marks = [(time, " ".join(labels)) for time, labels in sorted(points.items())]
            grid.addTier(textgrid.PointTier(name, marks, 0.0, last))
        grid.save(str(path), "long_textgrid", includeBlankSpaces=True)

    def _intervals(self, end: float) -> dict[str, list[_Interval]]:
        """Return what was heard and what played, by tier; what still plays ends with the session."""
        tiers: defaultdict[str, list[_Interval]] = defaultdict(list)
        for heard in self._heard.values():
            tiers[f"{heard.announced.character} words"] += _words(heard)
        started: dict[_Key, float] = {}
        for key, sync, time in [*self._progress, *((key, "end", end) for key, _, _ in self._progress)]:
            if sync == "start":
                started[key] = time
            elif sync == "end" and key in started:
                tiers[self._tier(key)].append((started.pop(key), time, key.label))
        return tiers

    def _tier(self, key: _Key) -> str:
        return f"{key.character} {self._kinds.get(key, 'behavior') if key.behavior else 'blocks'}"

    def _points(self) -> dict[str, dict[float, list[str]]]:
        """Return the labels of the sync points of behaviors at each time, by tier."""
        tiers: defaultdict[str, defaultdict[float, list[str]]] = defaultdict(lambda: defaultdict(list))
        for key, sync, time in self._progress:
            if key.behavior:
                tiers[f"{key.character} sync points"][time].append(f"{key.label}:{sync}")
        return dict(tiers)


def _words(heard: _Heard) -> Iterator[_Interval]:
    """Yield the words of a sound that were heard: to the next word, or to the end of the sound."""
    clip, caption = heard.announced.clip, heard.announced.clip.caption
    if heard.start is None or caption is None:
        return
    ends = [*(begin for begin, _, _ in caption.words[1:]), clip.sound.duration]
    for (begin, first, last), until in zip(caption.words, ends, strict=True):
        if -_EARLY <= begin < clip.sound.duration and heard.start + begin < heard.stop:
            last_heard = min(heard.start + until, heard.stop)
            yield round(heard.start + begin, _DIGITS), round(last_heard, _DIGITS), caption.text[first:last]


def _without_overlaps(tiers: dict[str, list[_Interval]]) -> Iterator[tuple[str, list[_Interval]]]:
    """Yield tiers whose intervals do not overlap: what does is on a further tier of the same name and a number."""
    for name, intervals in tiers.items():
        rows: list[list[_Interval]] = []
        for start, end, label in sorted(intervals):
            if end - start >= _SHORTEST:
                row = next((row for row in rows if row[-1][1] <= start), None)
                if row is None:
                    rows.append(row := [])
                row.append((start, end, label))
        yield from ((name if number == 1 else f"{name} {number}", row) for number, row in enumerate(rows, 1))
