"""Whose turn it is to be planned: one comes after those that it names."""

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.scheduler.turns import in_turn

MANY = 20_000
NAMES = st.dictionaries(st.integers(0, 8), st.lists(st.integers(0, 8)))


def turns(names, waiting=None):
    return in_turn(names if waiting is None else waiting, lambda each: names.get(each, []))


@pytest.mark.parametrize(
    ("names", "order"),
    [
        ({"a": [], "b": [], "c": []}, "abc"),
        ({"a": [], "b": ["a"], "c": ["a"]}, "abc"),
        ({"a": ["c"], "b": [], "c": []}, "cab"),
        ({"a": ["b"], "b": ["c"], "c": []}, "cba"),
        ({"a": ["b", "c"], "b": ["c"], "c": []}, "cba"),
        ({"a": ["d"]}, "da"),
    ],
)
def test_who_names_others_comes_after_them_and_all_else_stays_in_order(names, order) -> None:
    assert "".join(turns(names)) == order


@pytest.mark.parametrize(
    ("names", "order"),
    [
        ({"a": ["b"], "b": ["a"]}, "ba"),
        ({"a": ["a"]}, "a"),
        ({"a": ["b"], "b": ["c"], "c": ["a"]}, "cba"),
        ({"x": ["a"], "a": ["b", "d"], "b": ["a"], "d": []}, "bdax"),
    ],
)
def test_in_a_circle_one_is_first_and_who_is_outside_of_it_waits_as_ever(names, order) -> None:
    assert "".join(turns(names)) == order


@given(NAMES)
def test_each_comes_once_and_only_a_circle_puts_one_before_what_it_names(names) -> None:
    order = turns(names)
    place = {each: number for number, each in enumerate(order)}
    assert len(place) == len(order)
    assert place.keys() == names.keys() | {other for others in names.values() for other in others}
    for each, others in names.items():
        for other in others:
            assert place[other] < place[each] or each in turns(names, [other])


@pytest.mark.parametrize("step", [1, -1])
def test_a_long_chain_asks_each_once_and_goes_no_deeper_for_it(step) -> None:
    asked = Counter()

    def named(each):
        asked[each] += 1
        return [each + step] if 0 <= each + step < MANY else []

    assert in_turn(range(MANY), named) == list(range(MANY))[::-step]
    assert set(asked.values()) == {1}
