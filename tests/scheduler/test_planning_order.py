"""The order of planning: a block comes after the blocks that it refers to."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TypeVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.scheduler.planning_order import dependency_order

T = TypeVar("T", int, str)
MANY = 20_000
NAMES = st.dictionaries(st.integers(0, 8), st.lists(st.integers(0, 8)))


def ordered(names: Mapping[T, Sequence[T]], waiting: list[T] | None = None) -> list[T]:
    return dependency_order(names if waiting is None else waiting, lambda each: names.get(each, []))


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
def test_an_item_comes_after_its_dependencies_and_the_others_keep_their_order(
    names: dict[str, list[str]], order: str
) -> None:
    assert "".join(ordered(names)) == order


@pytest.mark.parametrize(
    ("names", "order"),
    [
        ({"a": ["b"], "b": ["a"]}, "ba"),
        ({"a": ["a"]}, "a"),
        ({"a": ["b"], "b": ["c"], "c": ["a"]}, "cba"),
        ({"x": ["a"], "a": ["b", "d"], "b": ["a"], "d": []}, "bdax"),
    ],
)
def test_one_item_of_a_cycle_comes_first_and_items_outside_of_it_wait(names: dict[str, list[str]], order: str) -> None:
    assert "".join(ordered(names)) == order


@given(NAMES)
def test_each_item_comes_once_and_precedes_a_dependency_only_in_a_cycle(names: dict[int, list[int]]) -> None:
    order = ordered(names)
    place = {each: number for number, each in enumerate(order)}
    assert len(place) == len(order)
    assert place.keys() == names.keys() | {other for others in names.values() for other in others}
    for each, others in names.items():
        for other in others:
            assert place[other] < place[each] or each in ordered(names, [other])


@pytest.mark.parametrize("step", [1, -1])
def test_each_item_of_a_long_chain_is_visited_once_without_recursion(step: int) -> None:
    asked = Counter[int]()

    def named(each: int) -> list[int]:
        asked[each] += 1
        return [each + step] if 0 <= each + step < MANY else []

    assert dependency_order(range(MANY), named) == list(range(MANY))[::-step]
    assert set(asked.values()) == {1}
