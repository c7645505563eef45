"""Runs the contract for strategies on all built-in strategies, and the examples of the thesis."""

import pytest

from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.embr.embr_strategy import EmbrStrategy
from reactive_realizer.scheduler.problem import Item, Origin, Precedence, Tie
from reactive_realizer.scheduler.smartbody.smartbody_strategy import SmartBodyStrategy
from reactive_realizer.scheduler.strategy import SchedulingStrategy, solve
from reactive_realizer.testing.problems import TIMINGS, after, at, item, problem
from reactive_realizer.testing.strategy_contract import CompleteStrategyContract, StrategyContract, violations

pytestmark = pytest.mark.no_cover  # Other tests cover the same lines, and tracing so many plans takes long.


class TestSmartBody(StrategyContract):
    strategy = SmartBodyStrategy()


class TestEmbr(CompleteStrategyContract):
    strategy = EmbrStrategy()


class TestConvex(CompleteStrategyContract):
    strategy = ConvexStrategy()


START = Origin.BLOCK_START
NOD, BEAT, SPEECH = TIMINGS["nod"], TIMINGS["beat"], TIMINGS["speech"]
WALK = timing_at({"start": 0.0, "relax": 3.0, "end": 3.5}, PhaseKind.ELASTIC)

EXAMPLES: dict[str, tuple[list[Item], list[Tie | Precedence]]] = {
    "26": (
        [item("speech1", SPEECH), item("point1", BEAT), item("walk1", WALK)],
        [
            at("point1:stroke", "speech1:sync1"),
            after("point1:start", "walk1:relax"),
            after("speech1:start", START, 2.0),
        ],
    ),
    "27": (
        [item("speech1", SPEECH), item("nod1", NOD)],
        [at("nod1:start", "speech1:start"), at("nod1:end", "speech1:sync1")],
    ),
    "28": (
        [item("nod1", NOD), item("beat1", BEAT)],
        [at("nod1:start", START, 3.0), at("nod1:end", START, 5.0), at("beat1:stroke", "nod1:stroke")],
    ),
    "29": (
        [item("g1", BEAT), item("g2", BEAT), item("nod1", NOD)],
        [at("g2:start", "g1:end"), at("nod1:start", "g1:start", -2.0), at("nod1:end", "g2:end", 3.0)],
    ),
}
"""In the order in which the thesis prints them; "b" is the reverse order."""

LOST: dict[str, dict[str, int]] = {
    "smartbody": {"26": 2, "26b": 2, "28b": 1, "29b": 1},
    "embr": {},
    "convex": {},
}
"""The number of losses of each strategy (thesis 7.2.2, 7.2.3, 7.3.5)."""


@pytest.mark.parametrize(
    "strategy", [SmartBodyStrategy(), EmbrStrategy(), ConvexStrategy()], ids=lambda each: each.name
)
@pytest.mark.parametrize("name", [f"{number}{order}" for number in EXAMPLES for order in ("", "b")])
def test_examples_of_the_thesis_have_the_known_losses_in_both_orders(strategy: SchedulingStrategy, name: str) -> None:
    items, constraints = EXAMPLES[name.removesuffix("b")]
    turn = -1 if name.endswith("b") else 1
    asked = problem(items[::turn], *constraints)
    solution = solve(strategy, asked)
    assert len(solution.losses) == LOST[strategy.name].get(name, 0)
    assert violations(asked, solution) == []
