"""Limbs in frames do not pass through each other. The clearances are our choice."""

from typing import Any

import pytest

from reactive_realizer.clock.ticker import FRAME_EVERY, RATE
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import MARGIN, Clearance
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import conjugate, rotate, rotation_vector
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.testing.motion_laws import accelerations, hand_depth
from reactive_realizer.testing.pilot import RealizerPilot

from .flesh import deepest_in_each_other, deepest_in_legs, deepest_in_trunk
from .standing import CROSSED

STANDING, SITTING, CROUCHING = (f'<stance type="{stance}"/>' for stance in ("STANDING", "SITTING", "CROUCHING"))
AKIMBO = '<pose part="ARMS" lexeme="ARMS_AKIMBO"/>'
SPREAD, FORWARD = (f'<pose part="ARMS" lexeme="{lexeme}"/>' for lexeme in ("ARMS_SPREAD", "ARMS_FORWARD"))

SOFT = 0.03
"""m that one limb may be in another: flesh and clothes give way, and a hand that lies on a thigh touches it."""

LEANING = '<pose part="WHOLEBODY" lexeme="{}"/>'
BEFORE_THE_BELLY = ("BEAT", "OFFER", "CONDUIT", "CHOP")


IN_FLESH = 0.015
"""m that a hand may be in trunk, head or thighs, as thick as the avatar's skin says, while it moves."""

YIELDING = 0.01
"""The same for a hand that lies there."""

BRAKING = 65.0
"""m/s² of a wrist that goes around them."""

AROUND = [
    ("ARMS_AKIMBO", "ARMS_CROSSED"),
    ("ARMS_CROSSED", "ARMS_SPREAD"),
    ("ARMS_FORWARD", "ARMS_AKIMBO"),
    ("ARMS_OPEN", "ARMS_NEUTRAL"),
]

POSES = ["", LEANING.format("LEANING_FORWARD"), LEANING.format("LEANING_BACKWARD"), CROSSED, AKIMBO]


@pytest.mark.parametrize("stance", ["SITTING", "CROUCHING"])
@pytest.mark.parametrize("poses", POSES)
async def test_no_hand_passes_through_a_thigh(alternating: RealizerPilot, stance: str, poses: Any) -> None:
    alternating.block("b", f'<posture id="p" start="0" end="5"><stance type="{stance}"/>{poses}</posture>')
    await alternating.advance(6)
    assert alternating.feedback.reached("b:p:end")
    assert deepest_in_legs(alternating.bodies()[::2]) < SOFT


@pytest.mark.parametrize(
    ("before", "after"),
    [(STANDING, CROUCHING + AKIMBO), (STANDING, SITTING + AKIMBO), (SITTING + SPREAD, CROUCHING)],
    ids=["crouches, hands to the hips", "sits down, hands to the hips", "gets from a seat, arms spread"],
)
async def test_no_elbow_bends_backward_while_a_figure_sinks_or_rises(
    either: RealizerPilot, before: str, after: str
) -> None:
    either.block("first", f'<postureShift id="s">{before}</postureShift>')
    await either.advance(3)
    either.block("b", f'<posture id="p" start="0" end="5">{after}</posture>')
    await either.advance(6)
    assert either.feedback.reached("b:p:end")
    bodies, (figure, *_) = either.bodies(), either.realizer.characters.values()
    assert max(rotation_vector(body.rotation(f"{side}_elbow"))[0] for body in bodies for side in SIDES) < 0.0
    assert hand_depth(bodies, figure.humanoid.avatar) < IN_FLESH


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "CROUCHING", "LYING"])
async def test_hands_at_the_hips_touch_them(alternating: RealizerPilot, stance: str) -> None:
    alternating.block("b", f'<postureShift id="s" start="0"><stance type="{stance}"/>{AKIMBO}</postureShift>')
    await alternating.advance(5)
    *_, shown = alternating.bodies()
    figure, *_ = alternating.realizer.characters.values()
    assert -MARGIN < Clearance.of(figure.humanoid.avatar).deepest(shown) < YIELDING
    assert deepest_in_trunk([shown]) < SOFT


@pytest.mark.parametrize("lexeme", BEFORE_THE_BELLY)
async def test_a_crouching_figure_has_room_for_gestures(alternating: RealizerPilot, lexeme: str) -> None:
    alternating.block("a", '<postureShift id="s"><stance type="CROUCHING"/></postureShift>')
    await alternating.advance(3)
    alternating.block("b", f'<gesture id="g" lexeme="{lexeme}" mode="BOTH_HANDS"/>')
    await alternating.advance(4)
    assert alternating.feedback.reached("b:g:stroke")
    assert deepest_in_legs(alternating.bodies()[150::2]) < SOFT


async def test_crossed_arms_lie_before_the_trunk(either: RealizerPilot) -> None:
    either.block("b", f'<posture id="p" start="0">{CROSSED}</posture>')
    await either.advance(5)
    assert deepest_in_trunk(either.bodies()[::2]) < SOFT


