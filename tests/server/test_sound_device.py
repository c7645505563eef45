"""Sounds on a sound device of this machine. The device is a fake: a real one has a clock and a thread of its own."""

from collections.abc import Callable, Iterator
from concurrent.futures import Future
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Self

import numpy as np
import pytest
import soundfile

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.bml.names import BMLT
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.errors import RealizerError
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.server import sound_device as module
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.sound_device import check_sound_device, sound_device
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import block

RATE = 48_000
LATENCY = 0.1


def sound(id_: str, start: float) -> str:
    """A sound of 0.6 s."""
    return f'<bmlt:audiofile xmlns:bmlt="{BMLT}" id="{id_}" filename="{id_}.wav" start="{start}"/>'


BOTH = sound("low", 0.2) + sound("high", 0.5)


class FakeStream:
    """A fake of `sounddevice.OutputStream`, whose samples the test asks for.

    Attributes:
        options: with which it was opened.
        running: whether it plays.
        begun: when the first sample is heard, s.
        heard: the samples that it got, (N, 2).
    """

    def __init__(self, rate: int, *, callback: Callable[..., None], **options: Any) -> None:
        self.options = {"samplerate": rate, **options}
        self.running = False
        self.begun: float | None = None
        self.heard = np.zeros((0, options["channels"]), np.float32)
        self._fill = callback

    def __enter__(self) -> Self:
        self.running = True
        return self

    def __exit__(self, *_: object) -> None:
        self.running = False

    def play(self, now: float) -> None:
        """Ask for 10 ms of samples, which are heard after the latency."""
        self.begun = now + LATENCY if self.begun is None else self.begun
        piece = np.full((RATE // 100, 2), np.nan, np.float32)
        self._fill(piece, len(piece), SimpleNamespace(currentTime=7.0, outputBufferDacTime=7.0 + LATENCY), None)
        self.heard = np.concatenate([self.heard, piece])

    def level(self, time: float) -> list[float]:
        """What is heard on both sides at a time, s."""
        assert self.begun is not None
        left, right = self.heard[round((time - self.begun) * RATE)]
        return [round(float(left), 2), round(float(right), 2)]


class FakeExecutor:
    """A fake of a thread, which does its work at once."""

    def __init__(self, _: int) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def submit(self, make: Callable[[], Any]) -> "Future[Any]":
        done: Future[Any] = Future()
        done.set_result(make())
        return done


@pytest.fixture
def streams(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[FakeStream]]:
    """The streams that are opened, in place of those of PortAudio."""
    opened: list[FakeStream] = []

    def open_(*args: Any, **options: Any) -> FakeStream:
        opened.append(FakeStream(*args, **options))
        return opened[-1]

    monkeypatch.setattr(module, "import_module", lambda _: SimpleNamespace(OutputStream=open_))
    monkeypatch.setattr(module, "ThreadPoolExecutor", FakeExecutor)
    yield opened
    assert not any(each.running for each in opened)


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    """Two steady sounds of 0.6 s; the second one is in stereo, on the left side."""
    soundfile.write(tmp_path / "low.wav", np.full(RATE * 6 // 10, 0.25), RATE, "PCM_16")
    soundfile.write(tmp_path / "high.wav", np.full((RATE * 6 // 10, 2), (0.5, 0.0)), RATE, "PCM_16")
    return tmp_path


async def played(assets: Path, streams: list[FakeStream], behaviors: str = BOTH, *, stop: float = 9.0) -> FeedbackList:
    """The feedback of behaviors that a device plays for 1.5 s; all of them are stopped at a time, s."""
    async with open_scene(SceneOptions(voice="text", assets=(assets,))) as scene:
        live, feedback = LiveScene(scene, ManualClock()), FeedbackList()
        scene.realizer.feedback.listen(feedback)
        with sound_device(live, Intake(live), "Loud"):
            ticks = live.ticker.ticks()
            scene.realizer.put(BmlText(block("b", behaviors)))
            for number in range(150):
                if number == round(100 * stop):
                    scene.realizer.put(BmlText(block("c", composition="REPLACE")))
                await live.step(await anext(ticks))
                await scene.realizer.settle()
                streams[0].play(live.now)
    return feedback


async def test_sounds_are_mixed_and_heard_when_they_start(assets: Path, streams: list[FakeStream]) -> None:
    feedback = await played(assets, streams)
    (stream,) = streams
    assert stream.options == {
        "samplerate": RATE, "device": "Loud", "channels": 2, "dtype": "float32", "latency": LATENCY
    }  # fmt: skip
    silent, low, both, high = [0.0, 0.0], [0.25, 0.25], [0.75, 0.25], [0.5, 0.0]
    heard = {
        0.195: silent, 0.205: low, 0.495: low, 0.505: both, 0.795: both, 0.805: high, 1.095: high, 1.105: silent
    }  # fmt: skip
    start = feedback.time("b:start")
    assert {time: stream.level(start + time) for time in heard} == heard
    assert feedback.time("b:end") - start == pytest.approx(1.1, abs=0.005)
    assert feedback.warnings == []


async def test_an_interruption_is_heard_as_soon_as_the_device_asks_for_samples(
    assets: Path, streams: list[FakeStream]
) -> None:
    feedback = await played(assets, streams, stop=0.7)
    (stream,) = streams
    cut = feedback.time("b:end")
    assert stream.level(cut + LATENCY - 0.02) == [0.75, 0.25]
    assert stream.level(cut + LATENCY + 0.04) == [0.0, 0.0]
    assert np.abs(np.diff(stream.heard[round((cut - 0.1) * RATE) :], axis=0)).max() < 0.03, "it fades"


async def test_the_plan_follows_a_sound_that_the_device_plays_late(assets: Path, streams: list[FakeStream]) -> None:
    feedback = await played(assets, streams, sound("low", 0.0))
    start, (stream,) = feedback.time("b:low:start"), streams
    assert [stream.level(start + time) for time in (0.08, 0.12, 0.68)] == [[0.0, 0.0], [0.25, 0.25], [0.25, 0.25]]
    assert feedback.time("b:low:end") - start == pytest.approx(0.6 + LATENCY, abs=0.02)


def test_without_the_extra_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "find_spec", lambda _: None)
    with pytest.raises(RealizerError, match=r"pip install 'reactive-realizer\[sound\]'"):
        check_sound_device("")
