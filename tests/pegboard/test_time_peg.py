"""Pegs follow their dependencies (thesis 7.3.2, 7.3.3)."""

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.block_pegs import BMLBlockPeg, LatestPeg
from reactive_realizer.pegboard.bounded_pegs import AfterPeg, BeforePeg
from reactive_realizer.pegboard.peg_view import followers_of, unknown_sources
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg, RatioPeg, TimePeg
from reactive_realizer.reactive.graph import Graph


@pytest.fixture
def graph() -> Graph:
    return Graph()


def write(peg: AnticipatorPeg, time: float | None) -> None:
    with peg.graph.transaction("test"):
        peg.set(None if time is None else GlobalTime(time))


def pin(peg: TimePeg, time: float) -> None:
    with peg.graph.transaction("test"):
        peg.pin(GlobalTime(time))


def test_an_offset_peg_keeps_its_distance(graph: Graph) -> None:
    hit = AnticipatorPeg(graph, "hit", GlobalTime(2.0))
    peg = OffsetPeg(graph, "start", hit, -0.5)
    assert peg.value == 1.5
    write(hit, 3.0)
    assert peg.value == 2.5
    assert peg.describe() == "hit -0.5 s"


def test_a_ratio_peg_keeps_its_fraction(graph: Graph) -> None:
    start, end = AnticipatorPeg(graph, "start", GlobalTime(1.0)), AnticipatorPeg(graph, "end", GlobalTime(3.0))
    stroke = RatioPeg(graph, "stroke", start, end, 0.25)
    assert stroke.value == 1.5
    write(end, 5.0)
    assert stroke.value == 2.0
    assert stroke.describe() == "0.25 of the way start .. end"


@pytest.mark.parametrize("unknown", ["start", "end"])
def test_dependents_of_an_unknown_peg_are_unknown_until_it_is_known(graph: Graph, unknown: str) -> None:
    pegs = {name: AnticipatorPeg(graph, name, GlobalTime(1.0)) for name in ("start", "end")}
    between = RatioPeg(graph, "between", pegs["start"], pegs["end"], 0.5)
    after = OffsetPeg(graph, "after", between, 1.0)
    latest = LatestPeg(graph, "latest", GlobalTime(0.0), (after, pegs["end"]))
    write(pegs[unknown], None)
    assert (between.value, after.value, latest.value) == (None, None, None)
    assert unknown_sources([latest]) == [unknown]
    write(pegs[unknown], 1.0)
    assert (between.value, after.value, latest.value) == (1.0, 2.0, 2.0)
    assert unknown_sources([latest]) == []


def test_a_block_starts_at_the_latest_peg_it_waits_for_and_not_before_its_floor(graph: Graph) -> None:
    one, two = AnticipatorPeg(graph, "one", GlobalTime(1.0)), AnticipatorPeg(graph, "two", GlobalTime(2.0))
    block = BMLBlockPeg(graph, "b:start", GlobalTime(1.5), (one, two))
    assert block.value == 2.0
    write(two, 0.5)
    assert block.value == 1.5
    with graph.transaction("test"):
        block.wait_for(GlobalTime(0.2), (one,))
    assert block.value == 1.0
    assert block.describe() == "latest of 0.2 s, one"
    assert two.dependents == {}


def test_a_pinned_peg_is_cut_from_its_source_and_others_follow_it(graph: Graph) -> None:
    hit = AnticipatorPeg(graph, "hit", GlobalTime(2.0))
    start, end = OffsetPeg(graph, "start", hit, -1.0), OffsetPeg(graph, "end", hit, 1.0)
    between = RatioPeg(graph, "between", start, end, 0.5)
    pin(start, 1.0)
    write(hit, 4.0)
    assert (start.value, between.value, end.value) == (1.0, 3.0, 5.0)
    assert start.pinned
    assert not between.pinned
    assert start.describe() == "hit -1 s", "it still tells what it hung on"


def blocks(graph: Graph) -> tuple[AnticipatorPeg, AnticipatorPeg, OffsetPeg, OffsetPeg]:
    """Two blocks and a peg in each, half a second after its start."""
    one, two = AnticipatorPeg(graph, "one", GlobalTime(1.0)), AnticipatorPeg(graph, "two", GlobalTime(8.0))
    return one, two, OffsetPeg(graph, "one:h:start", one, 0.5), OffsetPeg(graph, "two:h:start", two, 0.5)


