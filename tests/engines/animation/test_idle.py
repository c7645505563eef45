"""Idle animation of a figure."""

import math
from itertools import pairwise
from random import Random
from statistics import mean, stdev
from weakref import ref

import pytest

from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.vector import FORWARD, distance
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.idle_movements import Episodes, standing_degree

from .bodies import body_in


def blinks(idle: Idle, seconds: float) -> list[float]:
    """The times at which the lids begin to close, s."""
    frames = [idle.blinks(i / 100)["eyeBlinkLeft"] for i in range(round(seconds * 100))]
    return [i / 100 for i, (a, b) in enumerate(pairwise(frames)) if a == 0.0 < b]


def life(idle: Idle, time: float) -> tuple[Layer, dict[str, float], JointRotations]:
    """All of it."""
    return idle.layer(time, 1.0), idle.blinks(time), idle.eyes(time)


def test_the_same_seed_gives_the_same_idle_animation_in_any_order_of_queries() -> None:
    forward, backward = Idle(Random(3)), Idle(Random(3))
    times = [i / 10 for i in range(600)]
    seen = {time: life(forward, time) for time in times}
    assert seen == {time: life(backward, time) for time in reversed(times)}


def test_only_the_last_episodes_are_kept() -> None:
    class What:
        pass

    drawn: list[ref[What]] = []

    def draw() -> tuple[float, What]:
        what = What()
        drawn.append(ref(what))
        return 1.0, what

    episodes = Episodes(What(), draw)
    for hour in range(1, 4):
        now, before = episodes.at(3600.0 * hour + 0.5)
        assert (now.since, before.since) == (3600.0 * hour, 3600.0 * hour - 1.0)
    assert len(drawn) > 3 * 3600
    assert sum(what() is not None for what in drawn) == Episodes.KEPT


def test_two_figures_blink_and_breathe_independently() -> None:
    one, other = Idle(Random(1)), Idle(Random(2))
    assert blinks(one, 60.0) != blinks(other, 60.0)
    assert one.rotations(1.0) != other.rotations(1.0)
    assert [one.layer(t, 1.0).root for t in range(60)] != [other.layer(t, 1.0).root for t in range(60)]
    assert [one.eyes(t) for t in range(60)] != [other.eyes(t) for t in range(60)]


def test_the_figure_is_never_quite_still_or_restless(skeleton: Skeleton) -> None:
    idle = Idle(Random(5))
    places = [Body(skeleton, idle.rotations(i / 10)).transform("skullbase") for i in range(600)]
    for before, after in zip(places, places[10:], strict=False):
        assert distance(before.position, after.position) < 0.01
    assert max(distance(places[0].position, place.position) for place in places) > 0.002
    assert max(angle(difference(places[0].rotation, place.rotation)) for place in places) < 0.07


# --- breath


def lungs(idle: Idle, seconds: int) -> list[float]:
    """The elevation of the left shoulder, rad, fifty times a second."""
    return [angle(idle.rotations(i / 50)["l_sternoclavicular"]) for i in range(50 * seconds)]


def peaks(values: list[float]) -> list[int]:
    """The indices of the maxima."""
    triples = zip(values, values[1:], values[2:], strict=False)
    return [i for i, (before, at, after) in enumerate(triples, 1) if before < at >= after]


def test_the_shoulders_rise_and_fall_twelve_to_eighteen_times_a_minute_with_variation() -> None:
    lift = lungs(Idle(Random(5)), 600)
    breaths = [(b - a) / 50 for a, b in pairwise(peaks(lift))]
    assert 60.0 / 18.0 < min(breaths) < 3.7
    assert 4.4 < max(breaths) < 60.0 / 12.0
    assert 12.0 < 60.0 * len(breaths) / sum(breaths) < 18.0
    # M. J. Tobin and others (Journal of Applied Physiology 65, 1988): depth varies more than time.
    depths = [lift[peak] for peak in peaks(lift)]
    assert stdev(depths) / mean(depths) > stdev(breaths) / mean(breaths) > 0.05


def test_inhalation_is_shorter_than_exhalation() -> None:
    """Ours: breathing in is 0.42 of a breath."""
    lift = lungs(Idle(Random(5)), 600)
    rising = sum(b > a for a, b in pairwise(lift)) / len(lift)
    assert rising == pytest.approx(0.42, abs=0.01)


def test_a_breath_is_smooth() -> None:
    lift = lungs(Idle(Random(5)), 600)
    speeds = [(b - a) * 50 for a, b in pairwise(lift)]
    assert max(map(abs, speeds)) < 0.03
    assert max(abs(b - a) for a, b in pairwise(speeds)) < 0.003


# --- weight


def aside(idle: Idle, time: float, sunk: float = 0.0) -> float:
    """How far the pelvis is to the side, m."""
    root = idle.layer(time, standing_degree(sunk)).root
    assert root is not None
    return root[0]


