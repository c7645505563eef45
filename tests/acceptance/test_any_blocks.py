"""Any sequence of inputs: every accepted block ends exactly once, or waits for a named point."""

import asyncio
from collections import Counter
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.testing.feedback_list import FeedbackMessage
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

SPEECH = '<speech id="{id}"{syncs}><text>Well <sync id="m"/>then.</text></speech>'
KINDS = {
    SPEECH: ("start", "end"),
    '<head id="{id}" lexeme="NOD"{syncs}/>': ("start", "stroke", "relax", "end"),
    '<head id="{id}" lexeme="SHAKE" repetition="2"{syncs}/>': ("start", "end"),
    '<gesture id="{id}" lexeme="BEAT" mode="RIGHT_HAND"{syncs}/>': ("start", "ready", "stroke", "end"),
    '<gesture id="{id}" lexeme="SAMBA"{syncs}/>': ("start",),
    '<gaze id="{id}" target="bluebox"{syncs}/>': ("start", "relax", "end"),
    '<gaze id="{id}" target="nowhere"{syncs}/>': ("end",),
    '<wait id="{id}" duration="0.3"{syncs}/>': ("start", "end"),
    '<face id="{id}"{syncs}><faceLexeme lexeme="RAISE_BROWS" amount="1"/></face>': ("start", "end"),
    '<locomotion id="{id}" target="bluebox"{syncs}/>': ("start", "end"),
    '<bmlt:magic id="{id}"{syncs}/>': ("start",),
    '<bmla:activate id="{id}" target="a"{syncs}/>': ("start",),
    '<bmlt:activate id="{id}" target="nobody"{syncs}/>': ("start", "end"),
    '<bmla:interrupt id="{id}" target="a"{syncs}/>': ("start",),
    '<bmlt:interrupt id="{id}" target="b" include="p"{syncs}/>': ("start",),
    '<bmla:interrupt id="{id}" target="c" exclude="q,r" speech="word"{syncs}/>': ("start",),
    '<bmla:parametervaluechange id="{id}" target="a:p" paramId="volume"{syncs}>'
    '<bmla:trajectory type="linear" targetValue="90"/></bmla:parametervaluechange>': ("start", "end"),
    '<bmlt:parametervaluechange id="{id}" target="b:q" paramId="amount"{syncs}>'
    '<bmlt:trajectory type="instant" initialValue="0" targetValue="7"/></bmlt:parametervaluechange>': (
        "start",
        "stroke",
    ),
}
IDS = ("p", "q", "r")
JOINS = ["appendAfter", "chunkAfter", "prependBefore", "chunkBefore", "interrupt", "onStart"]
JOINS = [f"{prefix}:{name}" for prefix in ("bmla", "bmlt") for name in JOINS]
REFS = [
    "0", "0.4", "1", "-1", "nan", "",
    *(f"{id_}:{sync}" for id_ in IDS for sync in ("start", "stroke", "m", "end", "end+0.2", "start-0.4")),
    "a:p:start", "b:q:end", "c:0.5", "nobody:p:end",
    "anticipators:t:hit", "anticipators:t:hit-0.3", "anticipators:metronome:tick1", "anticipators:spacebar:press",
    "a:relax", "b:end+0.1",
]  # fmt: skip


@st.composite
def behaviors(draw: st.DrawFn, id_: str) -> str:
    kind: str = draw(st.sampled_from(sorted(KINDS)))
    syncs = draw(st.dictionaries(st.sampled_from(KINDS[kind]), st.sampled_from(REFS), max_size=2))
    return kind.format(id=id_, syncs="".join(f' {name}="{ref}"' for name, ref in syncs.items()))


