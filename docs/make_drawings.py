"""Draws the pictures of docs/time.md from the pegs of a running realizer."""

import asyncio
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.pegboard.peg_view import PegView
from reactive_realizer.testing.pilot import open_pilot

PICTURES = Path(__file__).with_name("pictures")
STRATEGIES = ("smartbody", "embr", "convex")

WIDTH, LEFT, RIGHT, ROW, BAR = 760, 80, 110, 48, 12
"""Width of a picture, its left and right margins, and the heights of a row and of a bar, pixels."""

INK, GRID, LINK, SHADES = "#222", "#ddd", "#b3541e", ("#e1e9f4", "#bccfe6")

MOVED = """
  <gesture id="clap" lexeme="BEAT" stroke="anticipators:partner:hit"/>
  <head id="nod" lexeme="NOD" start="clap:strokeEnd"/>
"""
ORDERED = """
  <speech id="words"><text>Here it is.</text></speech>
  <head id="nod" lexeme="NOD"/>
  <constraint id="order">
    <after ref="words:end"><sync ref="nod:start"/></after>
    <after ref="anticipators:partner:hit"><sync ref="nod:start"/></after>
  </constraint>
"""
PLANNED = """
  <gaze id="look" target="bluebox" start="0" ready="0.4" end="3"/>
  <speech id="words" start="look:ready"><text>Over there, in the <sync id="box"/>blue box.</text></speech>
  <gesture id="show" lexeme="OFFER" mode="LEFT_HAND" start="words:start" stroke="words:box"/>
"""


@dataclass(frozen=True, slots=True)
class Panel:
    """The pegs of a board at one moment, with a title; `linked` draws lines between tied points."""

    title: str
    pegs: Sequence[PegView]
    linked: bool = True

    @property
    def rows(self) -> Mapping[str, list[PegView]]:
        """The pegs with a time by behavior, in order of time, predicted points first; without those of the block."""
        rows: dict[str, list[PegView]] = {}
        for peg in sorted(self.pegs, key=_time_of):
            if peg.time is not None and peg.key.behavior:
                rows.setdefault(peg.key.behavior, []).append(peg)
        return dict(sorted(rows.items(), key=lambda row: (row[1][0].kind != "predicted", _time_of(row[1][0]))))


def drawings() -> dict[str, str]:
    """The pictures as SVG, by their file names."""
    return asyncio.run(_drawings())


async def _drawings() -> dict[str, str]:
    moved = [await _board("hit is predicted for 1.2 s", MOVED, 1.2), await _board("and now for 1.6 s", MOVED, 1.2, 1.6)]
    ordered = [await _board("the words bind", ORDERED, 0.3), await _board("the hit binds", ORDERED, 0.3, 1.1)]
    planned = [await _plan(strategy) for strategy in STRATEGIES]
    panels = {"time-moved": moved, "time-order": ordered, "time-strategies": planned}
    return {f"{name}.svg": _Picture(each).text for name, each in panels.items()}


async def _board(title: str, behaviors: str, *hits: float) -> Panel:
    """The board after one or more predictions of a hit."""
    async with open_pilot() as pilot:
        pilot.predict("partner", "hit", hits[0])
        pilot.block("b", behaviors)
        await pilot.tick()
        for hit in hits[1:]:
            pilot.predict("partner", "hit", hit)
            await pilot.tick()
        return Panel(title, pilot.realizer.board.snapshot())


async def _plan(strategy: str) -> Panel:
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", strategy=strategy)) as pilot:
        pilot.block("b", PLANNED)
        await pilot.tick()
        return Panel(strategy, pilot.realizer.board.snapshot(), linked=False)


class _Picture:
    """Panels below each other, with a common time axis."""

    def __init__(self, panels: Sequence[Panel]) -> None:
        last = max(_time_of(peg) for panel in panels for pegs in panel.rows.values() for peg in pegs)
        self._scale = (WIDTH - LEFT - RIGHT) / last
        self._parts: list[str] = []
        y = 0
        for panel in panels:
            self._draw(panel, y)
            y += 50 + ROW * len(panel.rows)
        self._axis(last, y)
        self._height = y + 16

    @property
    def text(self) -> str:
        size = f'viewBox="0 0 {WIDTH} {self._height}" width="{WIDTH}" height="{self._height}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11" fill="{INK}">'
        return "\n".join([head, '<rect width="100%" height="100%" fill="#fff"/>', *self._parts, "</svg>\n"])

    def _axis(self, last: float, bottom: float) -> None:
        for half in range(int(2 * last) + 1):
            x = self._x(half / 2)
            self._parts.insert(0, f'<path d="M{x:.1f} 24V{bottom - 14}" stroke="{GRID}"/>')
            self._parts.append(f'<text x="{x:.1f}" y="{bottom}" text-anchor="middle">{half / 2:g} s</text>')

    def _draw(self, panel: Panel, top: int) -> None:
        self._parts.append(f'<text x="8" y="{top + 16}" font-weight="bold">{escape(panel.title)}</text>')
        places: dict[str, tuple[float, float]] = {}
        for number, (name, pegs) in enumerate(panel.rows.items()):
            y = top + 56 + ROW * number
            self._parts.append(f'<text x="8" y="{y + 4}">{escape(name)}</text>')
            self._parts += self._bars(pegs, y)
            self._parts += self._points(pegs, y)
            places |= {str(peg.key): (self._x(_time_of(peg)), y) for peg in pegs}
        if panel.linked:
            self._parts += dict.fromkeys(line for peg in panel.pegs for line in _links(peg, places))

    def _bars(self, pegs: Sequence[PegView], y: float) -> Iterator[str]:
        times = [time for time, _ in itertools.groupby(map(_time_of, pegs))]
        for shade, (one, other) in zip(itertools.cycle(SHADES), itertools.pairwise(times), strict=False):
            box = f'x="{self._x(one):.1f}" y="{y - BAR / 2:g}" width="{(other - one) * self._scale:.1f}" height="{BAR}"'
            yield f'<rect {box} fill="{shade}"/>'

    def _points(self, pegs: Sequence[PegView], y: float) -> Iterator[str]:
        for time, same in itertools.groupby(pegs, key=_time_of):
            x, names = self._x(time), ", ".join(peg.key.sync for peg in same)
            yield f'<circle cx="{x:.1f}" cy="{y}" r="3"/>'
            yield f'<text transform="translate({x - 2:.1f} {y - 9}) rotate(-18)">{escape(names)}</text>'

    def _x(self, time: float) -> float:
        return LEFT + self._scale * time


def _links(peg: PegView, places: Mapping[str, tuple[float, float]]) -> Iterator[str]:
    """Lines from a point to those that a constraint ties it to."""
    for tie in peg.ties if peg.why else ():
        if tie in places and str(peg.key) in places and places[tie][1] != places[str(peg.key)][1]:
            (x1, y1), (x2, y2) = places[tie], places[str(peg.key)]
            yield f'<path d="M{x1:.1f} {y1}L{x2:.1f} {y2}" stroke="{LINK}" stroke-width="1.5"/>'


def _time_of(peg: PegView) -> float:
    return 0.0 if peg.time is None else round(peg.time, 6)


if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    for name, picture in drawings().items():
        (PICTURES / name).write_text(picture, encoding="utf-8")
