"""Predictions over the socket and over HTTP move pegs while the body moves."""

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from reactive_realizer.embodiment.frame import Frame

from .conftest import BML, OnAir, Open, Socket

BEAT = (
    f'<bml {BML} id="b1"><gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:test:hit"/></bml>'
    f'<bml {BML} id="b2" composition="APPEND"><wait id="w" duration="0.1"/></bml>'
)


class Hand:
    """The positions of the right wrist, m."""

    def __init__(self, air: OnAir) -> None:
        self.places: list[Any] = []
        air.live.realizer.watch(self)
        self._humanoid = air.live.realizer.characters["alice"].humanoid

    def __call__(self, _: Mapping[str, Frame]) -> None:
        self.places.append(self._humanoid.locate("r_wrist"))

    @property
    def longest_step(self) -> float:
        return float(np.linalg.norm(np.diff(np.array(self.places), axis=0), axis=1).max())


async def predict_by_socket(air: OnAir, socket: Socket, time: float) -> None:
    assert (await socket.ask(type="predict", anticipator="test", sync="hit", time=time))["type"] == "accepted"


async def predict_by_post(air: OnAir, socket: Socket, time: float) -> None:
    said = json.dumps({"anticipator": "test", "sync": "hit", "time": time})
    async with air.client.post("/predict", data=said) as answer:
        assert answer.status == 202


@pytest.mark.parametrize("predict", [predict_by_socket, predict_by_post])
async def test_a_stroke_follows_its_prediction_while_the_arm_moves(on_air: Open, predict: Any) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        hand = Hand(air)
        await predict(air, socket, 1.5)
        assert (await socket.ask(type="bml", xml=BEAT))["type"] == "accepted"
        await air.tick_until(1.2)
        ends = [await predicted_end(socket, "b1")]
        for time in (1.8, 1.6):
            await predict(air, socket, time)
            await air.tick_until(air.live.realizer.time + 0.1)
            ends.append(await predicted_end(socket, "b1"))
        await air.tick_until(5.0)

        assert ends[1] - ends[0] == pytest.approx(0.3, abs=2e-3)
        assert ends[2] - ends[1] == pytest.approx(-0.2, abs=2e-3)
        assert 'globalTime="1.6"' in (await socket.hear_feedback('id="b1:g:stroke"'))["xml"]
        ended = (await socket.hear_feedback('id="b1:end"'))["xml"]
        started = (await socket.hear_feedback('id="b2:start"'))["xml"]
        assert attribute(ended, "globalTime") == pytest.approx(ends[2], abs=2e-3)
        assert attribute(started, "globalTime") == attribute(ended, "globalTime")
        assert hand.longest_step < 0.05


async def predicted_end(socket: Socket, block: str) -> float:
    """The last reported prediction of a block's end."""
    await socket.say(type="clock")
    end = None
    while (message := await socket.hear("feedback", "clock"))["type"] != "clock":
        if f'<bml id="{block}"' in message["xml"]:
            end = attribute(message["xml"], "globalEnd")
    assert end is not None, "nothing was predicted anew"
    return end


def attribute(xml: str, name: str) -> float:
    return float(xml.partition(f'{name}="')[2].partition('"')[0])


async def test_a_prediction_may_be_withdrawn_and_repeated(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        xml = f'<bml {BML} id="b1"><wait id="w" start="anticipators:test:hit" duration="0.1"/></bml>'
        await predict_by_socket(air, socket, 0.5)
        assert (await socket.ask(type="bml", xml=xml))["type"] == "accepted"
        await air.tick_until(0.2)
        withdrawn = await socket.ask(type="predict", anticipator="test", sync="hit", time=None)
        assert withdrawn["type"] == "accepted"
        await air.tick_until(1.0)
        assert (await socket.ask(type="predict", anticipator="test", sync="hit", **{"in": 0.25}))["type"] == "accepted"
        await air.tick_until(1.5)
        assert 'globalTime="1.25"' in (await socket.hear_feedback('id="b1:w:start"'))["xml"]


async def test_a_prediction_for_the_past_means_now(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        xml = f'<bml {BML} id="b1"><wait id="w" start="anticipators:test:hit" duration="0.1"/></bml>'
        assert (await socket.ask(type="bml", xml=xml))["type"] == "accepted"
        await air.tick_until(1.0)
        await predict_by_socket(air, socket, 0.2)
        await air.tick_until(1.5)
        assert 'globalTime="1.01"' in (await socket.hear_feedback('id="b1:w:start"'))["xml"]


async def test_the_frames_show_the_arm_on_its_way_to_the_stroke(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        arm = socket.hello["characters"][0]["joints"].index("RightArm")
        await predict_by_socket(air, socket, 1.0)
        assert (await socket.ask(type="bml", xml=BEAT))["type"] == "accepted"
        turned = []
        for _ in range(50):
            await air.tick()
            await air.tick()
            turned.append(struct.unpack_from("<4h", await socket.see(), 32 + 8 * arm))
        turn = np.array(turned) / 32767
        assert np.abs(np.sum(turn[0] * turn[-1])) < 0.98, "it is somewhere else"
        assert np.abs(np.sum(turn[:-1] * turn[1:], axis=1)).min() > 0.99, "it came there by and by"
