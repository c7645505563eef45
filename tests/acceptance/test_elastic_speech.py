"""Speeches that are only read: two words a second, and stretched by constraints (thesis 8.11)."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioGain, AudioStart
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

TEXT = '<text>one two <sync id="m"/>three four.</text>'
HIT = "anticipators:partner:hit"


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="captions")) as pilot:
        yield pilot


def times(pilot: RealizerPilot) -> list[float]:
    return [pilot.feedback.time(f"b:s:{sync}") for sync in ("start", "m", "end")]


def words(pilot: RealizerPilot) -> list[float]:
    """The times of the words in the last caption."""
    *_, last = (change for change in pilot.sounds if isinstance(change, AudioStart))
    assert last.clip.caption is not None
    assert last.start is not None
    return [last.start + begin for begin, _, _ in last.clip.caption.words]


async def test_it_is_read_at_two_words_a_second(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<speech id="s">{TEXT}</speech>')
    await pilot.advance(2.5)
    assert times(pilot) == [0.0, 1.0, 2.0]
    assert words(pilot) == [0.0, 0.5, 1.0, 1.5]


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [
        ('start="0" end="4"', [0.0, 2.0, 4.0]),
        ('start="1" end="2.2"', [1.0, 1.6, 2.2]),
    ],
)
async def test_constraints_stretch_it_evenly(pilot: RealizerPilot, attributes: str, expected: list[float]) -> None:
    pilot.block("b", f'<speech id="s" {attributes}>{TEXT}</speech>')
    await pilot.advance(5.0)
    assert times(pilot) == pytest.approx(expected)
    assert pilot.feedback.warnings == []


async def test_each_part_takes_the_time_between_its_sync_points(pilot: RealizerPilot) -> None:
    beat = '<gesture id="g" lexeme="BEAT" stroke="3"/>'
    tie = '<constraint id="c"><synchronize><sync ref="g:stroke"/><sync ref="s:m"/></synchronize></constraint>'
    pilot.block("b", f'<speech id="s" start="0" end="4">{TEXT}</speech>{beat}{tie}')
    await pilot.advance(5.0)
    assert times(pilot) == [0.0, 3.0, 4.0]
    assert words(pilot) == [0.0, 1.5, 3.0, 3.5]


async def test_a_prediction_that_moves_stretches_what_is_left_and_the_caption_tells(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block("b", f'<speech id="s" start="0" end="{HIT}">{TEXT}</speech>')
    await pilot.advance(0.6)
    pilot.predict("partner", "hit", 3.0)
    await pilot.advance(3.0)
    start, mark, end = times(pilot)
    assert (start, end) == (0.0, 3.0)
    assert 1.0 < mark < 3.0
    assert words(pilot) == pytest.approx([0.0, mark / 2, mark, (mark + end) / 2])


async def test_it_is_not_read_faster_than_four_words_a_second(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<speech id="s" start="0" end="0.5">{TEXT}</speech>')
    await pilot.advance(3.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "too little time" in warning.text


async def test_what_was_read_of_a_stretched_speech_is_reported_when_it_is_cut(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<speech id="s" start="0" end="4">{TEXT}</speech>')
    await pilot.advance(1.5)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" speech="word"/>')
    await pilot.advance(2.0)
    (end,) = (each for each in pilot.feedback.of("syncPointProgress") if each.id == "b:s:end")
    assert end.global_time == 2.0
    assert end.element.get("{urn:reactive-realizer:1}text") == "two"


async def test_its_volume_is_told_to_clients(pilot: RealizerPilot) -> None:
    louder = '<bmla:trajectory type="instant" targetValue="100"/>'
    pilot.block(
        "b",
        f'<speech id="s">{TEXT}</speech><bmla:parametervaluechange id="v" target="s" paramId="volume" '
        f'start="s:m">{louder}</bmla:parametervaluechange>',
    )
    await pilot.advance(2.5)
    assert [(change.gain, change.time) for change in pilot.sounds if isinstance(change, AudioGain)] == [(2.0, 1.0)]