def stances(idle: Idle, seconds: int) -> list[float]:
    """Where the pelvis is to the side, ten times a second, m."""
    return [aside(idle, i / 10) for i in range(10 * seconds)]


def test_a_standing_figure_shifts_its_weight_from_time_to_time() -> None:
    places = stances(Idle(Random(5)), 600)
    resting = sum(a == b for a, b in pairwise(places))
    assert resting > 0.8 * len(places)
    crossings = sum(a < 0.0 <= b or b < 0.0 <= a for a, b in pairwise(places))
    assert 600 / 30 < crossings < 600 / 10
    assert 0.02 < max(map(abs, places)) <= 0.031


def test_a_weight_shift_is_slow_and_smooth() -> None:
    places = stances(Idle(Random(5)), 600)
    speeds = [abs(b - a) * 10 for a, b in pairwise(places)]
    assert max(speeds) < 0.07
    assert max(abs(b - a) for a, b in pairwise(speeds)) < 0.03


def test_a_lower_pelvis_shifts_less_weight() -> None:
    idle = Idle(Random(5))
    time = next(i / 10 for i in range(600) if abs(aside(idle, i / 10)) > 0.02)
    ways = [abs(aside(idle, time, sunk)) for sunk in (0.0, 0.03, 0.07, 0.1, 0.4)]
    assert ways == sorted(ways, reverse=True)
    assert ways[-2:] == [0.0, 0.0]


def test_a_weight_shift_keeps_the_head_level(skeleton: Skeleton) -> None:
    idle = Idle(Random(5))
    still = Idle(Random(5))
    for i in range(0, 600, 7):
        layer = idle.layer(float(i), 1.0)
        assert layer.root is not None
        head = Body(skeleton, layer.rotations, layer.root).transform("skullbase").rotation
        alone = Body(skeleton, still.rotations(float(i))).transform("skullbase").rotation
        assert angle(difference(alone, head)) < 0.02


# --- eyes


def directions(idle: Idle, seconds: float, rate: int = 100) -> list[tuple[float, float]]:
    """Where the left eye looks: to the left and up, degrees."""
    turns = (rotate(idle.eyes(i / rate)["l_eyeball_joint"], FORWARD) for i in range(round(seconds * rate)))
    return [(math.degrees(math.atan2(x, z)), math.degrees(math.asin(y))) for x, y, z in turns]


def test_idle_eyes_look_ahead_most_of_the_time_and_glance_aside() -> None:
    seen = directions(Idle(Random(9)), 600.0, 50)
    ahead = sum(math.hypot(*each) < 0.5 for each in seen) / len(seen)
    # Lee, Badler and Badler 2002, of a listener: 237.5 frames at the other, 13 frames away.
    assert ahead == pytest.approx(237.5 / (237.5 + 13.0), abs=0.03)


def test_idle_eyes_stay_within_five_degrees() -> None:
    amplitudes = [math.hypot(*each) for each in directions(Idle(Random(9)), 600.0, 50)]
    assert 3.0 < max(amplitudes) <= 5.01


def test_idle_eyes_prefer_horizontal_and_vertical_glances() -> None:
    # Of the directions of Lee, Badler and Badler 2002, 70 % are within 22.5 degrees of an axis.
    seen = directions(Idle(Random(9)), 6000.0, 10)
    aside = [each for each in seen if math.hypot(*each) > 1.0]
    along = sum(min(abs(x), abs(y)) < math.tan(math.radians(22.5)) * max(abs(x), abs(y)) for x, y in aside)
    assert along / len(aside) == pytest.approx(0.70, abs=0.06)


def test_idle_eyes_turn_together_by_saccades() -> None:
    idle = Idle(Random(9))
    assert all(len(set(idle.eyes(i / 10).values())) == 1 for i in range(600))
    seen = directions(idle, 60.0, 1000)
    speeds = [1000 * math.dist(a, b) for a, b in pairwise(seen)]
    moving = [i for i, speed in enumerate(speeds) if speed > 1.0]
    assert 50.0 < max(speeds) < 300.0
    assert len(moving) < 0.04 * len(speeds)


@pytest.mark.parametrize(("side", "outward"), [("l", 1.0), ("r", -1.0)])
def test_at_rest_the_hands_hang_beside_the_hips_with_loose_fingers(
    skeleton: Skeleton, side: str, outward: float
) -> None:
    body = body_in(skeleton)
    shoulder, wrist, hip = (body.transform(f"{side}_{joint}").position for joint in ("shoulder", "wrist", "hip"))
    assert wrist[1] < shoulder[1] - 0.35
    assert outward * (wrist[0] - hip[0]) > 0.08
    assert wrist[2] > shoulder[2]
    straight = distance(
        Body(skeleton).transform(f"{side}_middle1").position, Body(skeleton).transform(f"{side}_middle3").position
    )
    tip, knuckle = body.transform(f"{side}_middle3").position, body.transform(f"{side}_middle1").position
    assert distance(tip, knuckle) < straight
