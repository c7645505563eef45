"""The mouth in the page moves with the sound, also when the socket has jitter.

The machine of a test may be busy with others, so most differences are compared here, and the largest ones, and the
drift, by `python -m benchmarks lipsync`.
"""

import asyncio
import importlib
from pathlib import Path

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.speech, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[2]
SECONDS = 15
"""Duration of the speeches under each of two conditions."""


async def test_the_mouth_is_with_the_sound_through_interruptions_and_jitter(
    chromium: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(ROOT)
    lipsync = importlib.import_module("benchmarks.lipsync")
    measured = await asyncio.to_thread(lipsync.measure, SECONDS, chromium)
    assert all(figure in measured[condition] for condition, figure in (aim.split(".") for aim in lipsync.AIMS))
    for condition in ("near", "jitter"):
        figures = measured[condition]
        assert figures["frames"] > 25, measured
        assert figures["p90_ms"] < 40, measured
