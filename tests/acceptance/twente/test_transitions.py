"""Transitions in BML (thesis 4.2.4, C.1.6)."""

import numpy as np
import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .motions import ARM, angles


def transition(kind: str) -> str:
    return f"""
        <bmlt:procanimation id="a" name="swing" start="0" end="1.6"/>
        <bmlt:transition id="t" class="{kind}" start="a:end" end="3">{ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
    """


@pytest.mark.parametrize(
    "kind", ["SlerpTransition", "HermiteTransition", "hmi.animation.transitions.HermiteTransitionMU"]
)
@pytest.mark.parametrize("joint", ["r_shoulder", "r_elbow"])
async def test_a_transition_leads_from_the_last_pose_of_one_motion_to_the_first_of_the_next(
    pilot: RealizerPilot, kind: str, joint: str
) -> None:
    pilot.block("b", transition(kind))
    await pilot.advance(3.2)
    assert not pilot.feedback.warnings
    turns = angles(pilot, joint)
    steps = np.abs(np.diff(list(turns.values())))
    assert steps.max() < 0.1  # a joint that jumped would take more than 5 rad/s
    assert turns[3.0] == pytest.approx(-0.6 if joint == "r_shoulder" else -0.4, abs=0.01)


@pytest.mark.parametrize("joint", ["r_shoulder", "r_elbow"])
async def test_a_hermite_transition_has_the_velocities_of_the_motions_around_it(
    pilot: RealizerPilot, joint: str
) -> None:
    """Thesis 4.2.4: continuous in rotation and angular velocity, as frames show it."""
    pilot.block("b", transition("HermiteTransition"))
    await pilot.advance(4)
    turns = angles(pilot, joint)
    times = np.array(list(turns))
    speeds = np.diff(list(turns.values())) / np.diff(times)
    changes = np.abs(np.diff(speeds))[(times[1:-1] > 1.3) & (times[1:-1] < 3.3)]
    # rad/s from frame to frame; the speeds at the ends are near 2 and 1.6 rad/s. The hand slides along the thigh, too.
    assert changes.max() < 1.0


async def test_a_transition_does_not_delay_the_next_motion(pilot: RealizerPilot) -> None:
    """What is left of a transition lies below, also where a clip follows."""
    pilot.block(
        "b",
        f"""
        <bmlt:procanimation id="a" name="swing" start="0" end="1.6"/>
        <bmlt:transition id="t" class="HermiteTransition" start="a:end" end="3">{ARM}</bmlt:transition>
        <bmlt:keyframe id="k" name="wave" start="t:end"/>
        """,
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    # The hand begins in the thigh, out of which it is kept.
    assert [turns[3.0 + time] for time in (0.0, 0.1, 0.2, 0.5)] == pytest.approx([0.0, -0.08, -0.16, -0.4], abs=0.09)


async def test_a_slerp_transition_starts_and_ends_at_rest(pilot: RealizerPilot) -> None:
    pilot.block("b", transition("SlerpTransition"))
    await pilot.advance(4)
    turns = angles(pilot, "r_shoulder")
    assert turns[1.64] == pytest.approx(turns[1.6], abs=0.005)
    assert turns[3.0] == pytest.approx(turns[2.96], abs=0.02)


async def test_a_transition_without_a_next_motion_leads_to_rest(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        f'<bmlt:procanimation id="a" name="swing" start="0" end="1.5"/>'
        f'<bmlt:transition id="t" class="SlerpTransition" start="a:end">{ARM}</bmlt:transition>',
    )
    await pilot.advance(4)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    end = round(pilot.feedback.time("b:t:end"), 2)
    assert turns[end] == pytest.approx(turns[3.9], abs=0.03)


async def test_a_transition_leads_to_the_posture_at_its_end(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        f"""
        <posture id="p" start="0" ready="2" relax="5"><pose part="ARMS" lexeme="ARMS_CROSSED"/></posture>
        <bmlt:transition id="t" class="SlerpTransition" start="3" end="4">{ARM}</bmlt:transition>
        """,
    )
    await pilot.advance(4.5)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_elbow")
    assert abs(turns[2.9] - turns[0.0]) > 0.5
    assert turns[3.98] == pytest.approx(turns[2.9], abs=0.02)


async def test_a_transition_slows_down_if_its_end_is_delayed(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block(
        "b",
        f"""
        <bmlt:transition id="t" class="HermiteTransition" start="1" end="anticipators:partner:hit">
          {ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
        """,
    )
    await pilot.advance(1.5)
    pilot.predict("partner", "hit", 3.0)
    await pilot.advance(2)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    assert turns[3.0] == pytest.approx(-0.6, abs=0.02)
    assert np.abs(np.diff(list(turns.values()))).max() < 0.09


async def test_a_transition_with_an_unknown_end_waits(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "hit", 2.0)
    pilot.block(
        "b",
        f"""
        <bmlt:transition id="t" class="SlerpTransition" start="1" end="anticipators:partner:hit">{ARM}</bmlt:transition>
        <bmlt:procanimation id="c" name="swing" start="t:end"/>
        """,
    )
    await pilot.advance(0.5)
    pilot.predict("partner", "hit", None)
    await pilot.advance(1.5)
    pilot.predict("partner", "hit", 2.8)
    await pilot.advance(1.5)
    assert not pilot.feedback.warnings
    turns = angles(pilot, "r_shoulder")
    assert turns[1.9] == pytest.approx(turns[1.1], abs=0.01)
    assert turns[2.8] == pytest.approx(-0.6, abs=0.02)
    assert np.abs(np.diff(list(turns.values()))).max() < 0.09


async def test_a_transition_may_describe_a_gesture_and_then_has_its_points(pilot: RealizerPilot) -> None:
    described = (
        '<gesture id="g" lexeme="BEAT" start="0.2" end="1.5"><description priority="1" type="transition">'
        '<bmlt:transition class="SlerpTransition"/></description></gesture>'
    )
    pilot.block("b", described)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:start") == 0.2
    assert pilot.feedback.time("b:g:end") == 1.5
    assert pilot.feedback.warnings == []
