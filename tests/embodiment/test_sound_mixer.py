"""Sounds as the sound device of this machine gets them."""

from collections.abc import Callable
from concurrent.futures import Future

import numpy as np
import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioClip, AudioGain, AudioMove, AudioStart, AudioStop, Sound
from reactive_realizer.embodiment.played_sound import RATE, Samples
from reactive_realizer.embodiment.sound_mixer import SoundMixer

PIECE = 480
LATENCY = 0.04


def at_once(make: Callable[[], Samples]) -> "Future[Samples]":
    done: Future[Samples] = Future()
    done.set_result(make())
    return done


class Device:
    """A device that asks for 10 ms of samples at a time, and plays them 40 ms later, 10 s after the realizer began.

    Args:
        rate: of its clock, samples for each second of the realizer.
    """

    def __init__(self, rate: float = RATE) -> None:
        self.mixer = SoundMixer(at_once)
        self.heard = np.zeros(0, np.float32)
        self._rate = rate

    @property
    def now(self) -> float:
        return 10.0 + len(self.heard) / self._rate

    def play(self, seconds: float) -> None:
        for _ in range(round(seconds * RATE / PIECE)):
            jitter = 0.001 * (-1) ** (len(self.heard) // PIECE)
            piece = self.mixer.mixed(PIECE, self.now + LATENCY + jitter)
            assert np.array_equal(piece[:, 0], piece[:, 1])
            self.heard = np.concatenate([self.heard, piece[:, 0]])

    def time_of(self, index: int) -> float:
        """When a sample is heard, realizer time, s."""
        return 10.0 + LATENCY + index / self._rate


def start(time: float | None, samples: np.ndarray, id_: str = "s") -> AudioStart:
    pcm = (samples * 32768).astype("<i2").tobytes()
    clip = AudioClip(id_, Sound.from_pcm(pcm, RATE))
    return AudioStart("alice", clip, None if time is None else GlobalTime(time))


def steady(seconds: float = 1.0) -> np.ndarray:
    return np.full(round(seconds * RATE), 0.25)


def onset(device: Device) -> float:
    """When the first sound is heard, s."""
    return device.time_of(int(np.flatnonzero(device.heard)[0]))


def test_a_sound_is_heard_at_its_start_without_gaps() -> None:
    device = Device()
    device.mixer.take(start(10.5, steady()))
    device.play(2)
    assert onset(device) == pytest.approx(10.5, abs=0.0015)
    loud = np.flatnonzero(device.heard)
    assert len(loud) == RATE
    assert np.all(np.diff(loud) == 1)


def test_a_sound_that_comes_late_is_played_from_its_first_sample_and_reported_late() -> None:
    device = Device()
    device.play(1)
    device.mixer.take(start(10.9, np.linspace(0.1, 0.5, RATE)))
    device.play(0.5)
    assert device.heard[np.flatnonzero(device.heard)[0]] == pytest.approx(0.1, abs=1e-3)
    (report,) = device.mixer.heard(GlobalTime(device.now))
    assert report.time - report.position == pytest.approx(11 + LATENCY, abs=0.002)


def test_a_sound_that_comes_more_than_a_second_late_is_joined_in_the_middle() -> None:
    device = Device()
    device.play(2)
    device.mixer.take(start(10.5, steady(3)))
    device.play(0.5)
    (report,) = device.mixer.heard(GlobalTime(device.now))
    assert report.time - report.position == pytest.approx(10.5, abs=0.002)


def test_a_device_with_another_clock_reports_its_drift() -> None:
    device = Device(rate=RATE * 0.99)
    device.mixer.take(start(10.5, steady(6)))
    device.play(5.5)
    (report,) = device.mixer.heard(GlobalTime(device.now))
    assert report.time - report.position == pytest.approx(10.55, abs=0.01)


def test_a_start_that_becomes_known_later_counts() -> None:
    device = Device()
    device.mixer.take(start(None, steady()))
    device.play(0.3)
    device.mixer.take(AudioMove("s", GlobalTime(10.6), GlobalTime(device.now)))
    device.play(0.5)
    assert onset(device) == pytest.approx(10.6, abs=0.0015)


def test_an_interruption_fades_from_the_next_sample_on() -> None:
    device = Device()
    device.mixer.take(start(10.1, steady(2)))
    device.play(0.5)
    device.mixer.take(AudioStop("s", GlobalTime(10.45), 0.03))
    cut = len(device.heard)
    device.play(0.2)
    assert device.heard[cut] == pytest.approx(0.25, abs=0.01)
    assert np.all(np.diff(device.heard[cut:]) <= 0)
    assert not device.heard[cut + 1441 :].any()
    assert device.mixer.heard(GlobalTime(device.now)) == []


def test_a_sound_that_is_stopped_before_it_begins_is_not_heard() -> None:
    device = Device()
    device.mixer.take(start(10.5, steady()))
    device.mixer.take(AudioStop("s", GlobalTime(10.5), 0.03))
    device.play(1)
    assert not device.heard.any()


def test_sounds_are_added_and_their_gains_change_smoothly() -> None:
    device = Device()
    device.mixer.take(start(10.1, steady(2)))
    device.mixer.take(start(10.6, steady(2), "t"))
    device.play(0.3)
    device.mixer.take(AudioGain("s", 2.0, GlobalTime(10.3)))
    device.play(0.7)
    assert np.max(np.abs(np.diff(device.heard[round(0.2 * RATE) : round(0.5 * RATE)]))) < 0.001
    assert device.heard[round(0.5 * RATE)] == pytest.approx(0.5, abs=0.01)
    assert device.heard[-1] == pytest.approx(0.75, abs=0.01)
