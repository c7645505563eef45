"""The transitions of a block: every row of the table can be taken, and no other transition."""

import ast
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

import reactive_realizer
from reactive_realizer.bml.document import parse
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.graph import Graph
from reactive_realizer.scheduler.block_state import (
    PREDICTION,
    TRANSITIONS,
    BlockEvent,
    BlockState,
    BlockTransition,
    IllegalTransitionError,
)
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import block as bml
from reactive_realizer.testing.pilot import open_pilot

LEGAL = {(source, row.event): row for row in TRANSITIONS for source in row.sources}
PACKAGE = Path(reactive_realizer.__file__).parent
OWNERS = {
    "bml_block.py",
    "block_lifecycle.py",
    "block_plans.py",
    "block_transitions.py",
    "unit_lifecycle.py",
    "tie_release.py",
}
WRITERS = {"set_plan", "set_units", "set_predecessors", "rename_pegs", "update_end", "take_over_predecessors"}
CHANGES = {"add", "append", "clear", "discard", "remove", "update"}

NOD = '<head id="n" lexeme="NOD"/>'
BEAT = '<gesture id="g" lexeme="BEAT"/>'
SOLVED_ASIDE = "".join(f'<wait id="w{number}" duration="1"/>' for number in range(51))
REQUIRED = f"<required>{BEAT}</required>"
PREPLAN = {"bmla:preplan": "true"}
APPEND = {"composition": "APPEND"}

PLAN, PREPLANNED, ACTIVATE, START, SUBSIDE, FINISH, INTERRUPT, REVOKE, FAIL = BlockEvent


def activate(start: str) -> str:
    return f'<bmla:activate id="x" target="b" start="{start}"/>'


def interrupt(start: str) -> str:
    return f'<bmla:interrupt id="x" target="b" start="{start}"/>'


Sent = Sequence[BlockState | tuple[str, str, dict[str, str]]]

LIVES: dict[str, tuple[Sent, list[BlockEvent]]] = {
    "it plays": ([("b", NOD, {})], [PLAN, START, FINISH]),
    "it has a way back to rest": ([("b", BEAT, {})], [PLAN, START, SUBSIDE, FINISH]),
    "it is interrupted": ([("b", NOD, {}), ("c", interrupt("0.2"), {})], [PLAN, START, INTERRUPT]),
    "it is interrupted on the way back to rest": (
        [("b", BEAT, {}), ("c", interrupt("b:relax+0.1"), {})],
        [PLAN, START, SUBSIDE, INTERRUPT],
    ),
    "it is activated": ([("b", NOD, PREPLAN), ("c", activate("0.2"), {})], [PREPLANNED, ACTIVATE, START, FINISH]),
    "it is activated in preparation": (
        [("b", SOLVED_ASIDE, PREPLAN), ("c", "", {"bmla:onStart": "b"})],
        [ACTIVATE, PLAN, START, FINISH],
    ),
    "it is revoked in preparation": ([("b", NOD, {}), ("c", "", {"composition": "REPLACE"})], [REVOKE]),
    "it is revoked before its activation": ([("b", NOD, PREPLAN), ("c", interrupt("0.2"), {})], [PREPLANNED, REVOKE]),
    "it is revoked while it waits": (
        [("a", NOD, {}), ("b", NOD, APPEND), ("c", interrupt("0.2"), {})],
        [PLAN, REVOKE],
    ),
    "it cannot be planned": ([("b", '<required><wait id="w" start="nobody:end"/></required>', {})], [FAIL]),
    "its engines fail before its activation": ([("b", REQUIRED, PREPLAN), BlockState.PENDING], [PREPLANNED, FAIL]),
    "its engines fail while it waits": ([("a", NOD, {}), ("b", REQUIRED, APPEND), BlockState.LURKING], [PLAN, FAIL]),
    "its engines fail while it plays": ([("b", REQUIRED, {}), BlockState.IN_EXEC], [PLAN, START, FAIL]),
    "its engines fail on the way back": ([("b", REQUIRED, {}), BlockState.SUBSIDING], [PLAN, START, SUBSIDE, FAIL]),
}
"""The blocks that are sent, with the state of block b in which the engines fail, if any; the events of block b."""


def make_block() -> BMLBlock:
    (parsed,) = parse(bml("b"), Limits())
    assert parsed.block
    return BMLBlock(PegBoard(Graph()), BlockKey("alice", "b"), parsed.block, 1, GlobalTime(0.0), (), "")


