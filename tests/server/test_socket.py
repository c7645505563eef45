"""The WebSocket: hello, BML, feedback, frames, and requests."""

import struct
from typing import Any

import numpy as np
import pytest

from anticipators.metronome import Metronome

from .conftest import ALICE, BML, Open, wait

TWO = ALICE + '[character.bert]\navatar = "avatars/male.glb"\nposition = [1.0, 0.0, 0.0]\n'


def frames_of(message: bytes) -> list[bytes]:
    """The frames in a message, one for each character."""
    frames = []
    while message:
        joints, morphs = struct.unpack_from("<HH", message, 16)
        size = 32 + 8 * joints + 2 * morphs
        frames.append(message[:size])
        message = message[size:]
    return frames


async def test_the_first_message_has_the_characters_and_the_order_of_their_bones(on_air: Open) -> None:
    async with on_air(TWO) as air:
        hello = (await air.connect()).hello
        assert hello["type"] == "hello"
        assert hello["protocol"] == 2
        assert hello["session"] == air.live.session
        assert [(who["id"], who["index"], who["avatar"]) for who in hello["characters"]] == [
            ("alice", 0, "/avatars/female.glb"),
            ("bert", 1, "/avatars/male.glb"),
        ]
        assert hello["characters"][0]["joints"][0] == "Hips"
        assert "jawOpen" in hello["characters"][0]["morphs"]
        assert hello["demo"] is False


