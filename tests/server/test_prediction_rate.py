"""A client chooses how often it receives the predictions of a block."""

import re

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.realizer.inputs import BmlText, Prediction

from .conftest import BML, OnAir, Open

BLOCK = f"""<bml {BML} id="b"><head id="h" lexeme="NOD" end="anticipators:test:hit"/>
<wait id="w" start="1.5" duration="1"/></bml>"""


async def told_while_a_prediction_moves(air: OnAir, query: str) -> list[str]:
    """The feedback of the first two seconds; the prediction moves in every tick of the first one, at last to 6 s."""
    socket = await air.connect(query)
    air.live.realizer.put(BmlText(BLOCK))
    for each in range(101):
        air.live.realizer.put(Prediction("test", "hit", GlobalTime(5 + each / 100)))
        await air.tick()
    await air.tick_until(2)
    told: list[str] = []
    while not told or "b:w:start" not in told[-1]:
        told.append((await socket.hear("feedback"))["xml"])
    return told


@pytest.mark.parametrize(("query", "most"), [("", 12), ("?predictions=100", 12), ("?predictions=2", 4)])
async def test_predictions_come_at_the_rate_that_a_client_wants_and_the_last_one_always(
    on_air: Open, query: str, most: int
) -> None:
    async with on_air() as air:
        told = await told_while_a_prediction_moves(air, query)
        predicted = [re.findall('globalEnd="(.*?)"', each) for each in told if "<predictionFeedback" in each]
        assert most - 2 <= len(predicted) <= most
        assert predicted[-1] == ["6"]


async def test_a_client_may_want_none(on_air: Open) -> None:
    async with on_air() as air:
        told = await told_while_a_prediction_moves(air, "?predictions=0")
        assert [re.findall(' id="(.*?)"', each) for each in told] == [["b:start"], ["b:w:start"]]


async def test_a_prediction_that_waits_comes_before_the_progress_of_its_block(on_air: Open) -> None:
    async with on_air() as air:
        told = await told_while_a_prediction_moves(air, "?predictions=0.01")
        predicted = [number for number, each in enumerate(told) if "<predictionFeedback" in each]
        assert predicted == [0, len(told) - 2]
        assert 'globalEnd="6"' in told[-2]


@pytest.mark.parametrize("rate", ["often", "-1", "nan", "inf", ""])
async def test_a_rate_is_a_number(on_air: Open, rate: str) -> None:
    async with on_air() as air:
        for path in ("/ws", "/feedback"):
            async with air.client.get(path, params={"predictions": rate}) as answer:
                assert (answer.status, (await answer.json())["error"]["code"]) == (400, "bad-query")
