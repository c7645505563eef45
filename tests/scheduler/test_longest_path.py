"""Earliest times under inequalities: the least times that meet all, or a cycle that no times can meet."""

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies._internal.random import ArtificialRandom

from reactive_realizer.scheduler.convex.longest_path import TOLERANCE, Arc, longest_path

SIZE = 6
nodes = st.integers(0, SIZE - 1)
lengths = st.integers(-4, 4).map(float)
arcs_between = st.lists(st.builds(Arc, nodes, nodes, lengths, st.none()), max_size=12)


def plainly(arcs: list[Arc[None]]) -> list[float]:
    """The reference: relax all arcs as many times as there are nodes."""
    times = [0.0] * SIZE
    for _ in range(SIZE):
        for arc in arcs:
            times[arc.head] = max(times[arc.head], times[arc.tail] + arc.length)
    return times


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(derandomize=True, max_examples=400)
@given(arcs_between)
def test_times_are_the_least_that_meet_all_arcs_or_there_is_a_positive_cycle(arcs: list[Arc[None]]) -> None:
    times, circle = longest_path(SIZE, arcs)
    if circle:
        assert all(arc in arcs for arc in circle)
        assert all(arc.head == following.tail for arc, following in pairwise([*circle, circle[0]]))
        assert sum(arc.length for arc in circle) > TOLERANCE
    else:
        assert times == plainly(arcs)


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(derandomize=True, max_examples=100)
@given(st.permutations(range(40)), st.randoms(use_true_random=False))
def test_the_time_of_a_chain_does_not_depend_on_the_order_of_arcs_and_nodes(
    order: list[int], random: ArtificialRandom
) -> None:
    arcs = [Arc(tail, head, 0.5, None) for tail, head in pairwise(order)]
    random.shuffle(arcs)
    times, circle = longest_path(len(order), arcs)
    assert circle == []
    assert [times[node] for node in order] == [0.5 * place for place in range(len(order))]


def test_a_chain_of_thousands_needs_no_recursion_and_few_passes() -> None:
    arcs = [Arc(node, node - 1, 1.0, None) for node in range(1, 20_000)]
    times, circle = longest_path(20_000, arcs)
    assert circle == []
    assert times[0] == 19_999.0
