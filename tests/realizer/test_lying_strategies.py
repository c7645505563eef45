"""`--verify` reports a strategy that breaks constraints without a loss: equation, points and amount."""

import re
from collections.abc import AsyncIterator, Callable, Sequence

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.scheduler.problem import Item, Point, SchedulingProblem
from reactive_realizer.scheduler.solution import Solution
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

BLOCK = (
    '<wait id="w" duration="1" start="0.5"/><head id="n" lexeme="NOD" start="w:end"/>'
    '<head id="m" lexeme="NOD" stroke="anticipators:partner:hit"/>'
)
HIT = "anticipators:partner:hit"

_SAID = re.compile(r"is missed by (\S+) s \((.*); thesis (.*)\)")


Lie = Callable[[Item, list[float]], Sequence[float]]


def untied(item: Item, times: list[float]) -> Sequence[float]:
    """A plan as if there were no constraints."""
    return item.timing.offsets


def early(item: Item, times: list[float]) -> list[float]:
    """A plan that is 0.6 s early."""
    return [time - 0.6 for time in times]


def swapped(item: Item, times: list[float]) -> list[float]:
    """A plan with the stroke and the relax of nods exchanged."""
    if item.behavior.id == "w":
        return times
    *before, stroke, stroke_end, relax, end = times
    return [*before, relax, stroke_end, stroke, end]


def pressed(item: Item, times: list[float]) -> list[float]:
    """A plan in which all points of a behavior come at once."""
    return [times[0]] * len(times)


def lie(
    pilot: RealizerPilot,
    monkeypatch: pytest.MonkeyPatch,
    told: Lie,
    *,
    of: int = 1,
) -> None:
    """Have the strategy give wrong plans without losses from its solution number ``of`` on."""
    honest, asked = pilot.realizer._strategy.solve, []

    def solve(problem: SchedulingProblem) -> Solution:
        asked.append(problem)
        solution = honest(problem)
        return answer(problem, solution, told) if len(asked) >= of else solution

    monkeypatch.setattr(pilot.realizer._strategy, "solve", solve)


def answer(problem: SchedulingProblem, solution: Solution, told: Lie) -> Solution:
    times: dict[Point, float] = {}
    for item in problem.items:
        points = [Point(item.behavior.id, sync) for sync in item.timing.points]
        times |= dict(zip(points, told(item, [solution.times[point] for point in points]), strict=True))
    return Solution(times, ())


def seen(pilot: RealizerPilot) -> list[tuple[str, str, object]]:
    """The violations reported for block b: equation, points and amount (s)."""
    texts = [line.text for line in pilot.feedback.of("warningFeedback") if line.id == "b"]
    found = [match.groups() for text in texts if (match := _SAID.search(text))]
    return [(equation, points, pytest.approx(float(amount), abs=1e-7)) for amount, points, equation in found]


AT_START, AT_HIT = ("7.8", "w:start, block start"), ("7.32", f"m:stroke, {HIT}")
NO_TIME = [("7.14", f"{id_}:start, {id_}:end", SHORTEST) for id_ in "wnm"]
HALF_A_NOD = 0.05
"""Time that the head needs for each half of a stroke, as warnings show it, s."""
HURRIED = [
    ("7.2.1", f"{id_}:{first}, {id_}:{last}", HALF_A_NOD)
    for id_ in "nm"
    for first, last in (("strokeStart", "stroke"), ("stroke", "strokeEnd"))
]
LIES = [
    (untied, [(*AT_START, 0.5), ("7.11", "n:start, w:end", 1.0), (*AT_HIT, 2.65)]),
    (early, [(*AT_START, 0.6), (*AT_HIT, 0.6), ("7.13", "w:start", 0.1)]),
    (
        pressed,
        [("7.11", "n:start, w:end", 1.0), (*AT_HIT, 0.35), *NO_TIME, ("7.1.4", "w:start, w:end", 1.0), *HURRIED],
    ),
    (
        swapped,
        [(*AT_HIT, 0.35), *(("7.15", f"{id_}:strokeEnd, {id_}:relax", 0.35) for id_ in "nm"), *HURRIED[1::2]],
    ),
]


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.predict("partner", "hit", 3.0)
        yield pilot


@pytest.mark.parametrize(("told", "broken"), LIES, ids=[told.__name__ for told, _ in LIES])
async def test_a_wrong_plan_is_reported_with_equations_points_and_amounts(
    pilot: RealizerPilot,
    monkeypatch: pytest.MonkeyPatch,
    told: Lie,
    broken: list[tuple[str, str, float]],
) -> None:
    lie(pilot, monkeypatch, told)
    pilot.block("b", BLOCK)
    await pilot.advance(5)
    assert seen(pilot) == broken


@pytest.mark.parametrize(("told", "broken"), LIES, ids=[told.__name__ for told, _ in LIES])
async def test_a_wrong_plan_of_a_block_that_is_not_activated_is_reported(
    pilot: RealizerPilot,
    monkeypatch: pytest.MonkeyPatch,
    told: Lie,
    broken: list[tuple[str, str, float]],
) -> None:
    lie(pilot, monkeypatch, told)
    pilot.block("b", BLOCK, **{"bmla:preplan": "true"})
    await pilot.advance(0.1)
    assert seen(pilot) == broken


async def test_a_wrong_plan_of_a_chunk_that_is_planned_again_at_its_start_is_reported(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    lie(pilot, monkeypatch, early, of=3)
    pilot.block("a", '<wait id="w" duration="1"/>')
    pilot.block("b", '<wait id="v" duration="1" start="0.5"/>', **{"bmla:chunkAfter": "a"})
    await pilot.advance(0.9)
    assert seen(pilot) == []
    await pilot.advance(0.2)
    assert seen(pilot) == [("7.8", "v:start, block start", 0.6), ("7.13", "v:start", 0.1)]


async def test_a_wrong_plan_of_a_big_block_that_is_solved_in_a_thread_is_reported(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    lie(pilot, monkeypatch, untied)
    pilot.block("b", "".join(f'<wait id="w{i}" duration="1" start="1"/>' for i in range(60)))
    await pilot.advance(0.5)
    assert seen(pilot) == [("7.8", f"w{i}:start, block start", 1.0) for i in range(60)]


async def test_times_that_moved_while_a_block_was_solved_are_no_violation(pilot: RealizerPilot) -> None:
    """A wait ends in time when the block is solved for the third time, and no longer when that is committed."""
    pilot.predict("partner", "start", 2.0)
    before = f'<constraint><before ref="{HIT}"><sync ref="w:end"/></before></constraint>'
    rest = "".join(f'<wait id="w{i}" duration="1"/>' for i in range(60))
    pilot.block("b", f'<wait id="w" duration="1" start="anticipators:partner:start"/>{before}{rest}')
    for hit in (3.0, 3.0, 3.2, 3.0, 2.5):
        pilot.predict("partner", "hit", hit)
        await pilot.tick()
    await pilot.advance(4)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "no longer holds" in warning.text
