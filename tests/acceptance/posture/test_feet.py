"""Feet in frames: they stand still, or step."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.testing.pilot import RealizerPilot

from .soles import FRAME, flat, heights, planted, slides
from .standing import FEET, SIT, sits

STANCES = {
    "STANDING": '<stance type="STANDING"/><pose part="LEGS" lexeme="LEGS_NEUTRAL"/>',
    "SITTING": '<stance type="SITTING"/><pose part="LEGS" lexeme="LEGS_NEUTRAL"/>',
    "CROUCHING": '<stance type="CROUCHING"/>',
    "LYING": '<stance type="LYING"/>',
    "STANDING OPEN": '<stance type="STANDING"/><pose part="LEGS" lexeme="LEGS_OPEN"/>',
    "STANDING CROSSED": '<stance type="STANDING"/><pose part="LEGS" lexeme="LEGS_CROSSED"/>',
    "SITTING CROSSED": '<stance type="SITTING"/><pose part="LEGS" lexeme="LEGS_CROSSED"/>',
}


def shift(stance: str) -> str:
    return f'<postureShift id="s">{STANCES[stance]}</postureShift>'


# --- they stay


async def test_the_feet_stay_in_place_while_a_figure_sits_down_and_gets_up(either: RealizerPilot) -> None:
    either.block("b", f'<posture id="p" start="0.5">{SIT}</posture>')
    await either.advance(10)
    assert any(map(sits, either.bodies()))
    assert planted(either.bodies()) < 0.003
    assert flat(either.bodies()) < 0.5


async def test_the_feet_stay_in_place_when_sitting_down_is_interrupted(either: RealizerPilot) -> None:
    either.block("a", f'<postureShift id="s">{SIT}</postureShift>')
    await either.advance(0.9)
    either.block("b", composition="REPLACE")
    await either.advance(3)
    assert planted(either.bodies()) < 0.003


async def test_the_feet_stay_in_place_during_weight_shifts(either: RealizerPilot) -> None:
    await either.advance(35)
    pelvis = [body.root[0] for body in either.bodies()]
    assert max(pelvis) - min(pelvis) > 0.02
    assert planted(either.bodies()) < 0.003
    assert flat(either.bodies()) < 0.5


def stir(joint: str) -> str:
    """Noise about every axis of a joint, for 3 s."""
    values = "".join(f'<bmlt:parameter name="baseamplitude{axis}" value="0.15"/>' for axis in "xyz")
    return f'<bmlt:noise id="n" type="perlin" joint="{joint}" start="0" end="3">{values}</bmlt:noise>'


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "SITTING CROSSED"])
async def test_the_feet_stay_in_place_under_additive_motion_of_pelvis_and_legs(
    alternating: RealizerPilot, stance: str, subtests: pytest.Subtests
) -> None:
    alternating.block("a", shift(stance))
    await alternating.advance(2.9)
    for joint in ("HumanoidRoot", "l_hip", "l_knee", "l_ankle"):
        with subtests.test(joint):
            before = len(alternating.bodies())
            alternating.block(f"b-{joint}", stir(joint))
            await alternating.advance(3.5)
            shown = alternating.bodies()[before:]
            assert planted(shown) < 0.003
            assert np.ptp([body.rotation("l_ankle") for body in shown], axis=0).max() < 0.3


async def test_additive_motion_of_a_leg_is_visible_at_its_knee(either: RealizerPilot) -> None:
    await either.advance(3)
    either.block("b", stir("l_knee"))
    await either.advance(4)
    left, right = (np.ptp(either.path(f"{side}_knee")[:700], axis=0).max() for side in "lr")
    assert left > right + 0.01


# --- they step


CHANGES = [
    ("STANDING", "STANDING CROSSED", "STANDING OPEN", "SITTING", "SITTING CROSSED", "STANDING", "LYING"),
    ("LYING", "SITTING", "CROUCHING", "STANDING", "STANDING OPEN", "STANDING", "CROUCHING"),
]
"""Stances, each after the one before it."""


def hurries(bodies: list[Body]) -> Iterator[float]:
    """The largest angular acceleration of each knee, rad/s^2."""
    for knee in ("l_knee", "r_knee"):
        bends = [angle(body.rotation(knee)) for body in bodies]
        yield np.abs(np.diff(bends, n=2)).max() / FRAME**2


LARGEST = 120.0
"""rad/s^2 of a knee: a third of the value of a knee that locks at full stretch."""


@pytest.mark.parametrize("stances", CHANGES, ids=", ".join)
async def test_a_foot_steps_through_the_air_and_no_knee_locks_or_unlocks_abruptly(
    alternating: RealizerPilot, stances: tuple[str, ...], subtests: pytest.Subtests
) -> None:
    """The thresholds are our choice: see `engines/animation/posture/stepping.py` and `foot_planting.py`."""
    alternating.block("b0", shift(stances[0]))
    await alternating.advance(4)
    for number, (before, after) in enumerate(pairwise(stances), start=1):
        with subtests.test(f"{before} to {after}"):
            first = len(alternating.bodies()) - 5
            alternating.block(f"b{number}", shift(after))
            await alternating.advance(4)
            shown = alternating.bodies()[first:]
            assert slides(shown).max() < 0.03
            assert slides(shown).sum(axis=0).max() * FRAME < 0.002
            high = heights(shown)
            assert high.min() > -0.001
            assert high.min(axis=1).max() < 0.001 or "LYING" in (before, after), "one foot at a time"
            for foot, name in enumerate(FEET):
                x, _, z = np.subtract(shown[-1].transform(name).position, shown[0].transform(name).position)
                lifted = high[:, foot].max() - max(high[0, foot], high[-1, foot])
                assert lifted > 0.03 or np.hypot(x, z) < 0.01
            assert max(hurries(shown)) < LARGEST


async def test_a_foot_leaves_and_touches_the_ground_gently(either: RealizerPilot) -> None:
    either.block("b", shift("STANDING CROSSED"))
    await either.advance(3)
    climbs = np.abs(np.diff(heights(either.bodies()), axis=0)) / FRAME
    setting_out = [next(speed for speed in foot if speed > 0.01) for foot in (*climbs.T, *climbs[::-1].T)]
    assert max(setting_out) < 0.4 * climbs.max()
    assert climbs.max() < 0.8


async def test_a_change_of_stance_during_another_does_not_slide(either: RealizerPilot) -> None:
    for after in ("STANDING OPEN", "STANDING CROSSED", "CROUCHING", "STANDING"):
        either.block(after.lower().replace(" ", ""), shift(after), composition="REPLACE")
        await either.advance(0.6)
    await either.advance(4)
    assert slides(either.bodies()).max() < 0.05
    assert heights(either.bodies()).min() > -0.001


OVERLAPS = [
    ("CROUCHING", "SITTING CROSSED", "SITTING", 1.0),
    ("SITTING CROSSED", "STANDING OPEN", "CROUCHING", 0.8),
    ("STANDING OPEN", "STANDING CROSSED", "STANDING", 0.8),
    ("CROUCHING", "STANDING OPEN", "STANDING", 0.2),
    ("CROUCHING", "STANDING", "SITTING", 1.0),
]


@pytest.mark.parametrize("composition", ["MERGE", "REPLACE"])
@pytest.mark.parametrize(("before", "between", "after", "passed"), OVERLAPS)
async def test_a_change_of_stance_that_begins_during_another_leaves_one_foot_on_the_ground(
    alternating: RealizerPilot, before: str, between: str, after: str, passed: float, composition: str
) -> None:
    """The thresholds are our choice: see `engines/animation/posture/stepping.py`."""
    alternating.block("a", shift(before))
    await alternating.advance(3)
    alternating.block("b", shift(between), composition=composition)
    await alternating.advance(passed)
    alternating.block("c", shift(after), composition=composition)
    await alternating.advance(3.5)
    shown = alternating.bodies()[145:]
    assert heights(shown).min(axis=1).max() < 0.006
    assert heights(shown).max() > 0.03, "no foot stepped"
    assert slides(shown).max() < 0.05
    assert max(hurries(shown)) < 2.0 * LARGEST