def test_an_after_peg_stays_behind_its_bound_in_another_block(graph: Graph) -> None:
    one, two, natural, bound = blocks(graph)
    peg = AfterPeg(graph, "after", natural, [(bound, 3.0)])
    assert peg.value == 11.5
    write(two, 9.0)
    assert peg.value == 12.5
    write(one, 20.0)
    assert peg.value == 20.5
    assert peg.describe() == "one:h:start, not before two:h:start +3 s"


def test_a_before_peg_stays_in_front_of_its_bound_in_another_block(graph: Graph) -> None:
    one, two, natural, bound = blocks(graph)
    peg = BeforePeg(graph, "before", bound, [(natural, 2.0)])
    assert peg.value == 3.5
    write(one, 2.0)
    assert peg.value == 4.5
    write(two, 1.0)
    assert peg.value == 1.5
    assert peg.describe() == "two:h:start, not after one:h:start +2 s"


def test_the_tightest_of_several_bounds_holds(graph: Graph) -> None:
    natural, low, high = (
        AnticipatorPeg(graph, name, GlobalTime(time)) for name, time in (("n", 1.0), ("low", 2.0), ("high", 5.0))
    )
    after = AfterPeg(graph, "after", natural, [(low, 0.0), (high, 1.0)])
    before = BeforePeg(graph, "before", high, [(low, 0.0), (natural, 3.0)])
    assert (after.value, before.value) == (6.0, 2.0)
    write(low, 7.0)
    assert (after.value, before.value) == (7.0, 4.0)


def test_a_bound_of_a_before_peg_before_a_floor_has_no_effect(graph: Graph) -> None:
    natural, bound, other, floor = (
        AnticipatorPeg(graph, name, None) for name in ("natural", "bound", "other", "floor")
    )
    peg = BeforePeg(graph, "before", natural, [(bound, -1.0), (other, 0.0)], [(floor, 0.5)])
    assert peg.describe() == "natural, not after bound -1 s, other +0 s, unless that is before floor +0.5 s"
    for cell, time, expected in [
        (bound, 4.0, None), (natural, 9.0, 3.0), (floor, 3.0, 9.0),
        (other, 7.0, 7.0), (floor, 2.5, 3.0), (floor, None, 3.0),
    ]:  # fmt: skip
        write(cell, time)
        assert peg.value == expected, (cell.name, time)


def test_a_bound_of_an_after_peg_after_a_ceiling_has_no_effect_and_it_waits_for_an_unknown_one(graph: Graph) -> None:
    natural, bound, other, ceiling = (
        AnticipatorPeg(graph, name, None) for name in ("natural", "bound", "other", "ceiling")
    )
    peg = AfterPeg(graph, "after", natural, [(bound, 1.0), (other, 0.0)], [(ceiling, -0.5)])
    assert peg.describe() == "natural, not before bound +1 s, other +0 s, unless that is after ceiling -0.5 s"
    assert peg.parameters == {"bounds": [1.0, 0.0], "stops": [-0.5]}
    for cell, time, expected in [
        (bound, 4.0, None), (natural, 2.0, None), (other, 3.0, 5.0), (ceiling, 5.0, 3.0),
        (ceiling, 5.5, 5.0), (other, 5.1, 5.0), (bound, None, None), (ceiling, None, None), (bound, 4.5, 5.5),
    ]:  # fmt: skip
        write(cell, time)
        assert peg.value == expected, (cell.name, time)
    assert [link.name for link in peg.deciding] == ["bound"]


def test_a_bound_that_moves_without_effect_notifies_no_observer(graph: Graph) -> None:
    natural, bound = AnticipatorPeg(graph, "natural", GlobalTime(5.0)), AnticipatorPeg(graph, "bound", GlobalTime(1.0))
    told: list[object] = []
    AfterPeg(graph, "after", natural, [(bound, 0.0)]).observe(lambda change: told.append(change.new))
    write(bound, 4.0)
    assert told == []
    write(bound, 6.0)
    assert told == [6.0]


