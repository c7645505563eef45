"""What the figure does when it does nothing."""

from itertools import pairwise
from random import Random

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, conjugate, multiply
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.idle.idle import Idle
from reactive_realizer.engines.animation.posture.rest_pose import REST_POSE


def blinks(idle: Idle, seconds: float) -> list[float]:
    """When lids begin to close."""
    frames = [idle.weights(i / 100)["eyeBlinkLeft"] for i in range(round(seconds * 100))]
    return [i / 100 for i, (a, b) in enumerate(pairwise(frames)) if a == 0.0 < b]


def test_the_figure_blinks_every_two_to_six_seconds():
    times = blinks(Idle(Random(7)), 300.0)
    gaps = [after - before for before, after in pairwise(times)]
    assert 50 < len(times) < 100
    assert 1.95 <= min(gaps) < 3.0
    assert 5.0 < max(gaps) <= 6.05


def test_a_blink_closes_both_lids_and_opens_them_within_150_ms():
    idle = Idle(Random(7))
    (start, *_) = blinks(idle, 20.0)
    during = [idle.weights(start + i / 1000) for i in range(200)]
    assert max(weights["eyeBlinkRight"] for weights in during) > 0.99
    assert all(weights["eyeBlinkLeft"] == weights["eyeBlinkRight"] for weights in during)
    assert sum(weights["eyeBlinkLeft"] > 0.0 for weights in during) <= 151


def test_the_same_seed_gives_the_same_life_in_whatever_order_it_is_asked_for():
    forward, backward = Idle(Random(3)), Idle(Random(3))
    times = [i / 10 for i in range(600)]
    seen = {time: (forward.weights(time), forward.rotations(time)) for time in times}
    assert seen == {time: (backward.weights(time), backward.rotations(time)) for time in reversed(times)}


def test_two_figures_do_not_blink_and_breathe_as_one():
    one, other = Idle(Random(1)), Idle(Random(2))
    assert blinks(one, 60.0) != blinks(other, 60.0)
    assert one.rotations(1.0) != other.rotations(1.0)


def test_the_figure_is_never_quite_still_and_never_restless(skeleton):
    idle = Idle(Random(5))
    places = [Body(skeleton, idle.rotations(i / 10)).place("skullbase") for i in range(600)]
    for before, after in zip(places, places[10:], strict=False):
        assert distance(before.position, after.position) < 0.01
    assert max(distance(places[0].position, place.position) for place in places) > 0.002
    assert max(angle(multiply(conjugate(places[0].rotation), place.rotation)) for place in places) < 0.07


def test_the_shoulders_rise_and_fall_fifteen_times_a_minute(skeleton):
    idle = Idle(Random(5))
    lift = [idle.rotations(i / 50)["l_sternoclavicular"][3] for i in range(3000)]
    peaks = sum(a < b >= c for a, b, c in zip(lift, lift[1:], lift[2:], strict=False))
    assert peaks == 15


@pytest.mark.parametrize(("side", "outward"), [("l", 1.0), ("r", -1.0)])
def test_at_rest_the_hands_hang_beside_the_hips_with_loose_fingers(skeleton, side, outward):
    body = Body(skeleton, REST_POSE)
    shoulder, wrist, hip = (body.place(f"{side}_{joint}").position for joint in ("shoulder", "wrist", "hip"))
    assert wrist[1] < shoulder[1] - 0.35
    assert outward * (wrist[0] - hip[0]) > 0.08
    assert wrist[2] > shoulder[2]
    straight = distance(
        Body(skeleton).place(f"{side}_middle1").position, Body(skeleton).place(f"{side}_middle3").position
    )
    tip, knuckle = body.place(f"{side}_middle3").position, body.place(f"{side}_middle1").position
    assert distance(tip, knuckle) < straight
