"""Ways from one value to another."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.assembly.registry import load, names

BUILT_IN = ["ease-in-ease-out", "instant", "linear"]


def test_the_built_in_ones_stand_in_the_group_of_plug_ins() -> None:
    assert names("trajectories") == BUILT_IN


@pytest.mark.parametrize("name", BUILT_IN)
def test_each_has_come_to_its_end_after_all_of_its_time(name: str) -> None:
    assert load("trajectories", name)(1.0) == 1.0


@pytest.mark.parametrize("name", BUILT_IN)
@given(early=st.floats(0, 1), late=st.floats(0, 1))
def test_each_stays_between_its_ends_and_never_turns_back(name: str, early: float, late: float) -> None:
    trajectory = load("trajectories", name)
    early, late = sorted((early, late))
    assert 0.0 <= trajectory(early) <= trajectory(late) + 1e-15 <= 1.0 + 1e-15


def test_instant_is_there_from_the_beginning_and_the_others_set_out_from_it() -> None:
    assert {name: load("trajectories", name)(0.0) for name in BUILT_IN} == dict(zip(BUILT_IN, (0, 1, 0), strict=True))


def test_easing_is_slow_at_both_ends_quick_in_the_middle_and_even_about_it() -> None:
    ease = load("trajectories", "ease-in-ease-out")
    assert ease(0.01) < 0.001
    assert ease(0.5) == 0.5
    assert 1.0 - ease(0.99) < 0.001
    assert ease(0.3) + ease(0.7) == pytest.approx(1.0)
