"""Joints become physical and kinematic again at any time, without jumps (thesis 4.2.4 and 8.7.5)."""

import math
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, angle, difference, from_rotation_vector, rotation_vector
from reactive_realizer.engines.animation.physical_figure import PhysicalFigure
from reactive_realizer.physics.controllers.controller import PhysicalController, RagdollController

FRAME = 0.02
AVATAR = Avatar.read(Path(str(files("reactive_realizer"))) / "assets/avatars/female.glb")
LIMBS = {
    "left arm": ("l_shoulder", "l_elbow", "l_wrist"),
    "right arm": ("r_shoulder", "r_elbow", "r_wrist"),
    "left forearm": ("l_elbow", "l_wrist"),
    "head": ("skullbase",),
}
MOST = 1.6
"""Change of the speed of a joint that gravity and the swing cause within a frame, rad/s."""

JOINTS = ("l_shoulder", "l_elbow", "r_shoulder", "r_elbow", "skullbase")
"""Wrists are not measured: they are light, and soon at their limits."""


def swinging(time: float) -> dict[str, Quat]:
    """Arms and a head that move."""
    forth = math.sin(2.0 * math.pi * time)
    return {
        **{f"{side}_shoulder": from_rotation_vector((-0.5 + 0.5 * forth, 0.0, 0.0)) for side in "lr"},
        **{f"{side}_elbow": from_rotation_vector((-1.9 - 0.2 * forth, 0.0, 0.0)) for side in "lr"},
        "skullbase": from_rotation_vector((0.1 * forth, 0.2 * forth, 0.0)),
    }


class Session:
    """A figure that swings its arms, frame by frame; the speed of each joint in each frame."""

    def __init__(self) -> None:
        self.humanoid = Humanoid(AVATAR)
        self.figure = PhysicalFigure(self.humanoid)
        self.speeds: list[np.ndarray] = []
        self.frames = 0

    def show(self, controllers: list[PhysicalController], claimed: set[str]) -> None:
        time = GlobalTime(self.frames * FRAME)
        before = self.humanoid.shown
        dynamics = self.figure.dynamics(controllers, claimed)
        self.humanoid.move(time, [Layer(LayerKind.GESTURE, swinging(time))])
        if dynamics is not None:
            self.humanoid.simulate(dynamics)
        self.humanoid.look(None, ())
        after = self.humanoid.shown
        turns = [rotation_vector(difference(before.rotation(joint), after.rotation(joint))) for joint in JOINTS]
        self.speeds.append(np.array(turns) / FRAME)
        self.frames += 1

    def jump(self, frame: int) -> float:
        """The greatest change of the speed of a joint in a frame and the next one, rad/s."""
        return float(np.abs(np.diff(self.speeds[frame - 1 : frame + 2], axis=0)).max())


SWITCHES = st.lists(
    st.tuples(st.integers(2, 6), st.sets(st.sampled_from(sorted(LIMBS))), st.sets(st.sampled_from(sorted(LIMBS)))),
    min_size=2,
    max_size=4,
)


@settings(max_examples=15, deadline=None)
@given(switches=SWITCHES)
def test_limbs_that_become_loose_or_are_claimed_at_any_time_keep_their_speed(
    switches: list[tuple[int, set[str], set[str]]],
) -> None:
    session, changes = Session(), []
    for _ in range(5):
        session.show([], set())
    for frames, loose, claimed in switches:
        joints = {joint for limb in loose for joint in LIMBS[limb]}
        controllers: list[PhysicalController] = [RagdollController(joints)] if joints else []
        changes.append(session.frames)
        for _ in range(frames):
            session.show(controllers, {joint for limb in claimed for joint in LIMBS[limb]})
    assert max(map(session.jump, changes)) < MOST


def test_joints_return_to_their_animation_and_the_simulation_ends() -> None:
    session = Session()
    for number in range(100):
        session.show([RagdollController(LIMBS["left arm"])] if 10 < number < 50 else [], set())
    shown, animated = session.humanoid.shown, Body(AVATAR.skeleton, swinging((session.frames - 1) * FRAME))
    assert not session.figure.active
    assert shown.transform("l_wrist").position == pytest.approx(animated.transform("l_wrist").position, abs=1e-6)


def test_claimed_joints_of_a_controller_follow_their_animation() -> None:
    session = Session()
    for _ in range(50):
        session.show([RagdollController((*LIMBS["left arm"], *LIMBS["right arm"]))], set(LIMBS["right arm"]))
    animated = swinging((session.frames - 1) * FRAME)
    shown = session.humanoid.shown
    assert rotation_vector(difference(shown.rotation("r_elbow"), animated["r_elbow"])) == pytest.approx((0, 0, 0))
    assert max(map(abs, rotation_vector(difference(shown.rotation("l_elbow"), animated["l_elbow"])))) > 0.2


def test_the_steps_of_the_simulation_are_those_of_the_figure() -> None:
    def swung(steps: int | None) -> Body:
        session = Session()
        session.humanoid = Humanoid(AVATAR, simulation_steps=steps)
        session.figure = PhysicalFigure(session.humanoid)
        for _ in range(20):
            session.show([RagdollController(LIMBS["left arm"])], set())
        return session.humanoid.shown

    usual, same, coarse = (swung(steps).rotation("l_elbow") for steps in (None, 4, 2))
    assert usual == same
    assert 1e-6 < angle(difference(usual, coarse)) < 0.1
