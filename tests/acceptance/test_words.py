"""A speech that asks for it has a sync point for every word."""

from typing import Any

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

ONE_TWO_THREE = [("word0", 0.0, "0", "one"), ("word1", 0.24, "1", "two"), ("word2", 0.48, "2", "three")]


def speech(text: str, words: str | None = "true") -> str:
    wanted = "" if words is None else f' xmlns:rr="{OWN}" rr:words="{words}"'
    return f'<speech id="s"{wanted}><text>{text}</text></speech>'


def words(pilot: RealizerPilot) -> list[tuple[Any, ...]]:
    """Sync point, time, index and text of each word that was reported."""
    told = [line.element for line in pilot.feedback.of("syncPointProgress") if ":word" in line.id]
    return [
        (
            each.get("id", "").split(":")[-1],
            float(each.get("time", "")),
            *(each.get(f"{{{OWN}}}{n}") for n in ("word", "text")),
        )
        for each in told
    ]


async def test_every_word_is_reported_when_it_begins(pilot: RealizerPilot) -> None:
    pilot.block("b", speech("one two three"))
    await pilot.advance(1)
    assert words(pilot) == ONE_TWO_THREE
    order = [id_ for id_ in pilot.feedback.progress if id_.startswith("b:s:")]
    assert order == ["b:s:start", "b:s:word0", "b:s:word1", "b:s:word2", "b:s:end"]
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("wanted", [None, "false"])
async def test_words_are_no_sync_points_of_a_speech_that_does_not_ask_for_them(
    pilot: RealizerPilot, wanted: str | None
) -> None:
    pilot.block("b", speech("one two three", wanted) + '<head id="h" lexeme="NOD" stroke="s:word1"/>')
    await pilot.advance(2)
    assert words(pilot) == []
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:h"]
    assert pilot.feedback.reached("b:s:end")


async def test_a_stroke_falls_on_a_word_without_a_mark(pilot: RealizerPilot) -> None:
    pilot.block("b", speech("No, that is the red one.") + '<gesture id="g" lexeme="BEAT" stroke="s:word4"/>')
    pilot.block("c", '<head id="h" lexeme="NOD" stroke="b:s:word5+0.1"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:g:stroke") == pilot.feedback.time("b:s:word4")
    assert pilot.feedback.time("c:h:stroke") == pytest.approx(pilot.feedback.time("b:s:word5") + 0.1)


async def test_a_word_that_does_not_exist_is_named_in_the_warning(pilot: RealizerPilot) -> None:
    pilot.block("b", speech("one two") + '<head id="h" lexeme="NOD" stroke="s:word2"/>')
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "start, word0, word1, end" in (warning.element.text or "")


async def test_a_mark_keeps_its_name(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('one two <sync id="word0"/>three'))
    await pilot.advance(1)
    assert [each[:2] for each in words(pilot)] == [("word1", 0.24), ("word0", 0.48), ("word2", 0.48)]


@pytest.mark.parametrize(
    ("at", "how", "begun"),
    [(0.0, "now", 0), (0.3, "now", 2), (0.3, "word", 2), (0.24, "now", 1), (0.24, "word", 1), (0.5, "word", 3)],
)
async def test_a_speech_that_is_cut_reports_the_words_that_began(
    pilot: RealizerPilot, at: float, how: str, begun: int
) -> None:
    pilot.block("b", speech("one two three"))
    pilot.block("i", f'<bmla:interrupt id="i" target="b" start="b:s:start+{at}" speech="{how}"/>')
    await pilot.advance(2)
    assert words(pilot) == ONE_TWO_THREE[:begun]
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    assert end.get(f"{{{OWN}}}word") == str(begun - 1)


async def test_a_value_that_is_no_boolean_is_explained(pilot: RealizerPilot) -> None:
    pilot.block("b", speech("one two", "always"))
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "words='always' must be true or false" in (warning.element.text or "")


async def test_words_move_with_their_speech(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", speech("one two three").replace("<speech", '<speech start="anticipators:t:hit"'))
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 1.5)
    await pilot.advance(2)
    assert [each[1] for each in words(pilot)] == pytest.approx([1.5, 1.74, 1.98])


@pytest.mark.speech
async def test_a_real_voice_gives_the_times_of_its_words() -> None:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        pilot.block("b", speech("The first, and the second word."))
        await pilot.advance(4)
        times = [each[1] for each in words(pilot)]
        assert len(times) == 6
        assert times == sorted(set(times))
        assert times[-1] < pilot.feedback.time("b:s:end")
