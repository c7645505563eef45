"""Measures speech: the time from a text until its block is planned and its first sound is sent, live, for each voice.

Of a prepared speech, the time from its activation until its first sound is sent is measured.

The event loop is watched while speech is synthesized: what holds it up delays frames. Voices of Piper are measured if
the environment names one.
"""

import asyncio
import os
from collections.abc import Mapping
from statistics import median, quantiles
from time import perf_counter

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.clock.punctual_loop import run_punctually
from reactive_realizer.clock.ticker import Ticker
from reactive_realizer.embodiment.audio import AudioChange, AudioMove, AudioStart
from reactive_realizer.engines.speech.piper.voice import PLACE
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.pilot import block

AIMS = {
    "espeak.cold.11.plan_ms": 110.0,  # Elckerlyc took 110 to 220 ms (thesis 8.10)
    "kokoro.cold.5.first_audio_ms": 600.0,
    "kokoro.cold.11.first_audio_ms": 600.0,
    "kokoro.cold.60.first_audio_ms": 600.0,
    "kokoro.cached.60.first_audio_ms": 50.0,
    "kokoro.prepared.60.first_audio_ms": 50.0,
    "loop_lag_p99_ms": 5.0,
}

_VOICES = ("espeak", "kokoro")
_TEXTS = {
    "5": "The train leaves at {}.",
    "11": "Good evening, my train is late, and it leaves at {}.",
    "60": (
        "Good morning, everybody, it is {}, and the museum is open. We start our tour in the great old hall, where you "
        "can see the oldest paintings. After that, we walk through the garden to the new building, which shows the "
        "work of young artists from all over the world. Please stay close to me, and do not touch anything."
    ),
}
"""Texts by their number of words."""
_HOURS = ("one", "two", "four", "five", "six", "eight", "nine", "ten", "noon")
"""Words that make a text a new one."""
_WATCH = 0.001
"""Time between two looks at the event loop, s."""


def measure(runs: int = 3, texts: Mapping[str, str] = _TEXTS) -> dict[str, object]:
    """The median times for texts of 5, 11 and 60 words, ms, and the 99th percentile of the lag of the event loop, ms.

    Args:
        runs: how many texts of each length are spoken, at most 9.
        texts: by their number of words, each with a place for a word that makes it a new one.
    """
    lags: list[float] = []
    voices = (*_VOICES, "piper") if PLACE in os.environ else _VOICES
    measured = {voice: run_punctually(_measure(voice, texts, _HOURS[:runs], lags)) for voice in voices}
    return {**measured, "loop_lag_p99_ms": round(1000 * quantiles(lags, n=100)[98], 2)}


async def _measure(
    voice: str, texts: Mapping[str, str], hours: tuple[str, ...], lags: list[float]
) -> Mapping[str, object]:
    async with open_scene(SceneOptions(voice=voice)) as scene, asyncio.TaskGroup() as group:
        playing = group.create_task(_play(scene.realizer))
        cold, cached, prepared = {}, {}, {}
        for words, text in texts.items():
            times = [await _speak(scene.realizer, text.format(hour), lags) for hour in hours]
            again = [await _speak(scene.realizer, text.format(hours[-1]), lags) for _ in hours]
            activated = [await _activate(scene.realizer, text.format(hours[-1]), lags) for _ in hours]
            cold[words], cached[words], prepared[words] = _medians(times), _medians(again), _medians(activated)
        playing.cancel()
    return {"cold": cold, "cached": cached, "prepared": prepared}


async def _play(realizer: Realizer) -> None:
    async for tick in Ticker(SystemClock()).ticks():
        await realizer.step(tick)


async def _speak(realizer: Realizer, text: str, lags: list[float]) -> dict[str, float]:
    """Speaks a text in place of what is spoken, until all of it is made; the times of its plan and of its sound, s."""
    return await _timed(realizer, f"b{len(lags)}", _speech(text), lags, composition="REPLACE")


async def _activate(realizer: Realizer, text: str, lags: list[float]) -> dict[str, float]:
    """Prepares a text until all of it is made, and has it spoken; the times since its activation, s."""
    name = f"b{len(lags)}"
    realizer.put(BmlText(block("silence", composition="REPLACE")))
    await _timed(realizer, name, _speech(text), lags, "plan_ms", **{"bmla:preplan": "true"})
    return await _timed(realizer, f"b{len(lags)}", f'<bmla:activate id="a" target="{name}"/>', lags)


async def _timed(
    realizer: Realizer, name: str, behavior: str, lags: list[float], last: str = "first_audio_ms", **attributes: str
) -> dict[str, float]:
    """Has a behavior played until all of it is made; the times since it was sent, s.

    Args:
        realizer: of the scene.
        name: of its block: a new one.
        behavior: BML.
        lags: takes those of the event loop.
        last: the name of the last time that is waited for.
        attributes: of the block.
    """
    seen: dict[str, float] = {}

    def hear(change: AudioChange) -> None:
        # Clients have the sound of a prepared speech already, and are told when it starts.
        starts = isinstance(change, AudioMove) or (isinstance(change, AudioStart) and change.start is not None)
        if starts and "plan_ms" in seen:  # not the end of the speech before
            seen.setdefault("first_audio_ms", perf_counter())

    def note(*_: object) -> None:
        seen.setdefault("plan_ms", perf_counter())

    realizer.hear(hear)
    realizer.scheduler.listen_to_plans(note)
    begin = perf_counter()
    realizer.put(BmlText(block(name, behavior, **attributes)))
    while last not in seen or realizer.busy:
        looked = perf_counter()
        await asyncio.sleep(_WATCH)
        lags.append(perf_counter() - looked - _WATCH)
    return {name: time - begin for name, time in seen.items()}


def _speech(text: str) -> str:
    return f'<speech id="s"><text>{text}</text></speech>'


def _medians(runs: list[dict[str, float]]) -> dict[str, float]:
    return {name: round(1000 * median(run[name] for run in runs), 1) for name in ("first_audio_ms", "plan_ms")}
