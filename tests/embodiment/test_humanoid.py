"""A character over time: from layers to frames."""

import math
from collections.abc import Callable, Mapping
from importlib.resources import files
from itertools import pairwise
from pathlib import Path

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.humanoid import EyePose, Humanoid
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import angle, conjugate, difference, from_axis_angle, multiply
from reactive_realizer.embodiment.vector import UP, distance

AVATAR = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb")
FRAME = 0.02
ASIDE = from_axis_angle((0.0, 0.0, 1.0), -0.5)
"""A right arm that is away from the body; in the default pose, its hand is in the thigh."""


def frame(
    figure: Humanoid,
    time: float,
    layers: list[Layer],
    eyes: Callable[[Body], EyePose] | None = None,
    *faces: Mapping[str, float],
) -> Frame:
    """The frame of a time."""
    figure.move(GlobalTime(time), layers)
    return figure.look(eyes, faces)


def frames(layers: list[Layer], eyes: Callable[[Body], EyePose] | None = None, count: int = 30) -> list[Body]:
    """A figure in the default pose for one frame, then with these layers; its bodies as shown."""
    figure = Humanoid(AVATAR)
    shown = []
    for i in range(count):
        frame(figure, i * FRAME, layers if i else [], eyes if i else None)
        shown.append(figure.shown)
    return shown


def looking_ahead(body: Body) -> EyePose:
    """Eyes that look to +z in any pose of the head."""
    return EyePose(dict.fromkeys(EYES, conjugate(body.transform("skullbase").rotation)), {})


def test_the_eyes_look_from_the_head_as_limited_and_not_as_requested() -> None:
    aside = Layer(LayerKind.GAZE, {"skullbase": from_axis_angle(UP, 0.5), "vc4": from_axis_angle(UP, 0.3)})
    shown = frames([aside], looking_ahead)
    turned = [angle(body.transform("skullbase").rotation) for body in shown]
    assert turned[1] < 0.4 < turned[-1], "held back at first"
    # Two joints of the neck at 8 rad/s are no faster than an eye at 16.
    for body in shown:
        assert angle(body.transform(EYES[0]).rotation) < math.radians(0.5)


def test_an_eye_turns_no_faster_than_in_a_saccade_in_either_direction() -> None:
    figure, aside = Humanoid(AVATAR), EyePose(dict.fromkeys(EYES, from_axis_angle(UP, 0.6)), {})
    eyes = []
    for i in range(20):
        frame(figure, i * FRAME, [], (lambda body: aside) if 1 <= i < 10 else None)
        eyes.append(figure.shown.rotation(EYES[0]))
    steps = [angle(difference(a, b)) for a, b in pairwise(eyes)]
    assert max(steps) == pytest.approx(16.0 * FRAME)
    assert angle(eyes[9]) == pytest.approx(0.6)
    assert angle(eyes[-1]) == pytest.approx(0.0, abs=1e-9)


def test_the_first_frame_is_as_requested() -> None:
    figure = Humanoid(AVATAR)
    frame(
        figure,
        3.0,
        [Layer(LayerKind.BASE, {"r_shoulder": ASIDE, "r_elbow": from_axis_angle(UP, 1.5)}, root=(0.0, -0.4, 0.0))],
    )
    assert angle(figure.shown.rotation("r_elbow")) == pytest.approx(1.5)
    assert figure.shown.root == (0.0, -0.4, 0.0)


def test_a_frame_has_the_root_in_the_world_and_the_pose_in_the_order_of_the_skeleton() -> None:
    figure = Humanoid(AVATAR, position=(1.0, 0.0, 2.0), heading=0.5 * math.pi)
    elbow = from_axis_angle((1.0, 0.0, 0.0), -1.0)
    layer = Layer(LayerKind.BASE, {"r_shoulder": ASIDE, "r_elbow": elbow, "l_no_such": elbow}, root=(0.0, 0.0, 0.1))
    shown = frame(figure, 0.0, [layer])
    joints = AVATAR.skeleton.joints
    assert tuple(shown.rotations[joints.index("r_elbow")]) == elbow
    assert shown.rotations[joints.index("HumanoidRoot")] == pytest.approx(from_axis_angle(UP, 0.5 * math.pi))
    x, y, z = AVATAR.skeleton.offset("HumanoidRoot")
    assert shown.root == pytest.approx((1.1 + z, y, 2.0 - x))


def test_faces_and_lids_add_up_within_the_range_of_a_morph() -> None:
    figure, lids = Humanoid(AVATAR), EyePose({}, {"eyeBlinkLeft": 0.25, "jawOpen": -0.5})
    faces = {"jawOpen": 0.75, "noSuchMorph": 1.0}, {"jawOpen": 0.5, "mouthSmileLeft": 2.0}
    shown = frame(figure, 0.0, [], lambda body: lids, *faces)
    weights = {morph: shown.weights[i] for i, morph in enumerate(AVATAR.morphs) if shown.weights[i] != 0.0}
    assert weights == {"jawOpen": 0.75, "eyeBlinkLeft": 0.25, "mouthSmileLeft": 1.0}


def test_a_figure_that_has_moved_is_located_there_before_it_looks() -> None:
    figure = Humanoid(AVATAR)
    frame(figure, 0.0, [])
    before = figure.locate("r_wrist")
    figure.move(GlobalTime(FRAME), [Layer(LayerKind.BASE, {"r_elbow": from_axis_angle((1.0, 0.0, 0.0), -0.1)})])
    moved = figure.locate("r_wrist")
    seen = []

    def look(body: Body) -> EyePose:
        seen.append(body.transform("r_wrist").position)
        return EyePose({}, {})

    figure.look(look, ())
    assert moved != before
    assert seen == [moved] == [figure.locate("r_wrist")]


def bent(angle_: float) -> list[Layer]:
    """An arm that moves."""
    return [Layer(LayerKind.BASE, {"r_shoulder": multiply(from_axis_angle((1.0, 0.0, 0.0), -angle_), ASIDE)})]


def test_a_figure_is_at_rest_before_its_first_frame() -> None:
    figure = Humanoid(AVATAR)
    rest = Body(AVATAR.skeleton, {"r_shoulder": from_axis_angle(UP, 0.3)}, (0.0, -0.1, 0.0))
    figure.rest(rest)
    assert figure.body is figure.shown is rest
    assert figure.locate("r_wrist") == rest.transform("r_wrist").position


def test_the_position_of_a_joint_in_the_next_frame_is_extrapolated() -> None:
    figure = Humanoid(AVATAR, position=(1.0, 0.0, 0.0), heading=1.0)
    for i in range(5):
        frame(figure, i * FRAME, bent(0.1 * i))
    now, expected = figure.locate("r_wrist"), figure.locate("r_wrist", GlobalTime(5 * FRAME))
    frame(figure, 5 * FRAME, bent(0.5))
    there = figure.locate("r_wrist")
    assert now is not None
    assert expected is not None
    assert there is not None
    assert distance(there, now) > 0.04
    assert distance(there, expected) < 0.15 * distance(there, now)
    assert figure.locate("r_wrist", GlobalTime(5 * FRAME)) == there, "it has moved there"
    assert figure.locate("r_no_such", GlobalTime(6 * FRAME)) is None


def test_positions_are_extrapolated_by_one_frame_at_most() -> None:
    figure = Humanoid(AVATAR)
    for i in range(3):
        frame(figure, i * FRAME, bent(0.1 * i))
    assert figure.locate("r_wrist", GlobalTime(60.0)) == pytest.approx(figure.locate("r_wrist", GlobalTime(3 * FRAME)))