@st.composite
def blocks(draw: st.DrawFn) -> str:
    inside = [draw(behaviors(id_)) for id_ in IDS[: draw(st.integers(0, 3))]]
    if draw(st.booleans()) and len(inside) > 1:
        refs = draw(st.lists(st.sampled_from(REFS[6:30]), min_size=2, max_size=3))
        tie = "".join(f'<sync ref="{ref}"/>' for ref in refs)
        inside.append(f"<constraint><synchronize>{tie}</synchronize></constraint>")
    if draw(st.integers(0, 4)) == 0:
        inside = [f"<required>{part}</required>" for part in inside]
    if draw(st.integers(0, 3)) == 0:
        kind = draw(st.sampled_from(["after", "before"]))
        ref, sync = draw(st.tuples(st.sampled_from(REFS[6:]), st.sampled_from(REFS[6:])))
        inside.append(f'<constraint><{kind} ref="{ref}"><sync ref="{sync}"/></{kind}></constraint>')
    joins = draw(st.dictionaries(st.sampled_from(JOINS), st.sampled_from(["a", "b", "a,c", "d", "nobody"]), max_size=2))
    if draw(st.integers(0, 3)) == 0:
        joins["bmla:preplan"] = "true"
    composition = draw(st.sampled_from(["MERGE", "MERGE", "APPEND", "APPEND", "REPLACE", "SIDEWAYS"]))
    return block(draw(st.sampled_from("aabbccd")), "".join(inside), composition=composition, **joins)


STEPS = st.one_of(
    blocks(),
    blocks(),
    blocks(),
    st.sampled_from([-1.0, 0.0, 0.3, 1.0, None]).map(lambda time: ("predict", time)),
    st.sampled_from(["press", "release", "nonsense"]).map(lambda event: ("key", event)),
    st.sampled_from([30, 120, 1]).map(lambda tempo: ("tempo", tempo)),
    st.sampled_from([0.01, 0.1, 0.37, 1.0]).map(lambda time: ("advance", time)),
)


async def play(script: Any) -> None:
    async with open_pilot() as pilot:
        pilot.watch()
        for step in script:
            match step:
                case ("predict", time):
                    pilot.predict("t", "hit", time if time is None else pilot.now + time)
                case ("key", event):
                    pilot.event("spacebar", event)
                case ("tempo", tempo):
                    pilot.event("metronome", "tempo", tempo)
                case ("advance", time):
                    await pilot.advance(time)
                case _:
                    pilot.perform(step)
        await pilot.advance(8)
        check_alive(pilot)
        check_feedback(pilot)


def check_alive(pilot: RealizerPilot) -> None:
    """Blocks that have not ended wait for the missing prediction, or for a block that does."""
    scheduler = pilot.realizer.scheduler
    if scheduler.blocks.alive:
        assert scheduler.stuck(pilot.now), [b.key for b in scheduler.blocks.alive]
        scheduler.warn_stuck()
        said = len(pilot.feedback.messages)
        pilot.realizer.feedback.flush(pilot.now)
        for line in pilot.feedback.messages[said:]:
            assert "still waiting for " in line.text
            assert "still waiting for  " not in line.text


def check_feedback(pilot: RealizerPilot) -> None:
    told = pilot.feedback
    open_blocks: set[str] = set()
    reached: Counter[str] = Counter()
    for line in told.messages:
        name, _, point = line.id.partition(":")
        if line.kind == "blockProgress":
            assert (point == "start") == (name not in open_blocks) or told_revoked(line)
            if point == "start":
                open_blocks.add(name)
            if point == "end":
                open_blocks.discard(name)
                reached = Counter({id_: n for id_, n in reached.items() if not id_.startswith(f"{name}:")})
        elif line.kind == "syncPointProgress":
            assert name in open_blocks, f"{line.id} outside of its block"
            reached[line.id] += 1
            assert reached[line.id] == 1, f"{line.id} twice"
    assert open_blocks == {b.key.block for b in pilot.realizer.scheduler.blocks.alive if b.state.plays}
    for character in pilot.realizer.characters.values():
        alive = {b.key for b in pilot.realizer.scheduler.blocks.alive}
        engines = [engine for engine in character.engines if isinstance(engine, DefaultEngine)]
        assert all(unit.block in alive for engine in engines for unit in engine.player.units)


def told_revoked(line: FeedbackMessage) -> bool:
    return any(value in ("REVOKED", "FAILED") for value in line.element.attrib.values())


@settings(max_examples=20)
@given(st.lists(STEPS, min_size=1, max_size=8))
def test_any_session_comes_to_rest_with_feedback_in_order(script: Any) -> None:
    asyncio.run(play(script))
