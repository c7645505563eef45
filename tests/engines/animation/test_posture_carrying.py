"""One foot carries while the other is in the air."""

from itertools import pairwise

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.quaternion import IDENTITY
from reactive_realizer.embodiment.skeleton import Place
from reactive_realizer.engines.animation.posture.carrying import Carrying
from reactive_realizer.engines.animation.posture.steps import Foot, swung

HIGH = 0.08
"""m, of an ankle whose foot stands."""

FRAME = 0.02


def at(x: float) -> Foot:
    return Foot(Place((x, HIGH, 0.0), IDENTITY))


def stepping(begin: float, end: float, start: float, goal: float, now: float) -> Foot:
    """A foot that steps from one place to another within a time, s."""
    return swung(at(start), at(goal), min(1.0, max(0.0, (now - begin) / (end - begin))))


def shown(left: tuple[float, float], right: tuple[float, float], until: float = 2.5) -> list[tuple[Place, Place]]:
    """Frames of two feet that are wanted to step aside from one time to another, s, each."""
    carrying = Carrying()
    times = [GlobalTime(FRAME * i) for i in range(round(until / FRAME))]
    return [carrying((stepping(*left, 0.1, 0.3, t), stepping(*right, -0.1, -0.3, t)), t) for t in times]


def lifted(place: Place) -> bool:
    return place.position[1] > HIGH + 0.01


def test_feet_that_step_one_after_the_other_do_as_they_are_wanted_to():
    left, right = (0.2, 0.8), (0.8, 1.4)
    for i, (one, other) in enumerate(shown(left, right)):
        now = FRAME * i
        assert (one, other) == (stepping(*left, 0.1, 0.3, now).place, stepping(*right, -0.1, -0.3, now).place)


@pytest.mark.parametrize("begin", [0.2, 0.22, 0.4, 0.7])
def test_the_one_that_is_to_leave_while_the_other_is_in_the_air_waits_until_that_stands(begin):
    feet = shown((0.2, 0.8), (begin, begin + 0.6))
    assert not any(lifted(left) and lifted(right) for left, right in feet)
    assert any(lifted(left) for left, _ in feet)
    assert any(lifted(right) for _, right in feet)


def test_it_makes_up_for_its_way_and_goes_nowhere_on_the_ground():
    feet = [right for _, right in shown((0.2, 0.8), (0.4, 1.0))]
    assert feet[-1].position == pytest.approx((-0.3, HIGH, 0.0))
    for a, b in pairwise(feet):
        assert lifted(a) or lifted(b) or abs(b.position[0] - a.position[0]) < 1e-3


def test_it_has_settled_when_both_have_come():
    carrying = Carrying()
    settled = []
    for i in range(100):
        now = GlobalTime(FRAME * i)
        carrying((stepping(0.2, 0.8, 0.1, 0.3, now), stepping(0.4, 1.0, -0.1, -0.3, now)), now)
        settled.append(carrying.settled)
    assert settled[0]
    assert settled[-1]
    assert not all(settled)


def test_what_was_shown_long_ago_holds_nobody_back():
    carrying = Carrying()
    carrying((at(0.1), at(-0.1)), GlobalTime(0.0))
    wanted = (Foot(Place((0.2, 0.15, 0.0), IDENTITY), 0.07), Foot(Place((-0.2, 0.15, 0.0), IDENTITY), 0.07))
    assert carrying(wanted, GlobalTime(5.0)) == tuple(foot.place for foot in wanted)
