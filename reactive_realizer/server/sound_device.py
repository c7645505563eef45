"""Plays sounds on a sound device of this machine, through PortAudio (sounddevice, an extra)."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Final

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.played_sound import RATE
from reactive_realizer.embodiment.sound_mixer import SoundMixer
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.server.intake import Intake
from reactive_realizer.server.live_scene import LiveScene

_CHANNELS: Final = 2
_INTERVAL: Final = 0.25
"""Time between two reports of what is heard, s."""
_LATENCY: Final = 0.1
"""Time from the request for samples until they are heard, s. With less, a busy machine leaves gaps."""
_CLIENT: Final = object()
"""The device among the clients that report what is heard."""


class NoSoundOutput(Fault):
    """Sound cannot be played on this machine."""

    code = "no-sound-output"
    template = "sound cannot be played on this machine: {reason}"
    reason: str


def check_sound_device(name: str) -> None:
    """Check whether a device can be used.

    Raises:
        RealizerError: "no-sound-output": it cannot, or PortAudio is not installed.
    """
    if find_spec("sounddevice") is None:
        raise RealizerError(NoSoundOutput(reason="pip install 'reactive-realizer[sound]'"))
    try:
        library = import_module("sounddevice")
    except OSError as problem:
        raise RealizerError(NoSoundOutput(reason=f"{problem} (in Debian: libportaudio2)")) from problem
    try:
        library.check_output_settings(name or None, _CHANNELS, "float32", samplerate=RATE)
    except (library.PortAudioError, ValueError) as problem:
        raise RealizerError(NoSoundOutput(reason=str(problem))) from problem


@contextmanager
def sound_device(live: LiveScene, intake: Intake, name: str) -> Iterator[None]:
    """Play all sounds of a scene on a device that was checked, and report what is heard of them as a page does.

    Args:
        live: the scene.
        intake: takes the reports.
        name: of the device, or a part of it; empty for the default one.
    """
    with ThreadPoolExecutor(1) as executor:
        mixer = SoundMixer(executor.submit)

        def fill(out: Any, count: int, times: Any, status: object) -> None:
            out[:] = mixer.mixed(count, live.now + times.outputBufferDacTime - times.currentTime)

        live.realizer.hear(mixer.take)
        unsubscribe = live.feedback.ticks.subscribe(_reporter(mixer, intake))
        stream = import_module("sounddevice").OutputStream(
            RATE, device=name or None, channels=_CHANNELS, dtype="float32", latency=_LATENCY, callback=fill
        )
        with stream:
            yield
        unsubscribe()


def _reporter(mixer: SoundMixer, intake: Intake) -> Callable[[GlobalTime], None]:
    """Reports a few times a second, at ticks, what is heard."""
    reported = GlobalTime(-_INTERVAL)

    def report(now: GlobalTime) -> None:
        nonlocal reported
        if now - reported < _INTERVAL:
            return
        reported = now
        for heard in mixer.heard(now):
            with suppress(RealizerError):  # a sound has just ended, or was held up for more than a second
                intake.hear(heard, _CLIENT)

    return report