@pytest.mark.parametrize("stance", ["STANDING", "SITTING"])
async def test_no_leg_passes_through_the_other_when_legs_are_crossed(either: RealizerPilot, stance: str) -> None:
    crossed = '<pose part="LEGS" lexeme="LEGS_CROSSED"/>'
    either.block("b", f'<posture id="p" start="0" end="5"><stance type="{stance}"/>{crossed}</posture>')
    await either.advance(6)
    assert either.feedback.reached("b:p:end")
    assert deepest_in_each_other(either.bodies()[::2]) < SOFT


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "CROUCHING"])
@pytest.mark.parametrize(("begin", "goal"), AROUND)
async def test_hands_go_around_the_body_from_one_posture_to_another(
    either: RealizerPilot, stance: str, begin: str, goal: str
) -> None:
    for number, arms in enumerate((begin, goal, begin)):
        posture = f'<stance type="{stance}"/><pose part="ARMS" lexeme="{arms}"/>'
        either.block(f"b{number}", f'<postureShift id="s" start="0">{posture}</postureShift>')
        await either.advance(3)
    shown = either.bodies()
    assert depth(either, shown[130:]) < IN_FLESH
    assert max(accelerations(shown[100:], f"{side}_wrist").max() for side in "lr") < BRAKING


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (SITTING, CROUCHING + CROSSED),
        (SITTING + AKIMBO, CROUCHING),
        (SITTING + AKIMBO, CROUCHING + CROSSED),
        (SITTING + AKIMBO, CROUCHING + FORWARD),
        (CROUCHING + CROSSED, SITTING),
        (CROUCHING + CROSSED, SITTING + AKIMBO),
    ],
    ids=[
        "arms cross",
        "hands leave the hips",
        "arms leave the hips and cross",
        "arms leave the hips and go forward",
        "arms uncross",
        "hands go to the hips",
    ],
)
async def test_arms_go_around_thighs_that_rise_with_stepping_feet(
    either: RealizerPilot, before: str, after: str
) -> None:
    either.block("first", f'<postureShift id="s">{before}</postureShift>')
    await either.advance(3)
    either.block("b", f'<postureShift id="s">{after}</postureShift>')
    await either.advance(3)
    assert either.feedback.reached("b:s:end")
    shown = either.bodies()[130:]
    assert depth(either, shown) < YIELDING
    assert max(accelerations(shown, f"{side}_wrist").max() for side in "lr") < BRAKING


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "CROUCHING"])
@pytest.mark.parametrize("lexeme", [*BEFORE_THE_BELLY, "SELF", "CONDUCT"])
async def test_no_gesture_passes_through_the_body(alternating: RealizerPilot, stance: str, lexeme: str) -> None:
    alternating.block("a", f'<postureShift id="s"><stance type="{stance}"/></postureShift>')
    await alternating.advance(3)
    alternating.block("b", f'<gesture id="g" lexeme="{lexeme}" mode="LEFT_HAND"/>')
    await alternating.advance(4)
    assert alternating.feedback.reached("b:g:stroke")
    assert alternating.feedback.warnings == []
    assert depth(alternating, alternating.bodies()[150:]) < IN_FLESH


async def test_hands_of_a_crouching_figure_keep_out_of_its_thighs(either: RealizerPilot) -> None:
    either.block("a", '<postureShift id="s"><stance type="CROUCHING"/></postureShift>')
    await either.advance(3)
    for lexeme in ("OFFER", "CONTAINER"):
        either.block(lexeme, f'<gesture id="g" lexeme="{lexeme}" mode="BOTH_HANDS"/>')
        await either.advance(4)
        assert either.feedback.reached(f"{lexeme}:g:stroke")
    assert depth(either, either.bodies()[150:]) < YIELDING


@pytest.mark.parametrize("stance", ["STANDING", "SITTING"])
async def test_a_palm_on_the_heart_lies_just_left_of_the_middle_of_the_chest(
    either: RealizerPilot, stance: str
) -> None:
    """No further aside than 0.4 of the way to the left shoulder."""
    either.block("a", f'<postureShift id="s"><stance type="{stance}"/></postureShift>')
    await either.advance(3)
    either.block("b", '<gesture id="g" lexeme="HEART"/>')
    await either.advance(4)
    assert either.feedback.reached("b:g:stroke")
    since = either.feedback.time("b:g:stroke")
    shown = either.bodies()[round(since * RATE / FRAME_EVERY)]
    wrist, knuckle, shoulder = (left_of_the_chest(shown, joint) for joint in ("r_wrist", "r_middle1", "l_shoulder"))
    assert 0.0 < 0.5 * (wrist + knuckle) < 0.4 * shoulder


def left_of_the_chest(body: Body, joint: str) -> float:
    """How far a joint is to the left of the middle of the chest, m."""
    middle, turn = body.transform("vt6")
    return rotate(conjugate(turn), subtract(body.transform(joint).position, middle))[0]


def depth(pilot: RealizerPilot, bodies: list[Body]) -> float:
    """How deep a hand or forearm is in flesh, m."""
    figure, *_ = pilot.realizer.characters.values()
    return hand_depth(bodies, figure.humanoid.avatar)