def path_to(state: BlockState) -> tuple[BlockEvent, ...]:
    """Events that lead a new block to a state."""
    paths: dict[BlockState, tuple[BlockEvent, ...]] = {BlockState.IN_PREP: ()}
    while state not in paths:
        for row in TRANSITIONS:
            for source in row.sources:
                if source in paths:
                    paths.setdefault(row.target, (*paths[source], row.event))
    return paths[state]


@pytest.mark.parametrize("event", BlockEvent)
@pytest.mark.parametrize("state", BlockState)
def test_a_block_takes_the_transitions_of_the_table_and_no_other(state: BlockState, event: BlockEvent) -> None:
    block = make_block()
    for each in path_to(state):
        block.take(each)
    assert block.state is state
    if (state, event) in LEGAL:
        assert block.take(event) is LEGAL[state, event]
        assert block.state is LEGAL[state, event].target
    else:
        with pytest.raises(IllegalTransitionError):
            block.take(event)
        assert block.state is state


@pytest.fixture
def taken(monkeypatch: pytest.MonkeyPatch) -> list[BlockTransition]:
    """The transitions that block b has taken."""
    found = []
    original = BMLBlock.take

    def take(block: BMLBlock, event: BlockEvent) -> BlockTransition:
        row = original(block, event)
        if block.key.block == "b":
            found.append(row)
        return row

    monkeypatch.setattr(BMLBlock, "take", take)
    return found


def fail(tick: Tick) -> Play:
    raise RuntimeError


async def live(sent: Sent, taken: list[BlockTransition]) -> FeedbackList:
    """The feedback of blocks that are sent at once; the engines fail when block b enters a state that is listed."""
    async with open_pilot() as pilot:
        for each in sent:
            if not isinstance(each, BlockState):
                id_, behaviors, attributes = each
                pilot.block(id_, behaviors, **attributes)
        for _ in range(400):
            await pilot.tick()
            block = pilot.realizer.scheduler.blocks.get(BlockKey("alice", "b"))
            if block is None:
                break
            assert all(block.peg(point).pinned for row in taken for point in row.pins)
            if block.state in sent:
                for engine in pilot.realizer.characters["alice"].engines:
                    engine.play = fail  # type: ignore[method-assign]
                    if isinstance(engine, DefaultEngine):
                        for unit in engine.player.units:
                            engine.player.note(unit)
        return pilot.feedback


@pytest.mark.parametrize(("sent", "events"), LIVES.values(), ids=LIVES)
async def test_a_block_pins_and_reports_what_the_table_says(
    taken: list[BlockTransition], sent: Sent, events: list[BlockEvent]
) -> None:
    feedback = await live(sent, taken)
    assert [row.event for row in taken] == events
    reports = [f"b:{sync}" for row in taken for sync in row.reports if sync != PREDICTION]
    assert [line.id for line in feedback.of("blockProgress") if line.id.startswith("b:")] == reports


def test_the_lives_cover_every_row_of_the_table() -> None:
    rows = set()
    for _, events in LIVES.values():
        state = BlockState.IN_PREP
        for event in events:
            rows.add((state, event))
            state = LEGAL[state, event].target
    assert rows == LEGAL.keys()


def test_only_the_lifecycle_writes_blocks() -> None:
    fields = {each for each in vars(make_block()) if not each.startswith("_")}
    for path in sorted((PACKAGE / "scheduler").rglob("*.py")):
        if path.name not in OWNERS:
            assert not fields & set(written(path)), path.name
            assert not WRITERS & set(called(path)), path.name


def written(path: Path) -> Iterator[str]:
    """The attributes of blocks that a module assigns or changes."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield from attribute_of_block(node)
        if isinstance(node, ast.Attribute) and node.attr in CHANGES:
            yield from attribute_of_block(node.value)


def attribute_of_block(node: ast.AST) -> list[str]:
    if not isinstance(node, ast.Attribute) or not isinstance(node.value, ast.Name):
        return []
    return [node.attr] if node.value.id in ("block", "other", "later") else []


def called(path: Path) -> Iterator[str]:
    """The functions, classes and methods that a module calls, and the tuples that it makes."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute | ast.Name):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else node.func.id
            yield node.args[0].id if name == "_tuple" and isinstance(node.args[0], ast.Name) else name


def test_sync_points_are_reported_in_one_place() -> None:
    calls = [(path.name, {*called(path)}) for path in sorted(PACKAGE.rglob("*.py"))]
    assert [name for name, own in calls if "SyncPointProgress" in own] == ["block_feedback.py"]
    assert [name for name, own in calls if "sync_point_reached" in own] == ["unit_lifecycle.py"]
