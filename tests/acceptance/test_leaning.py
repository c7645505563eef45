"""The trunk leans for hands whose arms alone do not reach their goals (EMBR: inverse kinematics with the spine)."""

import math

import numpy as np
import pytest

from reactive_realizer.bml.names import BML
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, rotation_vector
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, distance, scale, subtract, unit
from reactive_realizer.engines.animation.spine_ik import SPINE_RANGES
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""

_SPACES = f'xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1"'
_GROUPS = {"l": "LEFT_ARM", "r": "RIGHT_ARM"}
_BREATH = math.radians(2.0)
"""Idle animation turns trunk and head, rad."""


def reached(pilot: RealizerPilot) -> Body:
    return pilot.bodies()[-1]


def beyond(body: Body, side: str, way: Vec3, far: float) -> Vec3:
    """A place a distance beyond the reach of an arm of an upright figure."""
    return add(body.transform(f"{side}_shoulder").position, scale(unit(way), Arm.of(body.skeleton, side).reach + far))


def from_pelvis(body: Body, place: Vec3) -> Vec3:
    return subtract(place, body.transform("HumanoidRoot").position)


def key_pose(side: str, target: Vec3, time: float = 1.2) -> str:
    where = f'<rr:position target="{target[0]} {target[1]} {target[2]}"/>'
    pose = f'<rr:keyPose time="{time}" hold="1">{where}</rr:keyPose>'
    return f'<rr:keyPoses id="{side}" group="{_GROUPS[side]}" fadeOut="1.2">{pose}</rr:keyPoses>'


def turned(first: Body, second: Body, joint: str) -> float:
    """The angle between two directions of a joint in space, rad."""
    return angle(difference(first.transform(joint).rotation, second.transform(joint).rotation))


def missed(bodies: list[Body], side: str, target: Vec3) -> float:
    """The greatest distance of a wrist from its target, m."""
    return max(distance(from_pelvis(each, each.transform(f"{side}_wrist").position), target) for each in bodies)


@pytest.mark.parametrize("side", ["l", "r"])
@pytest.mark.parametrize("way", [(0.0, 0.0, 1.0), (0.3, -0.6, 1.0), (-0.3, -0.3, 1.0)])
@pytest.mark.parametrize("far", [0.1, 0.25])
async def test_a_hand_is_at_a_place_beyond_its_arm_and_the_trunk_comes_back(side: str, way: Vec3, far: float) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        upright = reached(pilot)
        target = from_pelvis(upright, beyond(upright, side, way, far))
        pilot.perform(f'<bml {_SPACES} id="b">{key_pose(side, target)}</bml>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == []
        bodies = pilot.bodies()
        there = bodies[round(1.34 * FRAMES) : round(2.28 * FRAMES)]
        assert missed(there, side, target) < 0.01
        for body in bodies:
            for joint, ranges in SPINE_RANGES.items():
                for value, (low, high) in zip(rotation_vector(body.rotation(joint)), ranges, strict=True):
                    assert low - _BREATH < value < high + _BREATH
            assert turned(upright, body, "skullbase") < 2 * _BREATH
            for foot in ("l_ankle", "r_ankle"):
                assert distance(body.transform(foot).position, upright.transform(foot).position) < 0.002
        assert turned(upright, there[0], "vt6") > math.radians(10.0)
        assert turned(upright, bodies[-1], "vt6") < _BREATH


async def test_a_leaning_figure_keeps_the_laws_of_motion() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        upright = reached(pilot)
        target = from_pelvis(upright, beyond(upright, "r", (0.0, 0.0, 1.0), 0.25))
        near = from_pelvis(upright, beyond(upright, "r", (0.0, -0.5, 1.0), -0.2))
        pilot.perform(f'<bml {_SPACES} id="b">{key_pose("r", target)}</bml>')
        await pilot.advance(1.9)
        # Another motion takes the arm over while the trunk leans.
        pilot.perform(f'<bml {_SPACES} id="c">{key_pose("r", near)}</bml>')
        await pilot.advance(4)
        for joint, speed, acceleration in (("r_wrist", 2.41, 60.0), ("skullbase", 2.0, 40.0)):
            path = pilot.path(joint)
            assert FRAMES * np.linalg.norm(np.diff(path, axis=0), axis=1).max() < speed
            assert FRAMES**2 * np.linalg.norm(np.diff(path, 2, axis=0), axis=1).max() < acceleration
        turns = np.array([rotation_vector(body.rotation("vl5")) for body in pilot.bodies()])
        assert FRAMES**2 * np.linalg.norm(np.diff(turns, 2, axis=0), axis=1).max() < 100.0


async def test_a_figure_whose_arm_reaches_does_not_lean() -> None:
    turns = []
    for far in (-0.02, 0.1):
        async with open_pilot() as pilot:
            pilot.watch()
            await pilot.advance(0.1)
            upright = reached(pilot)
            target = from_pelvis(upright, beyond(upright, "r", (0.0, 0.0, 1.0), far))
            pilot.perform(f'<bml {_SPACES} id="b">{key_pose("r", target)}</bml>')
            await pilot.advance(3)
            turns.append(max(turned(upright, body, "vt6") for body in pilot.bodies()))
    assert turns[0] < _BREATH
    assert turns[1] > math.radians(10.0)


async def test_both_hands_reach_out_at_once() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        upright = reached(pilot)
        targets = {side: from_pelvis(upright, beyond(upright, side, (0.0, -0.3, 1.0), 0.12)) for side in "lr"}
        arms = "".join(key_pose(side, target) for side, target in targets.items())
        pilot.perform(f'<bml {_SPACES} id="b">{arms}</bml>')
        await pilot.advance(3)
        there = pilot.bodies()[round(1.34 * FRAMES) : round(2.28 * FRAMES)]
        for side, target in targets.items():
            assert missed(there, side, target) < 0.01


async def test_a_trunk_does_not_lean_for_a_place_that_stays_far_out_of_reach_and_a_warning_names_it() -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        upright = reached(pilot)
        target = from_pelvis(upright, beyond(upright, "r", (0.0, 0.0, 1.0), 0.8))
        pilot.perform(f'<bml {_SPACES} id="b">{key_pose("r", target)}</bml>')
        await pilot.advance(3)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "r_wrist cannot reach its goal" in warning.text
        assert max(turned(upright, body, "vt6") for body in pilot.bodies()) < _BREATH


@pytest.mark.parametrize(("far", "reaches"), [(0.15, True), (0.7, False)])
async def test_a_hand_that_touches_something_a_little_too_far_away_leans_the_trunk(far: float, reaches: bool) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        await pilot.advance(0.1)
        upright = reached(pilot)
        pilot.move("bluebox", beyond(upright, "r", (0.1, -0.3, 1.0), 0.17 + far))  # a hand is 17 cm long
        touch = '<pointing id="p" target="bluebox" mode="RIGHT_HAND" rr:reach="TOUCH" start="0.2"/>'
        pilot.perform(f'<bml {_SPACES} id="b">{touch}</bml>')
        await pilot.advance(4)
        assert (pilot.feedback.warnings == []) == reaches
        ready, relax = (round(FRAMES * pilot.feedback.time(f"b:p:{sync}")) for sync in ("ready", "relax"))
        bodies = pilot.bodies()
        leans = [turned(upright, body, "vt6") for body in bodies]
        assert (min(leans[ready + 1 : relax]) > math.radians(15.0)) == reaches
        assert leans[-1] < 2 * _BREATH
