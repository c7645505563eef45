"""Scripts of the BMLRealizerTester suite with what their comments ask for, and for each a script of our own.

What holds for every script is asserted as in the thesis, 9.3: nothing is told twice, and sync points come in order,
between the start and the end of their block.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import pytest

from reactive_realizer.testing.assertions import (
    assert_block_around,
    assert_ended,
    assert_linked,
    assert_order,
    assert_relative_time,
    assert_reported_once,
    assert_warnings,
)
from reactive_realizer.testing.pilot import RealizerPilot

OWN_SCRIPTS = Path(__file__).parent.parent / "data" / "bml"


@dataclass(frozen=True)
class Script:
    """A script and what is to come of it; the block's id stands before the points.

    Attributes:
        times: point -> global time, s.
        links: points that are one.
        order: points, each at or after the one before it.
        warnings: the only ones that come.
    """

    file: str
    block: str = "bml1"
    times: dict[str, float] = field(default_factory=dict)
    links: tuple[tuple[str, str], ...] = ()
    order: tuple[str, ...] = ()
    warnings: tuple[tuple[str, str], ...] = ()


PAIRS = [
    (Script("core/empty.xml"), Script("empty.xml", "nothing")),
    (
        Script("core/testspeech.xml", times={"speech1:start": 0}, order=("speech1:start", "speech1:end")),
        Script("speech.xml", "hello", times={"greeting:start": 0}, order=("greeting:start", "greeting:end")),
    ),
    (
        Script(
            "core/testspeech_nodtimedtosync.xml",
            times={"speech1:start": 6, "nod1:end": 9},
            links=(("speech1:syncstart1", "nod1:start"),),
        ),
        Script(
            "speech_nod_at_mark.xml",
            "agree",
            times={"answer:start": 2, "nod:end": 6},
            links=(("answer:yes", "nod:start"),),
        ),
    ),
    (
        Script(
            "core/testspeechandnod_synctimed.xml",
            times={"speech1:s1": 10},
            links=(("speech1:start", "nod1:start"),),
            order=("speech1:start", "speech1:s1", "speech1:end"),
        ),
        Script(
            "speech_mark_pinned.xml",
            "pinned",
            times={"count:go": 4},
            links=(("count:start", "nod:start"),),
            order=("count:start", "count:go", "count:end"),
        ),
    ),
    (
        Script("core/testnodlong.xml", times={"nod1:start": 0, "nod1:end": 5}),
        Script("long_nod.xml", "slow", times={"nod:start": 0, "nod:end": 4}),
    ),
    (
        Script(
            "core/testgaze.xml",
            times={"gaze1:start": 1, "gaze1:end": 10},
            order=("gaze1:start", "gaze1:ready", "gaze1:relax", "gaze1:end"),
        ),
        Script(
            "gaze.xml",
            "look",
            times={"away:start": 1, "away:end": 5},
            order=("away:start", "away:ready", "away:relax", "away:end"),
        ),
    ),
    (
        Script("core/testgazeoverlap.xml", warnings=(("gaze2", "IMPOSSIBLE_TO_SCHEDULE"),), times={"gaze1:end": 10}),
        Script("gaze_overlap.xml", "squint", warnings=(("two", "IMPOSSIBLE_TO_SCHEDULE"),), times={"one:end": 4}),
    ),
    (
        Script("core/testbeatgesture.xml", order=("g1:start", "g1:stroke", "g1:end")),
        Script(
            "beats.xml",
            "beats",
            times={"right:start": 0.5},
            order=("right:end", "left:start", "left:end", "both:start", "any:start", "between:start", "again:end"),
        ),
    ),
    (
        Script(
            "asap/chunking/firstchunk.xml",
            times={"speech1:start": 5},
            links=(("speech1:chunk", "g1:stroke"),),
        ),
        Script("hyphens.xml", "block-1", links=(("speech-1:mark-2", "beat-1:stroke"),)),
    ),
    (
        Script("asap/interruptbehavior/testlongspeechandnod.xml", links=(("speech1:s1", "nod1:start"),)),
        Script("nod_between_marks.xml", "between", links=(("news:sure", "nod:start"),)),
    ),
]


def name(script: Script) -> str:
    return script.file


async def assert_comes_out(pilot: RealizerPilot, script: Script) -> None:
    await pilot.advance(40)
    told, block = pilot.feedback, script.block
    assert_warnings(told, *((f"{block}:{id_}", kind) for id_, kind in script.warnings))
    assert_reported_once(told)
    assert_block_around(told, block)
    assert_ended(told, block)
    times = [line.global_time for line in told.of("syncPointProgress")]
    assert times == sorted(times)
    for point, time in script.times.items():
        assert_relative_time(told, f"{block}:{point}", time)
    for one, other in script.links:
        assert_linked(told, f"{block}:{one}", f"{block}:{other}")
    for earlier, later in pairwise(script.order):
        assert_order(told, f"{block}:{earlier}", f"{block}:{later}")


@pytest.mark.parametrize("script", [theirs for theirs, _ in PAIRS], ids=name)
async def test_a_script_of_the_suite_plays_as_its_comments_require(
    pilot: RealizerPilot, shared_cases: Path, script: Script
) -> None:
    pilot.perform((shared_cases / "realizertester" / "bml-1" / script.file).read_bytes())
    await assert_comes_out(pilot, script)


@pytest.mark.parametrize("script", [own for _, own in PAIRS], ids=name)
async def test_our_version_of_a_script_plays_as_it_requires(pilot: RealizerPilot, script: Script) -> None:
    pilot.perform((OWN_SCRIPTS / script.file).read_bytes())
    await assert_comes_out(pilot, script)


async def test_a_block_without_an_id_is_refused_with_one_warning(pilot: RealizerPilot) -> None:
    pilot.perform((OWN_SCRIPTS / "no_id.xml").read_bytes())
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("bml", "PARSING_FAILURE")]
    assert pilot.feedback.progress == []
