"""The TextGrid of a session."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from praatio import textgrid

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block

SPEECH = '<speech id="s"><text>Hello, <sync id="you"/>"you" there.</text></speech>'


@pytest.fixture
def grid(bml: Callable[..., str], tmp_path: Path) -> Callable[[str], Any]:
    def read(text: str) -> Any:
        file = tmp_path / "out.TextGrid"
        assert main(["realize", bml(text), "--voice", "text", "--textgrid", str(file)]) == 0
        return textgrid.openTextgrid(str(file), includeEmptyIntervals=False)

    return read


def entries(grid: Any, tier: str) -> list[tuple[Any, ...]]:
    return [tuple(round(v, 3) if isinstance(v, float) else v for v in each) for each in grid.getTier(tier).entries]


def test_words_and_behaviors_are_where_they_were_played(grid: Callable[[str], Any]) -> None:
    played = grid(block("b", SPEECH + '<gesture id="g" lexeme="BEAT" mode="LEFT_HAND" stroke="s:you"/>'))
    hello, you, there = entries(played, "alice words")
    assert [hello[2], you[2], there[2]] == ["Hello", "you", "there"]
    assert entries(played, "alice speech") == [(hello[0], there[1], "b:s")]
    ((start, end, label),) = entries(played, "alice gesture")
    assert label == "b:g"
    assert start < you[0] < end
    strokes = [time for time, mark in entries(played, "alice sync points") if "b:g:stroke" in mark.split()]
    assert strokes == [you[0]]


def test_behaviors_of_a_kind_that_overlap_are_on_two_tiers(grid: Callable[[str], Any]) -> None:
    left, right = (f'<gesture id="{m[0]}" lexeme="BEAT" mode="{m}_HAND" start="0"/>' for m in ("LEFT", "RIGHT"))
    played = grid(block("b", left + right))
    assert [each[2] for tier in ("alice gesture", "alice gesture 2") for each in entries(played, tier)] == [
        "b:L",
        "b:R",
    ]


def test_a_speech_that_is_interrupted_has_the_words_that_were_heard(grid: Callable[[str], Any]) -> None:
    played = grid(block("b", SPEECH) + block("c", '<bmla:interrupt id="i" target="b" start="0.2"/>'))
    ((start, end, word),) = entries(played, "alice words")
    assert (start, word) == (0.0, "Hello")
    assert end == pytest.approx(0.2, abs=0.02)


def test_a_session_in_which_nothing_plays_has_an_empty_file(grid: Callable[[str], Any]) -> None:
    waiting = block("b", '<head id="h" lexeme="NOD" start="anticipators:never:comes"/>')
    assert grid(waiting).tierNames == ()
