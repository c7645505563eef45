"""Tasks that work in turns let others go on in between."""

import asyncio
import re

import pytest

from reactive_realizer.server.turns import Turns


async def test_another_task_goes_on_after_each_turn() -> None:
    turns, order = Turns(), list[str]()

    async def work(name: str) -> None:
        for _ in range(3):
            async with turns:
                order.append(name)

    async def tick() -> None:
        while order.count("a") + order.count("b") < 6:
            order.append(".")
            await asyncio.sleep(0)

    await asyncio.gather(work("a"), work("b"), tick())
    trace = "".join(order)
    assert trace.replace(".", "") == "ababab"
    assert not re.search(r"[ab]{2}", trace)


async def test_a_turn_that_fails_ends() -> None:
    turns = Turns()
    with pytest.raises(ValueError):
        async with turns:
            raise ValueError
    async with asyncio.timeout(1), turns:
        pass
