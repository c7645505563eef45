"""Measures the mouth in the page against the sound, while a character speaks and is interrupted.

Drawing is left out: a software renderer would stop the page for a tenth of a second at a time. In each animation
frame, the page notes the weights of its morph targets and the sample that is heard, by the audio
clock. The position in the utterance at which its lip-sync has these weights, less the position that is heard, is how
far the mouth is ahead.
"""

import asyncio
import shutil
from collections.abc import Mapping, Sequence
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from aiohttp import ClientSession
from numpy.typing import NDArray
from playwright.async_api import async_playwright

from benchmarks._jitter import jittery
from benchmarks._served import served
from reactive_realizer.assembly.assets import Assets
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.engine.tts import Utterance, completed
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.export.video import FLAGS
from reactive_realizer.testing.pilot import block

_CONDITIONS = {"near": 0.0, "jitter": 0.1}
"""The jitter of the socket under each condition, s."""

AIMS = {
    f"{name}.{figure}": aim for name in _CONDITIONS for figure, aim in (("p99_ms", 40.0), ("drift_ms_a_minute", 1.0))
}

_TEXTS = (
    "Bob's big map, a pump, my poem: maybe Pam bumped a lamp by mishap.",
    "Round the rugged rock the ragged rascal ran, and on he went for ever.",
    "Papa may move above the moon, and Mama saw the boy bow to the baby.",
    "People jump over warm apples and a bowl of pure water from the pond.",
)
_INTERRUPTED = 3
"""One of so many speeches is interrupted by the next."""
_PAUSE = 0.4
"""Time between speeches, s."""
_VOICE = "en-us"
_AVATAR = "avatars/female.glb"

_STEP = 0.002
"""Distance of the positions at which the lip-sync is compared, s."""
_FURTHEST = 0.25
"""The greatest difference that is found, s."""
_ALIKE, _UNLIKE = 0.02, 0.12
"""Distances of weights: a position fits below the first, and is the only one if others are beyond the second."""
_ELSEWHERE = 0.06
"""Distance of other positions, s."""
_FADING = 0.13
"""Time after the start of a sound in which the mouth of an interrupted speech still fades, s."""

_XML = {"Content-Type": "application/xml"}
_WITH_SOUND = "--autoplay-policy=no-user-gesture-required"

_RECORDER = """
for (const draw of ["drawElements", "drawArrays"]) WebGL2RenderingContext.prototype[draw] = () => {};
window.notes = []; window.sounds = []; window.began = 0;
const begin = () => { requestAnimationFrame(begin); window.began = performance.now(); };
requestAnimationFrame(begin);  // before that of the page, so that the time of drawing does not count
const Context = window.AudioContext;
window.AudioContext = class extends Context { constructor(...given) { super(...given); window.context = this; } };
const {start, stop} = AudioBufferSourceNode.prototype;
AudioBufferSourceNode.prototype.start = function(at, offset) {
  this.sound = {begin: at - offset, at, duration: this.buffer.duration, until: Infinity};
  sounds.push(this.sound);
  start.call(this, at, offset);
};
AudioBufferSourceNode.prototype.stop = function(at = 0) {
  this.sound.until = Math.min(this.sound.until, Math.max(at, context.currentTime));
  stop.call(this, at);
};
"""
_RECORD = """
morphs => {
  const note = page => {
    requestAnimationFrame(note);
    const {contextTime, performanceTime} = context.getOutputTimestamp();
    const heard = contextTime + (began - performanceTime) / 1000;
    const drawn = (performance.now() - began) / 1000;
    notes.push([page / 1000, heard, context.currentTime - context.outputLatency - drawn,
      ...morphs.map(name => viewer.morph('alice', name))]);
  };
  requestAnimationFrame(note);
}
"""


class Recording(NamedTuple):
    """The notes that a page took of its mouth and its sounds.

    Attributes:
        notes: (N, 3 + M): page time, the audio time that is heard, the same by the reported latency, all in s; the
            weights of M morph targets.
        sounds: for each scheduled sound, the audio times at which it begins, enters and ends, and its duration, s.
    """

    notes: NDArray[np.float64]
    sounds: Sequence[Mapping[str, float]]


def measure(seconds: float = 180.0, browser: str | None = None) -> dict[str, object]:
    """The difference of the mouth from the sound, ms: positive where the mouth is ahead.

    `display_lag_p50_ms` is the time between two animation frames, after which a picture is on the screen.

    Args:
        seconds: duration of the speeches under each condition.
        browser: the path of a Chromium, by default the one on the PATH.
    """
    file = browser or shutil.which("chromium")
    if file is None:
        raise SystemExit("lipsync needs Chromium on the PATH")
    return {name: _measured(seconds, jitter, file) for name, jitter in _CONDITIONS.items()}


def _measured(seconds: float, jitter: float, browser: str) -> dict[str, object]:
    assets = Assets()
    binding = VisemeBinding.read((), Avatar.read(assets(_AVATAR)).morphs, assets)
    morphs = [morph for articulator in binding.articulators.values() for morph in articulator.morphs]
    utterances = asyncio.run(_utterances())
    with TemporaryDirectory() as folder:
        human = Path(folder, "human.toml")
        human.write_text(f'[character.alice]\navatar = "{_AVATAR}"\nvoice = "{_VOICE}"\n', encoding="utf-8")
        recording = run_punctually(_recorded(human, seconds, jitter, browser, morphs, utterances))
    tracks = [_weights(LipSyncTrack(each, binding), each.duration, morphs) for each in utterances]
    return _figures(recording, [each.duration for each in utterances], tracks)