def test_after_an_unknown_time_waits_and_before_one_has_no_effect(graph: Graph) -> None:
    natural, bound = AnticipatorPeg(graph, "natural", GlobalTime(5.0)), AnticipatorPeg(graph, "bound", None)
    after = AfterPeg(graph, "after", natural, [(bound, 0.0)])
    before = BeforePeg(graph, "before", natural, [(bound, 0.0)])
    assert (after.value, before.value) == (None, 5.0)
    assert unknown_sources([after]) == ["bound"]
    write(bound, 3.0)
    assert (after.value, before.value) == (5.0, 3.0)
    write(natural, None)
    assert (after.value, before.value) == (None, None)


@pytest.mark.parametrize("kind", [AfterPeg, BeforePeg])
def test_a_pinned_peg_is_cut_from_its_bounds_too(graph: Graph, kind: type[AfterPeg | BeforePeg]) -> None:
    natural, bound = AnticipatorPeg(graph, "natural", GlobalTime(5.0)), AnticipatorPeg(graph, "bound", GlobalTime(5.0))
    peg = kind(graph, "peg", natural, [(bound, 0.0)])
    pin(peg, 5.0)
    write(natural, 1.0)
    write(bound, 9.0)
    assert peg.value == 5.0
    assert natural.dependents == bound.dependents == {}
    assert [link.name for link in peg.links] == ["natural", "bound"]


def test_a_pinned_bound_stays_in_effect(graph: Graph) -> None:
    _, two, natural, bound = blocks(graph)
    peg = AfterPeg(graph, "after", natural, [(bound, 0.0)])
    pin(bound, 8.5)
    write(two, 20.0)
    assert peg.value == 8.5


def test_an_offset_peg_across_blocks_is_computed_once_when_both_blocks_move(graph: Graph) -> None:
    one, two, natural, bound = blocks(graph)
    between = RatioPeg(graph, "between", natural, bound, 0.5)
    told: list[object] = []
    between.observe(lambda change: told.append(change.new))
    with graph.transaction("test"):
        one.set(GlobalTime(2.0))
        two.set(GlobalTime(4.0))
    assert told == [3.5]


def test_a_latest_peg_is_described_by_its_first_names(graph: Graph) -> None:
    pegs = [AnticipatorPeg(graph, f"p{i}", GlobalTime(float(i))) for i in range(9)]
    assert LatestPeg(graph, "end", GlobalTime(0.0), pegs).describe() == "latest of 0 s, p0, p1, p2, p3, p4, 4 more"


def test_a_detached_peg_leaves_the_shared_one_where_it_was(graph: Graph) -> None:
    shared = OffsetPeg(graph, "shared", AnticipatorPeg(graph, "hit", GlobalTime(2.0)), 0.0)
    with graph.transaction("test"):
        own = shared.detached("own", GlobalTime(0.7))
    assert (own.value, own.pinned, shared.value, shared.dependents) == (0.7, True, 2.0, {})


def test_starts_and_ends_of_blocks_are_no_followers_of_a_peg(graph: Graph) -> None:
    hit = AnticipatorPeg(graph, "hit", GlobalTime(2.0))
    near = OffsetPeg(graph, "near", hit, 0.0)
    far = OffsetPeg(graph, "far", near, 0.0)
    OffsetPeg(graph, "of the next block", LatestPeg(graph, "end", GlobalTime(0.0), (far,)), 0.0)
    assert followers_of(hit) == {near, far}


def test_a_peg_that_is_kept_before_another_one_moves_with_it_while_that_is_earlier(graph: Graph) -> None:
    hit, end = AnticipatorPeg(graph, "hit", GlobalTime(3.0)), AnticipatorPeg(graph, "end", GlobalTime(2.0))
    stroke, last = OffsetPeg(graph, "stroke", hit, 0.0), OffsetPeg(graph, "last", end, 0.0)
    follower = OffsetPeg(graph, "follower", stroke, 0.5)
    with graph.transaction("test"):
        stroke.keep_before(last)
    assert (stroke.value, follower.value) == (2.0, 2.5)
    assert stroke.describe() == "hit +0 s, not after last"
    assert [link.name for link in stroke.deciding] == ["last"]
    with graph.transaction("test"):
        end.set(GlobalTime(4.0))
    assert (stroke.value, follower.value) == (3.0, 3.5)
    assert [link.name for link in stroke.deciding] == ["hit"]


