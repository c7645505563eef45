"""Scheduling strategies by name."""

import pytest

from reactive_realizer.assembly.registry import names
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot

AFTER = """
    <wait id="a" duration="0.5"/><wait id="b" duration="0.5" start="c:end"/><wait id="c" duration="0.1"/>
    <constraint><after ref="a:end"><sync ref="b:start"/></after></constraint>
"""


def test_the_built_in_strategies_are_found_by_name() -> None:
    assert {"convex", "embr", "smartbody"} <= set(names("strategies"))


@pytest.mark.parametrize(("strategy", "warnings", "start"), [("convex", 0, 0.5), ("smartbody", 1, 0.1)])
async def test_a_scene_uses_the_chosen_strategy(strategy: str, warnings: int, start: float) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        pilot.block("x", AFTER)
        await pilot.advance(2)
        assert len(pilot.feedback.warnings) == warnings
        assert pilot.feedback.time("x:b:start") == start


def test_convex_is_the_default() -> None:
    assert SceneOptions().strategy == "convex"


async def test_the_error_of_an_unknown_strategy_lists_the_known_ones() -> None:
    with pytest.raises(
        RealizerError, match="the plug-in group strategies has no 'best'; available: convex, embr, smartbody"
    ):
        async with open_pilot(SceneOptions(voice="text", strategy="best")):
            pass
