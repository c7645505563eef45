"""Any moves of outer times: violations are reported, and points happen once, in order, and as predicted."""

import asyncio
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_reported_once
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import open_pilot

KINDS = {
    '<wait id="{}" duration="0.5"{}/>': ("start", "end"),
    '<head id="{}" lexeme="NOD"{}/>': ("start", "stroke", "end"),
    '<gesture id="{}" lexeme="BEAT" mode="RIGHT_HAND"{}/>': ("start", "ready", "stroke", "relax", "end"),
    '<gaze id="{}" target="bluebox"{}/>': ("start", "ready", "relax", "end"),
    '<speech id="{}"{}><text>Well <sync id="m"/>then, my friend.</text></speech>': ("start", "end"),
}
IDS = ("p", "q", "r")
ANTICIPATED = ("anticipators:t:one", "anticipators:t:two")


@st.composite
def refs(draw: st.DrawFn, points: list[str]) -> str:
    ref: str = draw(st.sampled_from([*points, *ANTICIPATED * 3, "0"]))
    return ref + draw(st.sampled_from(["", "", "", "+0.3", "-0.3", "+1"])) if ref != "0" else ref


@st.composite
def bodies(draw: st.DrawFn, outside: Sequence[str] = ()) -> str:
    kinds = draw(st.lists(st.sampled_from(list(KINDS)), min_size=1, max_size=3))
    points = [f"{id_}:{sync}" for id_, kind in zip(IDS, kinds, strict=False) for sync in KINDS[kind]]
    parts = []
    for id_, kind in zip(IDS, kinds, strict=False):
        others = [point for point in points if not point.startswith(id_)]
        syncs = draw(st.dictionaries(st.sampled_from(KINDS[kind]), refs([*others, *outside]), max_size=2))
        parts.append(kind.format(id_, "".join(f' {sync}="{ref}"' for sync, ref in syncs.items())))
    for _ in range(draw(st.integers(0, 2))):
        kind = draw(st.sampled_from(["after", "before"]))
        ref, sync = draw(refs([*points, *outside])), draw(st.sampled_from([*points, *ANTICIPATED]))
        parts.append(f'<constraint><{kind} ref="{ref}"><sync ref="{sync}"/></{kind}></constraint>')
    return "".join(parts)


TIMES = st.sampled_from([None, 0.0, 0.1, 0.3, 0.7, 1.5, 3.0])
MOVES = st.tuples(st.sampled_from([0.01, 0.1, 0.25, 0.6]), st.sampled_from(["one", "two"]), TIMES)


async def play(
    strategy: str, first: Any, second: Any, composition: str, moves: list[tuple[float, str, float | None]]
) -> FeedbackList:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        pilot.predict("t", "one", 1.0)
        pilot.block("b", first)
        pilot.block("c", second, composition=composition)
        for pause, sync, ahead in moves:
            await pilot.advance(pause)
            pilot.predict("t", sync, None if ahead is None else pilot.now + ahead)
        await pilot.advance(6)
        return pilot.feedback


def check(told: FeedbackList) -> None:
    # What `verify` finds has a number of the thesis; what is said of it without being asked has not.
    assert [line.text for line in told.of("warningFeedback") if "; thesis " in line.text] == []
    assert_reported_once(told)
    points = told.of("syncPointProgress")
    for behavior in {line.id.rpartition(":")[0] for line in points}:
        own = [line.global_time for line in points if line.id.startswith(f"{behavior}:")]
        assert all(earlier <= later + 1e-9 for earlier, later in pairwise(own)), behavior
    for line in points:
        assert line.global_time <= line.time + 1e-9, f"{line.id} was told before it came"


@settings(max_examples=40)
@given(st.sampled_from(["convex", "smartbody", "embr"]), bodies(), bodies(outside=["b:start", "b:p:start", "b:p:end"]),
       st.sampled_from(["MERGE", "APPEND"]), st.lists(MOVES, min_size=1, max_size=8))  # fmt: skip
def test_after_any_moves_violations_are_reported_and_points_happen_once_and_in_order(
    by: str, first: Any, second: Any, how: str, moves: list[tuple[float, str, float | None]]
) -> None:
    check(asyncio.run(play(by, first, second, how, moves)))
