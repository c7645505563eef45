"""Properties of every animation file of the package, on every avatar."""

import math
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import load_animation

ASSETS = Path(__file__).resolve().parents[2] / "reactive_realizer" / "assets"
FOLDER = ASSETS / "procanimation"
FILES = {path.relative_to(FOLDER).as_posix(): path for path in sorted(FOLDER.rglob("*.xml"))}
SKELETONS = {name: Avatar.read(ASSETS / "avatars" / f"{name}.glb").skeleton for name in ("female", "male")}

PAIRS = [
    *((f"greta/beat{i}right_norest.xml", f"greta/beat{i}left_norest.xml") for i in (1, 2, 3, 4)),
    *((f"conductor/{i}-beat_pattern_RH.xml", f"conductor/{i}-beat_pattern_LH.xml") for i in (1, 2, 3, 4)),
    ("conductor/Stop_Playing_RH.xml", "conductor/Stop_Playing_LH.xml"),
]


@pytest.fixture(params=SKELETONS)
def skeleton(request: pytest.FixtureRequest) -> Skeleton:
    return SKELETONS[request.param]


def bodies(animation: ProceduralAnimation, skeleton: Skeleton) -> list[Body]:
    """The bodies at 41 phases, with the parameters of the file."""
    stand, values = Body(skeleton), animation.values({})
    return [stand.posed(animation.sample(i / 40, values, stand).rotations) for i in range(41)]


def rotations(animation: ProceduralAnimation, skeleton: Skeleton) -> np.ndarray:
    return np.array([[body.rotation(joint) for joint in skeleton.joints] for body in bodies(animation, skeleton)])


def test_an_animation_has_a_pose_at_every_phase(skeleton: Skeleton, subtests: pytest.Subtests) -> None:
    for file in FILES:
        with subtests.test(file):
            poses = rotations(load_animation(FILES[file], skeleton), skeleton)
            np.testing.assert_allclose(np.linalg.norm(poses, axis=-1), 1.0, atol=1e-9)


def test_no_arm_is_fully_stretched_or_folded(skeleton: Skeleton, subtests: pytest.Subtests) -> None:
    for file in FILES:
        with subtests.test(file):
            animation = load_animation(FILES[file], skeleton)
            for side in "lr":
                if f"{side}_elbow" in animation.joints:
                    spans = [
                        distance(b.transform(f"{side}_shoulder").position, b.transform(f"{side}_wrist").position)
                        for b in bodies(animation, skeleton)
                    ]
                    length = math.dist(skeleton.offset(f"{side}_elbow"), (0, 0, 0)) + math.dist(
                        skeleton.offset(f"{side}_wrist"), (0, 0, 0)
                    )
                    assert 0.3 * length < min(spans)
                    assert max(spans) < 0.985 * length


def test_no_joint_turns_faster_than_in_people_at_the_preferred_duration(
    skeleton: Skeleton, subtests: pytest.Subtests
) -> None:
    """8 rad/s is what an elbow does in a quick beat; eyes are quicker."""
    for file in FILES:
        with subtests.test(file):
            animation = load_animation(FILES[file], skeleton)
            poses = rotations(animation, skeleton)
            steps = 2.0 * np.arccos(np.clip(np.abs((poses[1:] * poses[:-1]).sum(-1)), 0.0, 1.0))
            assert steps.max() * 40 / animation.timing(animation.values({})).duration < 8.0


def test_animations_of_the_left_hand_mirror_those_of_the_right_hand(
    skeleton: Skeleton, subtests: pytest.Subtests
) -> None:
    for right, left in PAIRS:
        with subtests.test(left):
            mirrored = rotations(load_animation(FILES[right], skeleton, mirror=True), skeleton)
            np.testing.assert_allclose(rotations(load_animation(FILES[left], skeleton), skeleton), mirrored, atol=2e-3)


def test_an_animation_can_be_chosen_by_file_name_alone() -> None:
    names = [Path(name).name for name in FILES]
    assert len(names) == len(set(names))


def test_a_bar_begins_and_ends_at_its_first_beat(skeleton: Skeleton, subtests: pytest.Subtests) -> None:
    for i in [1, 2, 3, 4]:
        with subtests.test(f"{i} beats"):
            poses = rotations(load_animation(FILES[f"conductor/{i}-beat_pattern_RH.xml"], skeleton), skeleton)
            np.testing.assert_allclose(poses[-1], poses[0], atol=1e-9)