async def _utterances() -> list[Utterance]:
    """Those of the texts, which are the same as the server's: espeak-ng is deterministic in its worker."""
    voice = EspeakVoice()
    await voice.start()
    try:
        return [await completed(voice.synthesize(text, (), _VOICE)) for text in _TEXTS]
    finally:
        await voice.close()


async def _recorded(
    human: Path, seconds: float, jitter: float, browser: str, morphs: Sequence[str], utterances: Sequence[Utterance]
) -> Recording:
    async with (
        served(human, "espeak") as (address, _),
        jittery(address, jitter) as far,
        async_playwright() as playwright,
    ):
        chromium = await playwright.chromium.launch(executable_path=browser, args=[*FLAGS, _WITH_SOUND])
        page = await chromium.new_page(viewport={"width": 900, "height": 500})
        await page.add_init_script(_RECORDER)
        await page.goto(f"{far}?quality=low")
        await page.wait_for_function(
            "() => viewer.connected && viewer.framesPlayed > 0 && viewer.morph('alice', 'jawOpen') !== null"
        )
        await page.evaluate(_RECORD, morphs)
        async with ClientSession() as session:
            await _speak(session, str(address / "bml"), seconds, utterances)
        notes = np.array(await page.evaluate("notes"), float)
        sounds = await page.evaluate("sounds.map(each => ({...each, until: Math.min(each.until, 1e9)}))")
        await chromium.close()
    return Recording(notes, sounds)


async def _speak(session: ClientSession, address: str, seconds: float, utterances: Sequence[Utterance]) -> None:
    loop = asyncio.get_running_loop()
    end = loop.time() + seconds
    for number in count():
        if loop.time() >= end:
            return
        text, utterance = _TEXTS[number % len(_TEXTS)], utterances[number % len(_TEXTS)]
        speech = f'<speech id="s"><text>{text}</text></speech>'
        async with session.post(
            address, data=block(f"b{number}", speech, composition="REPLACE"), headers=_XML
        ) as answer:
            answer.raise_for_status()
        cut = number % _INTERRUPTED == _INTERRUPTED - 1
        await asyncio.sleep(utterance.duration * (0.3 + 0.4 * (number % 7) / 6) if cut else utterance.duration + _PAUSE)


def _weights(track: LipSyncTrack, duration: float, morphs: Sequence[str]) -> NDArray[np.float64]:
    """The weights of morph targets at each step of an utterance, (K, M)."""
    shown = (track.weights(step * _STEP) for step in range(int(duration / _STEP)))
    return np.array([[weights.get(morph, 0.0) for morph in morphs] for weights in shown])


def _figures(
    recording: Recording, durations: Sequence[float], tracks: Sequence[NDArray[np.float64]]
) -> dict[str, object]:
    found = []
    for note in recording.notes:
        heard = note[1]
        for sound in recording.sounds:
            if (
                max(sound["begin"] + _FADING, sound["at"])
                <= heard
                < min(sound["until"], sound["begin"] + sound["duration"])
            ):
                track = tracks[int(np.argmin([abs(duration - sound["duration"]) for duration in durations]))]
                ahead = _ahead(note[3:], track, heard - sound["begin"])
                if ahead is not None:
                    found.append((note[0], ahead, note[2] - heard))
    times, ahead_s, latency = np.array(found).T
    intervals = np.diff(recording.notes[:, 0])
    slope = np.polyfit(times, ahead_s, 1)[0]
    return {
        "p50_ms": _ms(np.median(np.abs(ahead_s))),
        "p90_ms": _ms(np.percentile(np.abs(ahead_s), 90)),
        "p99_ms": _ms(np.percentile(np.abs(ahead_s), 99)),
        "median_ms": _ms(np.median(ahead_s)),
        "drift_ms_a_minute": round(float(abs(slope)) * 60e3, 2),
        "display_lag_p50_ms": _ms(np.median(intervals)),
        "display_lag_p99_ms": _ms(np.percentile(intervals, 99)),
        "latency_difference_ms": _ms(np.median(latency)),
        "frames": len(times),
        "sounds": len(recording.sounds),
    }


def _ahead(weights: NDArray[np.float64], track: NDArray[np.float64], position: float) -> float | None:
    """The lead of the mouth over a position in its utterance, s; None if its shape fits several positions, or none."""
    middle, reach = round(position / _STEP), round(_FURTHEST / _STEP)
    first = max(0, middle - reach)
    distances = np.abs(track[first : middle + reach + 1] - weights).max(1, initial=0.0)
    if len(distances) == 0:
        return None
    best = int(distances.argmin())
    others = np.delete(distances, slice(max(0, best - round(_ELSEWHERE / _STEP)), best + round(_ELSEWHERE / _STEP) + 1))
    if distances[best] > _ALIKE or others.min(initial=1.0) < _UNLIKE:
        return None
    return (first + best) * _STEP - position


def _ms(seconds: Any) -> float:
    return round(1000 * float(seconds), 1)
