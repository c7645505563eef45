"""Conducting patterns: the positions of the hand at the beats, as in textbooks."""

import numpy as np
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

UP = 1
SIDES = {"LEFT_HAND": ("l_wrist", 1.0), "RIGHT_HAND": ("r_wrist", -1.0)}
"""Wrist, and the sign of x away from the body's middle."""


async def conduct(pilot: RealizerPilot, beats: int, mode: str, bars: int = 2) -> tuple[np.ndarray, np.ndarray]:
    """Times, and the way of the wrist, outward, up, forward, (F, 3), m, while bar after bar is conducted."""
    bar = '<bmlt:procanimation id="b{i}" name="conduct-{beats}-beat" mode="{mode}" start="{start}" end="{end}"/>'
    pilot.block("c", "".join(bar.format(i=i, beats=beats, mode=mode, start=2 * i, end=2 * i + 2) for i in range(bars)))
    await pilot.advance(2.0 * bars + 1.0)
    assert pilot.feedback.warnings == []
    wrist, outward = SIDES[mode]
    return np.array([frame.time for frame in pilot.frames["alice"]]), pilot.path(wrist) * (outward, 1.0, 1.0)


@pytest.mark.parametrize("mode", SIDES)
@pytest.mark.parametrize("beats", [1, 2, 3, 4])
async def test_the_hand_reverses_downward_motion_at_each_beat(still: RealizerPilot, beats: int, mode: str) -> None:
    times, path = await conduct(still, beats, mode)
    for beat in range(1, beats + 1):
        time = still.feedback.time(f"c:b1:beat{beat}")
        assert time == pytest.approx(2.0 + 2.0 * (beat - 1) / beats, abs=0.001)
        at, before, after = (path[np.searchsorted(times, t)][UP] for t in (time, time - 0.14, time + 0.14))
        assert at < before, f"beat {beat}"
        assert at < after, f"beat {beat}"


@pytest.mark.parametrize("mode", SIDES)
async def test_four_beats_are_down_in_out_and_center(still: RealizerPilot, mode: str) -> None:
    times, path = await conduct(still, 4, mode)
    out = [path[np.searchsorted(times, still.feedback.time(f"c:b1:beat{i}"))][0] for i in (1, 2, 3, 4)]
    assert out[1] < out[0] - 0.05
    assert out[2] > out[0] + 0.08
    assert out[0] < out[3] < out[2]


async def test_the_highest_point_is_before_the_first_beat(still: RealizerPilot) -> None:
    times, path = await conduct(still, 3, "RIGHT_HAND")
    second = (times > 2.0) & (times < 4.0)
    assert 3.5 < times[second][path[second][:, UP].argmax()] < 3.85


async def test_bars_follow_each_other_without_a_pause_or_a_jump(still: RealizerPilot) -> None:
    times, path = await conduct(still, 3, "RIGHT_HAND", bars=3)
    first, second = (path[(times >= start) & (times < start + 1.99)] for start in (2.0, 4.0))
    np.testing.assert_allclose(first[10:-10], second[10:-10], atol=0.01)


async def test_size_and_place_are_parameters(still: RealizerPilot) -> None:
    behavior = """<bmlt:procanimation id="{id}" name="conduct-1-beat" mode="RIGHT_HAND" start="{start}" end="{end}">
      <bmlt:parameter name="a" value="{a}"/><bmlt:parameter name="yoff" value="{yoff}"/></bmlt:procanimation>"""
    variants = {"small": (0.35, 0.0), "big": (0.7, 0.0), "high": (0.35, 0.08)}
    still.block(
        "c",
        "".join(
            behavior.format(id=id_, start=3 * i, end=3 * i + 2, a=a, yoff=yoff)
            for i, (id_, (a, yoff)) in enumerate(variants.items())
        ),
    )
    await still.advance(10)
    assert still.feedback.warnings == []
    times, heights = np.array([frame.time for frame in still.frames["alice"]]), still.path("r_wrist")[:, UP]
    small, big, high = (heights[(times > 3 * i + 0.7) & (times < 3 * i + 1.5)] for i in range(3))
    assert np.ptp(big) == pytest.approx(2 * np.ptp(small), rel=0.15)
    assert high.max() - small.max() == pytest.approx(0.08, abs=0.01)
