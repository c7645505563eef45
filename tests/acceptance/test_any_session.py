"""Any events, activations and blocks that wait: no sync point comes before its block, nor is one reported before."""

import asyncio
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_reported_once
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

KINDS = {
    '<head id="{}" lexeme="NOD"{}/>': ("start", "stroke", "end"),
    '<gesture id="{}" lexeme="BEAT" mode="LEFT_HAND"{}/>': ("start", "stroke", "end"),
    '<gaze id="{}" target="bluebox"{}/>': ("start", "ready", "end"),
    '<speech id="{}"{}><text>Well <sync id="m"/>then.</text></speech>': ("start", "end"),
    '<wait id="{}" duration="0.4"{}/>': ("start", "end"),
    '<bmla:activate id="{}" target="p1"{}/>': ("start",),
}
IDS = ("x", "y", "z")
EVENTS = ("spacebar:release", "spacebar:press", "t:hit", "metronome:tick1", "metronome:tick2")
OFFSETS = st.sampled_from(["", "", "+0.2", "-0.2", "+1"])


@st.composite
def behaviors(draw: st.DrawFn) -> str:
    parts = []
    kinds = draw(st.lists(st.sampled_from(list(KINDS)), min_size=1, max_size=3))
    points = [f"{id_}:{sync}" for id_, kind in zip(IDS, kinds, strict=False) for sync in KINDS[kind]]
    outside = [f"anticipators:{event}" for event in EVENTS] + ["p0:x:start", "p1:x:end", "m:start"]
    for id_, kind in zip(IDS, kinds, strict=False):
        others = [point for point in points if not point.startswith(id_)]
        refs = st.tuples(st.sampled_from([*others, *outside, *outside]), OFFSETS).map("".join)
        ties = draw(st.dictionaries(st.sampled_from(KINDS[kind]), refs, max_size=2))
        parts.append(kind.format(id_, "".join(f' {sync}="{ref}"' for sync, ref in ties.items())))
    return "".join(parts)


INPUTS = st.one_of(
    st.tuples(st.just("release"), st.none()),
    st.tuples(st.just("press"), st.none()),
    st.tuples(st.just("hit"), st.sampled_from([None, 0.0, 0.1, 0.5, 2.0])),
    st.tuples(st.just("merge"), behaviors()),
    st.tuples(st.just("append"), behaviors()),
    st.tuples(st.just("activate"), st.sampled_from(["p0", "p1"])),
    st.tuples(st.just("interrupt"), st.sampled_from(["p0", "b0", "b1"])),
)
PAUSES = st.sampled_from([0.0, 0.01, 0.13, 0.5, 0.9])


def enter(pilot: RealizerPilot, number: int, kind: str, value: Any) -> None:
    match kind:
        case "release" | "press":
            pilot.event("spacebar", kind)
        case "hit":
            pilot.predict("t", "hit", None if value is None else pilot.now + value)
        case "merge" | "append":
            pilot.block(f"b{number}", value, composition=kind.upper())
        case _:
            pilot.block(f"c{number}", f'<bmla:{kind} id="i" target="{value}"/>')


async def play(strategy: str, prepared: list[str], script: list[tuple[float, tuple[str, Any]]]) -> FeedbackList:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        pilot.block("m", '<wait id="w" duration="1.5"/>')
        for number, each in enumerate(prepared):
            pilot.block(f"p{number}", each, **{"bmla:preplan": "true"})
        for number, (pause, (kind, value)) in enumerate(script):
            await pilot.advance(pause)
            enter(pilot, number, kind, value)
        await pilot.advance(4)
        return pilot.feedback


@settings(max_examples=15)
@given(
    st.sampled_from(["convex", "embr", "smartbody"]),
    st.lists(behaviors(), min_size=2, max_size=2),
    st.lists(st.tuples(PAUSES, INPUTS), min_size=3, max_size=9),
)
def test_no_sync_point_comes_before_its_block_nor_is_one_reported_before(
    strategy: str, prepared: list[str], script: list[tuple[float, tuple[str, Any]]]
) -> None:
    told = asyncio.run(play(strategy, prepared, script))
    assert_reported_once(told)
    started: dict[str, float] = {}
    for line in told.messages:
        block, _, point = str(line.id).partition(":")
        if line.kind == "blockProgress" and point == "start":
            started[block] = line.global_time
        elif line.kind == "syncPointProgress":
            assert block in started, f"{line.id} was reported before its block started"
            assert line.global_time >= started[block] - 1e-9, line.id
    for prediction in told.of("predictionFeedback"):
        times = [time for element in prediction.element.iter() for time in element.attrib.values()]
        assert not any(str(time).startswith("-") for time in times), times
    assert [line.text for line in told.of("warningFeedback") if "; thesis " in line.text] == []