def test_a_peg_that_is_kept_before_one_that_depends_on_it_is_pinned_there(graph: Graph) -> None:
    stroke = OffsetPeg(graph, "stroke", AnticipatorPeg(graph, "hit", GlobalTime(3.0)), 0.0)
    natural = OffsetPeg(graph, "natural", stroke, 1.0)
    last = BeforePeg(graph, "last", natural, [(AnticipatorPeg(graph, "limit", GlobalTime(2.0)), 0.0)])
    with graph.transaction("test"):
        stroke.keep_before(last)
    assert (stroke.value, stroke.pinned, last.value) == (2.0, True, 2.0)


def test_a_peg_that_is_kept_before_one_that_follows_it_in_part_is_pinned_where_the_distance_is_kept(
    graph: Graph,
) -> None:
    ready = OffsetPeg(graph, "ready", AnticipatorPeg(graph, "hit", GlobalTime(3.0)), 0.0)
    stroke = RatioPeg(graph, "stroke", ready, AnticipatorPeg(graph, "end", GlobalTime(4.0)), 0.25)
    with graph.transaction("test"):
        ready.keep_before(stroke, -0.5)
    assert (ready.value, ready.pinned, stroke.value) == (2.0, True, 2.5)


def test_a_peg_that_is_kept_after_a_time_follows_its_natural_time_from_then_on(graph: Graph) -> None:
    hit = AnticipatorPeg(graph, "hit", GlobalTime(1.0))
    stroke = OffsetPeg(graph, "stroke", hit, 0.0)
    with graph.transaction("test"):
        stroke.keep_after(GlobalTime(2.0))
    assert stroke.value == 2.0
    assert stroke.describe() == "hit +0 s, not before 2 s"
    assert [link.name for link in stroke.deciding] == []
    with graph.transaction("test"):
        hit.set(GlobalTime(3.0))
    assert stroke.value == 3.0
    assert [link.name for link in stroke.deciding] == ["hit"]


def test_a_peg_can_be_kept_at_a_distance_before_another_one(graph: Graph) -> None:
    hit, end = AnticipatorPeg(graph, "hit", GlobalTime(3.0)), AnticipatorPeg(graph, "end", GlobalTime(2.0))
    ready, stroke = OffsetPeg(graph, "ready", hit, 0.0), OffsetPeg(graph, "stroke", end, 0.0)
    with graph.transaction("test"):
        ready.keep_before(stroke, -0.25)
    assert ready.value == 1.75
    assert ready.describe() == "hit +0 s, not after stroke -0.25 s"
    assert [link.name for link in ready.deciding] == ["stroke"]


def test_a_peg_that_is_kept_behind_another_one_moves_with_it_while_that_is_late(graph: Graph) -> None:
    hit, end = AnticipatorPeg(graph, "hit", GlobalTime(1.0)), AnticipatorPeg(graph, "end", GlobalTime(2.0))
    ready = OffsetPeg(graph, "ready", hit, 0.0)
    stroke = RatioPeg(graph, "stroke", ready, end, 0.25)
    with graph.transaction("test"):
        stroke.keep_behind(ready, 0.5)
    assert stroke.value == 1.5
    assert stroke.describe() == "0.25 of the way ready .. end, not before ready +0.5 s"
    assert [link.name for link in stroke.deciding] == ["ready"]
    with graph.transaction("test"):
        end.set(GlobalTime(5.0))
    assert stroke.value == 2.0


def test_a_pinned_peg_is_not_kept_behind_another_one(graph: Graph) -> None:
    ready = OffsetPeg(graph, "ready", AnticipatorPeg(graph, "hit", GlobalTime(1.0)), 0.0)
    stroke = OffsetPeg(graph, "stroke", ready, 0.0)
    with graph.transaction("test"):
        stroke.pin(GlobalTime(1.0))
        stroke.keep_behind(ready, 0.5)
    assert stroke.value == 1.0
