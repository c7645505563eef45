"""A text that was spoken before is not synthesized again."""

from collections.abc import AsyncIterator
from dataclasses import replace

import pytest

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.speech_engine import SpeechEngine
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.engine_harness import BLOCK, behavior_of, minimal_context, prepared


class Voice(TextVoice):
    """A voice that synthesizes asynchronously, and notes what.

    Attributes:
        size: of the audio of each utterance, bytes.
    """

    def __init__(self) -> None:
        super().__init__()
        self.size = 0
        self.asked: list[str] = []

    async def synthesize(  # type: ignore[override]  # a voice may be asynchronous
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None
    ) -> AsyncIterator[Utterance]:
        self.asked.append(text)
        yield replace(super().synthesize(text, marks, voice), audio=bytes(self.size))


@pytest.fixture
def voice() -> Voice:
    return Voice()


@pytest.fixture
def engine(voice: Voice) -> SpeechEngine:
    return SpeechEngine(minimal_context(voice))


def say(engine: SpeechEngine, text: str, id_: str = "s") -> Utterance:
    behavior = behavior_of(f'<speech id="{id_}"><text>{text}</text></speech>')
    return engine.plan(BLOCK, behavior, prepared(engine, behavior)).utterance


def test_a_repetition_is_the_same_utterance_at_once(engine: SpeechEngine, voice: Voice) -> None:
    first = say(engine, "Hello there.")
    again = behavior_of('<speech id="t"><text>Hello there.</text></speech>')
    assert engine.prepare(again) is None
    assert engine.plan(BLOCK, again, None).utterance is first
    assert voice.asked == ["Hello there."]


def test_another_text_or_another_mark_is_synthesized(engine: SpeechEngine, voice: Voice) -> None:
    for text in ("Hello there.", "Hello.", '<sync id="m"/>Hello.', 'Hello<sync id="m"/>.', '<sync id="n"/>Hello.'):
        say(engine, text)
    assert len(voice.asked) == 5


def test_a_text_is_remembered_when_it_is_planned_so_that_a_replay_does_the_same(
    engine: SpeechEngine, voice: Voice
) -> None:
    behavior = behavior_of('<speech id="s"><text>Hello.</text></speech>')
    prepared(engine, behavior)
    prepared(engine, behavior)
    assert voice.asked == ["Hello.", "Hello."]


def test_what_was_said_longest_ago_is_forgotten_first(engine: SpeechEngine, voice: Voice) -> None:
    voice.size = 6_000_000
    for text in ("one", "two", "one", "three"):
        say(engine, text)
    assert voice.asked == ["one", "two", "three"]
    say(engine, "one")
    assert voice.asked == ["one", "two", "three"], "it was said after two"
    say(engine, "two")
    assert voice.asked == ["one", "two", "three", "two"]