async def test_a_document_may_name_the_media_type_of_its_dialect(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await socket.say(type="bml", xml=wait("b1"), mediaType="application/bml+xml", ref="own")
        assert (await socket.hear("accepted"))["blocks"] == ["b1"]
        await socket.say(type="bml", xml=wait("b2"), mediaType="text/x-unknown", ref="other")
        assert (await socket.hear("error"))["code"] == "wrong-media-type"


async def test_bml_is_accepted_with_its_ref_and_reported_in_feedback(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await socket.say(type="bml", xml=wait("b1"), ref="mine")
        assert await socket.hear("accepted") == {"type": "accepted", "ref": "mine", "blocks": ["b1"], "warnings": []}
        await air.tick_until(0.3)
        started = await socket.hear_feedback('id="b1:start"')
        ended = await socket.hear_feedback('id="b1:end"')
        assert started["session"] == air.live.session
        assert ended["time"] == pytest.approx(started["time"] + 0.1)
        assert ended["seq"] > started["seq"]


async def test_feedback_messages_have_posix_times_in_milliseconds(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        air.live.feedback._epoch = 1_000_000.0
        assert (await socket.ask(type="bml", xml=wait("b1", 0.25)))["type"] == "accepted"
        await air.tick_until(0.4)
        assert (
            'bmla:posixStartTime="1000000000" bmla:posixEndTime="1000000250"'
            in (await socket.hear_feedback("predictionFeedback"))["xml"]
        )
        assert 'bmla:posixTime="1000000000"' in (await socket.hear_feedback('id="b1:w:start"'))["xml"]
        assert 'bmla:posixTime="1000000250"' in (await socket.hear_feedback('id="b1:end"'))["xml"]


async def test_every_character_has_fifty_frames_per_second_of_its_clock(on_air: Open) -> None:
    async with on_air(TWO) as air:
        socket = await air.connect()
        await air.tick_until(0.06)
        messages = [frames_of(await socket.see()) for _ in range(4)]
        headers = [[struct.unpack_from("<BBHIdHH", frame) for frame in message] for message in messages]
        assert [[header[2] for header in message] for message in headers] == [[0, 1]] * 4
        assert [[header[3] for header in message] for message in headers] == [[n, n] for n in range(4)]
        assert [[header[4] for header in message] for message in headers] == [[t, t] for t in (0, 0.02, 0.04, 0.06)]
        for character, header in zip(socket.hello["characters"], headers[0], strict=True):
            assert header[5:] == (len(character["joints"]), len(character["morphs"]))


async def test_the_characters_are_at_the_positions_of_the_human_file(on_air: Open) -> None:
    async with on_air(TWO) as air:
        socket = await air.connect()
        await air.tick()
        alice, bert = [struct.unpack_from("<3f", frame, 20) for frame in frames_of(await socket.see())]
        assert alice[0] == pytest.approx(0, abs=0.05)  # idle animation sways the body
        assert bert[0] == pytest.approx(1, abs=0.05)
        assert 0.8 < alice[1] < 1.1


async def test_no_pose_is_composed_without_a_client_for_frames(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=feedback")
        assert not air.live.realizer._frames._listeners
        looking = await air.connect("?streams=frames")
        assert air.live.realizer._frames._listeners
        await looking.raw.close()
        assert (await socket.ask(type="bml", xml=wait()))["type"] == "accepted"
        await air.tick()
        await socket.hear_feedback("b1:start")
        assert not air.live.realizer._frames._listeners


async def test_a_socket_gets_only_the_streams_that_it_requests(on_air: Open) -> None:
    async with on_air() as air:
        silent = await air.connect("?streams=")
        assert (await silent.ask(type="bml", xml=wait()))["type"] == "accepted"
        await air.tick()
        await silent.say(type="clock")
        assert (await silent.hear())["type"] == "clock"


async def test_a_ping_comes_back_with_realizer_time(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await air.tick_until(0.5)
        await socket.say(type="ping", t=12.5)
        assert await socket.hear("pong") == {"type": "pong", "t": 12.5, "time": 0.5}


async def test_the_clock_is_sent_on_request(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await air.tick_until(0.25)
        await socket.say(type="clock")
        assert await socket.hear("clock") == {"type": "clock", "time": 0.25}


async def test_feedback_goes_to_all_clients_and_answers_only_to_the_sender(on_air: Open) -> None:
    async with on_air() as air:
        one, other = await air.connect(), await air.connect()
        assert (await one.ask(type="bml", xml=wait("b1")))["type"] == "accepted"
        await air.tick_until(0.2)
        assert (await one.hear_feedback('"b1:end"'))["seq"] == (await other.hear_feedback('"b1:end"'))["seq"]
        await other.say(type="clock")
        assert (await other.hear("accepted", "clock"))["type"] == "clock"


async def test_camera_and_targets_can_be_moved_and_removed(on_air: Open) -> None:
    async with on_air(ALICE + "[target.bluebox]\nposition = [0.0, 1.0, 1.0]\n") as air:
        socket = await air.connect()
        await socket.say(type="camera", position=[1, 2, 3])
        assert (await socket.ask(type="world", set={"greensphere": [3, 2, 1], "bluebox": None}))["type"] == "accepted"
        await air.tick()
        world = air.live.realizer.world
        assert world.position("camera") == (1, 2, 3)
        assert world.position("greensphere") == (3, 2, 1)
        assert world.position("bluebox") is None


async def test_the_tempo_of_the_metronome_is_an_event_with_a_value(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        answer = await socket.ask(type="event", anticipator="metronome", event="tempo", value=120)
        assert answer["type"] == "accepted"
        await air.tick()
        metronome = air.live.realizer.anticipators["metronome"]
        assert isinstance(metronome, Metronome)
        assert metronome.tempo == pytest.approx(120)


async def test_a_block_for_the_second_character_is_played_by_it(on_air: Open) -> None:
    async with on_air(TWO) as air:
        socket = await air.connect()
        xml = f'<bml {BML} id="b1" characterId="bert"><head id="h" lexeme="NOD"/></bml>'
        assert (await socket.ask(type="bml", xml=xml))["type"] == "accepted"
        await air.tick()
        assert 'characterId="bert"' in (await socket.hear_feedback('"b1:start"'))["xml"]


async def test_the_peg_list_is_sent_on_request_with_the_cause_of_its_changes(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=board")
        assert (await socket.hear("board"))["pegs"] == []
        xml = f'<bml {BML} id="b1"><wait id="w" start="anticipators:test:hit" duration="1"/></bml>'
        assert (await socket.ask(type="bml", xml=xml))["type"] == "accepted"
        await air.tick()
        pegs = {peg["key"]: peg for peg in (await socket.hear("board"))["pegs"]}
        assert pegs["anticipators:test:hit"] == {
            "key": "anticipators:test:hit",
            "time": None,
            "state": "unknown",
            "source": "predicted",
        }
        assert pegs["b1:w:end"]["source"] == "b1:w:start +1 s"
        assert (await socket.ask(type="predict", anticipator="test", sync="hit", time=2.0))["type"] == "accepted"
        await air.tick_until(0.3)
        board = await socket.hear("board")
        (change,) = [c for commit in board["commits"] for c in commit["changes"] if c[0] == "b1:w:end"]
        assert change == ["b1:w:end", None, 3.0]


async def test_the_peg_list_is_sent_at_most_five_times_a_second(on_air: Open) -> None:
    async with on_air() as air:
        page, planner = await air.connect("?streams=board"), await air.connect("?streams=")
        for n in range(100):
            predicted = await planner.ask(type="predict", anticipator="test", sync=f"s{n}", time=50 + n)
            assert predicted["type"] == "accepted"
            await air.tick()
        await page.say(type="clock")
        times = []
        while (message := await page.hear())["type"] != "clock":
            times.append(message["time"])
        assert times == [0.0, 0.0, 0.2, 0.4, 0.6, 0.8]  # the first one when the client subscribed


WALK = f'<bml {BML} id="go"><locomotion id="w" target="0 2" start="0.2"/></bml>'


async def test_paths_and_footprints_are_sent_on_request_while_a_character_walks(on_air: Open) -> None:
    async with on_air(TWO) as air:
        page, planner = await air.connect("?streams=steps"), await air.connect("?streams=")
        assert (await planner.ask(type="bml", xml=WALK))["type"] == "accepted"
        await air.tick_until(6.0)
        await page.say(type="clock")
        steps = []
        while (message := await page.hear())["type"] != "clock":
            steps.append(message)
        assert {message["character"] for message in steps} == {"alice"}
        paths = [message["path"] for message in steps if message["path"]]
        assert paths[0][0] == pytest.approx([0.0, 0.0], abs=0.05)
        assert {tuple(path[-1]) for path in paths} == {(0.0, 2.0)}
        made = {(foot["side"], *foot["position"]) for message in steps for foot in message["prints"] if foot["made"]}
        assert 6 <= len(made) <= 12
        assert all((x > 0.0) == (side == "left") for side, x, _ in made)
        assert max(z for *_, z in made) == pytest.approx(2.0, abs=0.1)
        assert all(foot["heading"] == pytest.approx(0.0, abs=5.0) for each in steps for foot in each["prints"])
        assert (steps[-1]["path"], steps[-1]["prints"]) == ([], [])
        times = [message["time"] for message in steps]
        assert min(np.diff(times)) > 0.095


async def test_nobody_asks_where_characters_step_without_a_request(
    on_air: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=frames")
        asked: list[object] = []
        monkeypatch.setattr(air.live.realizer.characters["alice"].humanoid, "planned_steps", lambda: asked.append(1))
        assert (await socket.ask(type="bml", xml=WALK))["type"] == "accepted"
        await air.tick_until(2.0)
        assert asked == []


async def test_the_world_is_told_on_request_when_something_in_it_moves(on_air: Open) -> None:
    things = "[target.bluebox]\nposition = [1, 1, 1]\n[target.greensphere]\nposition = [0, 1, 1]"
    async with on_air(f"{ALICE}\n{things}") as air:
        page, planner = await air.connect("?streams=world"), await air.connect("?streams=")

        async def heard() -> list[dict[str, Any]]:
            await page.say(type="clock")
            messages = []
            while (message := await page.hear())["type"] != "clock":
                messages.append(message)
            return messages

        await air.tick_until(0.5)
        (everything,) = await heard()
        assert {"bluebox", "greensphere"} <= everything["targets"].keys()
        assert everything["characters"]["alice"] == {"position": [0.0, 0.0, 0.0], "heading": 0.0}
        await planner.ask(type="world", set={"bluebox": [0.5, 1.0, 2.0], "greensphere": None})
        await air.tick_until(1.0)
        (change,) = await heard()
        assert change["targets"] == {"bluebox": [0.5, 1.0, 2.0], "greensphere": None}
        assert change["characters"] == {}
        await planner.ask(type="bml", xml=WALK)
        await air.tick_until(6.0)
        walk = [message["characters"]["alice"] for message in await heard()]
        assert len(walk) > 10
        assert walk[-1]["position"][2] == pytest.approx(2.0, abs=0.1)


async def test_an_orientation_is_told_until_its_target_is_removed(on_air: Open) -> None:
    async with on_air() as air:
        page, planner = await air.connect("?streams=world"), await air.connect("?streams=")

        async def cups(until: float) -> list[object]:
            await air.tick_until(until)
            await page.say(type="clock")
            told: list[object] = []
            while (message := await page.hear())["type"] != "clock":
                told += [message["targets"]["cup"]] if "cup" in message["targets"] else []
            return told

        turned = {"position": [0.5, 1.0, 2.0], "orientation": [0.6, 0.0, 0.8, 0.0]}
        await planner.ask(type="world", set={"cup": {"position": [0.5, 1, 2], "orientation": [3, 0, 4, 0]}})
        assert await cups(0.5) == [turned]
        async with air.client.get("/world") as answer:
            cup = (await answer.json())["targets"]["cup"]
        assert cup == {**turned, "orientation": pytest.approx(turned["orientation"])}
        await planner.ask(type="world", set={"cup": [1, 1, 1]})
        assert await cups(1.0) == [{**turned, "position": [1.0, 1.0, 1.0]}]
        await planner.ask(type="world", set={"cup": None})
        await planner.ask(type="world", set={"cup": [1, 1, 1]})
        assert await cups(1.5) == [[1.0, 1.0, 1.0]]


async def test_a_target_in_a_hand_moves_with_it(on_air: Open) -> None:
    take = (
        f'<bml {BML} xmlns:rr="urn:reactive-realizer:1" id="b">'
        '<pointing id="p" target="bluebox" mode="RIGHT_HAND" rr:reach="TAKE"/></bml>'
    )
    async with on_air() as air:
        page, planner = await air.connect("?streams=world"), await air.connect("?streams=")
        await planner.ask(type="world", set={"bluebox": [-0.25, 1.15, 0.4]})
        await planner.ask(type="bml", xml=take)
        await air.tick_until(4.0)
        await page.say(type="clock")
        boxes = []
        while (message := await page.hear())["type"] != "clock":
            boxes += [message["targets"]["bluebox"]] if "bluebox" in message["targets"] else []
        assert len(boxes) > 5
        assert boxes[-1][1] < 1.0


async def test_an_unchanged_peg_list_is_not_sent(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect("?streams=board")
        await air.tick_until(1.0)
        await socket.say(type="clock")
        assert (await socket.hear("board"))["time"] == 0.0
        assert (await socket.hear())["type"] == "clock"
