"""Invalid messages: each is answered with a code and a sentence, and the socket stays open."""

import asyncio
import json

import pytest

from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.server import protocol
from reactive_realizer.server.protocol import Message

from .conftest import ALICE, BML, Open, Socket, wait

BAD = {
    "no JSON": ("{", "bad-json"),
    "no number": ('{"type":"ping","t":NaN}', "bad-json"),
    "a deep abyss": ("[" * 100_000, "bad-json"),
    "no object": ("[1, 2]", "unknown-message"),
    "a type that is no text": ('{"type":["bml"]}', "unknown-message"),
    "no type": ('{"xml":"<bml/>"}', "unknown-message"),
    "an unknown type": ('{"type":"explode"}', "unknown-message"),
    "a message of the server": ('{"type":"hello"}', "unknown-message"),
    "bml without xml": ('{"type":"bml"}', "bad-message"),
    "xml that is no text": ('{"type":"bml","xml":7}', "bad-message"),
    "an infinite number": ('{"type":"ping","t":1e999}', "bad-message"),
    "a truth value for a number": ('{"type":"ping","t":true}', "bad-message"),
    "a prediction without a time": ('{"type":"predict","anticipator":"a","sync":"s"}', "bad-message"),
    "a prediction with two": ('{"type":"predict","anticipator":"a","sync":"s","time":1,"in":1}', "bad-message"),
    "a time that is text": ('{"type":"predict","anticipator":"a","sync":"s","time":"soon"}', "bad-message"),
    "a far time": ('{"type":"predict","anticipator":"a","sync":"s","time":1e8}', "absurd-time"),
    "an absurd time": ('{"type":"predict","anticipator":"a","sync":"s","in":1e300}', "bad-message"),
    "an anticipator with a colon": ('{"type":"predict","anticipator":"a:b","sync":"s","in":1}', "bad-message"),
    "a name with a line break": ('{"type":"predict","anticipator":"a\\n","sync":"s","in":1}', "bad-message"),
    "a name of a mile": (
        json.dumps({"type": "predict", "anticipator": "a" * 201, "sync": "s", "in": 1}),
        "bad-message",
    ),
    "a name with a control character": (r'{"type":"predict","anticipator":"a\u0001","sync":"s","in":1}', "bad-message"),
    "a point with a delete": (r'{"type":"predict","anticipator":"a","sync":"s\u007f","in":1}', "bad-message"),
    "a point with half a letter": (r'{"type":"predict","anticipator":"a","sync":"\udfff","in":1}', "bad-message"),
    "a target with a control character": (r'{"type":"world","set":{"a\u0000":[0,0,0]}}', "bad-message"),
    "a target that is half a letter": (r'{"type":"world","set":{"\ud800":[0,0,0]}}', "bad-message"),
    "a prediction of a tick": ('{"type":"predict","anticipator":"metronome","sync":"tick3","in":1}', "predicts-itself"),
    "an event of nobody": ('{"type":"event","anticipator":"nobody","event":"press"}', "unknown-anticipator"),
    "words that are a number": ('{"type":"event","anticipator":"user","event":"words","text":7}', "bad-message"),
    "words without an end": (
        json.dumps({"type": "event", "anticipator": "user", "event": "words", "text": "a" * 5001}),
        "bad-message",
    ),
    "a tempo of zero": ('{"type":"event","anticipator":"metronome","event":"tempo","value":0}', "bad-number"),
    "a flat position": ('{"type":"camera","position":[1,2]}', "bad-message"),
    "a position beyond the moon": ('{"type":"camera","position":[1,2,4e8]}', "bad-message"),
    "a world that is a list": ('{"type":"world","set":[]}', "bad-message"),
    "a target that is text": ('{"type":"world","set":{"bluebox":"there"}}', "bad-message"),
    "a target without a length of its orientation": (
        '{"type":"world","set":{"box":{"position":[0,0,0],"orientation":[0,0,0,0]}}}',
        "bad-message",
    ),
    "a character that is moved": ('{"type":"world","set":{"alice":[0,0,0]}}', "not-movable"),
    "a sound that nobody makes": ('{"type":"heard","id":"alice-1","position":0,"time":0}', "no-clip"),
    "a position before the sound": ('{"type":"heard","id":"alice-1","position":-1,"time":0}', "bad-message"),
    "a sound without a name": ('{"type":"heard","position":0,"time":0}', "bad-message"),
    "a time of hearing that is text": ('{"type":"heard","id":"alice-1","position":0,"time":"now"}', "bad-message"),
    "sound for no speech": ('{"type":"speech","stream":"x","audio":"AAAA"}', "unknown-stream"),
    "sound that is no base64": ('{"type":"speech","stream":"x","audio":"~~~~"}', "bad-message"),
    "sound that is a list": ('{"type":"speech","stream":"x","audio":[0,0]}', "bad-message"),
    "a word without a time": ('{"type":"speech","stream":"x","words":[["Hi"]]}', "bad-message"),
    "a demo where there is none": ('{"type":"demo"}', "no-demo"),
    "half a letter": ('{"type":"world","set":{"\\ud800":"there"}}', "bad-message"),
}


async def still_listens(socket: Socket) -> bool:
    await socket.say(type="ping", t=1)
    return bool((await socket.hear("pong"))["t"] == 1)


@pytest.mark.parametrize("name", BAD)
async def test_a_bad_message_is_answered_and_the_socket_stays_open(on_air: Open, name: str) -> None:
    text, code = BAD[name]
    async with on_air() as air:
        socket = await air.connect()
        await socket.say_anything(text)
        answer = await socket.hear("error")
        assert answer["code"] == code
        assert answer["message"]
        await air.tick()
        assert await still_listens(socket)


async def test_the_answer_has_the_ref_of_an_invalid_message(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await socket.say_anything('{"type":"camera","position":[1,2],"ref":"r7"}')
        answer = await socket.hear("error")
        assert answer["ref"] == "r7"
        assert "position" in answer["message"]
        await socket.say_anything('{"type":"camera","position":[1,2,3],"ref":{"not":"a ref"}}')
        assert "ref" not in await socket.hear("error")


async def test_the_answer_has_the_ref_of_a_message_with_an_invalid_number(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        for number in ("NaN", "Infinity", "-Infinity"):
            text = '{"type":"predict","anticipator":"a","sync":"s","time":%s,"ref":"r8"}'
            await socket.say_anything(text % number)
            answer = await socket.hear("error")
            assert (answer["ref"], answer["code"]) == ("r8", "bad-json")
            assert f"{number} is not a valid number" in answer["message"]
        await socket.say_anything('{"type":"ping","t":1,"ref":NaN}')
        assert "ref" not in await socket.hear("error")


@pytest.mark.parametrize("name", ["two words", "a:b", "a+1", "", "a" * 201, "a\n"])
async def test_the_error_of_an_invalid_name_describes_valid_ones(on_air: Open, name: str) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await socket.say_anything(json.dumps({"type": "predict", "anticipator": "a", "sync": name, "time": 1}))
        answer = await socket.hear("error")
        assert answer["code"] == "bad-message"
        assert answer["message"].startswith('sync: "')
        assert '"A part of a sync reference: 1 to 200 characters, no white space, ' in answer["message"]
        assert "[" not in answer["message"]


async def test_binary_junk_is_answered_and_the_socket_stays_open(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        await socket.raw.send_bytes(b"\x00\xff\x13\x37")
        assert (await socket.hear("error"))["code"] == "binary-message"
        assert await still_listens(socket)


async def test_names_may_have_letters_of_every_alphabet(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        for name in ("vélo", "眼鏡", "\N{GRINNING FACE}"):
            assert (await socket.ask(type="world", set={name: [0, 0, 0]}))["type"] == "accepted"


async def test_unknown_fields_are_ignored(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert (await socket.ask(type="clock", mood="bright"))["type"] == "accepted"


async def test_malformed_bml_is_refused_with_its_location_and_reported_in_feedback(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        answer = await socket.ask(type="bml", xml=f'<bml {BML} id="b1">\n  <wait id="w"\n</bml>')
        assert answer["code"] == "malformed-xml"
        assert answer["blocks"] == []
        assert "line 3" in answer["message"]
        await air.tick()
        assert "PARSING_FAILURE" in (await socket.hear_feedback("warningFeedback"))["xml"]


async def test_a_live_id_is_refused_while_the_other_block_of_the_document_plays(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert (await socket.ask(type="bml", xml=wait("b1", 9)))["type"] == "accepted"
        await air.tick()
        answer = await socket.ask(type="bml", xml=wait("b1") + wait("b2"))
        assert answer["code"] == "duplicate-block"
        assert answer["blocks"] == ["b2"]
        await air.tick()
        assert "b1" in (await socket.hear_feedback("warningFeedback"))["xml"]
        assert await socket.hear_feedback('"b2:start"')


async def test_messages_above_the_rate_limit_wait_and_are_answered(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nmessages_per_second = 10\n") as air:
        socket, other = await air.connect(), await air.connect()
        for n in range(14):
            await socket.say(type="ping", t=n)
        assert await still_listens(other)
        for n in range(14):
            assert (await socket.hear("pong"))["t"] == n
        assert await still_listens(socket)


async def test_a_message_above_the_limit_of_bytes_ends_the_connection(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nmessage_bytes = 1000\n") as air:
        socket, other = await air.connect(), await air.connect()
        await socket.say(type="bml", xml="x" * 1000)
        assert await socket.close_code() == 1009
        assert await still_listens(other)


async def test_bml_above_the_limit_of_bytes_is_refused(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nbml_bytes = 100\n") as air:
        socket = await air.connect()
        answer = await socket.ask(type="bml", xml=wait() + " " * 100)
        assert answer["code"] == "too-many-bytes"
        assert await still_listens(socket)


async def test_points_that_no_behavior_is_tied_to_make_room_for_new_ones_the_oldest_first(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\npredicted_points = 3\n") as air:
        socket = await air.connect()
        await socket.say(
            type="bml", xml=f'<bml {BML} id="b"><wait id="w" start="anticipators:t:p1" duration="1"/></bml>'
        )
        for number in range(10):
            answer = await socket.ask(type="predict", anticipator="t", sync=f"p{number}", time=1000 + number)
            assert answer["type"] == "accepted"
            await air.tick()
        assert list(air.live.realizer.board.predictions("t")) == ["p1", "p8", "p9"]


async def test_points_that_have_passed_do_not_count(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\npredicted_points = 5\n") as air:
        socket = await air.connect()
        for turn in range(20):
            bml = f'<bml {BML} id="b{turn}"><wait id="w" start="anticipators:user:turn{turn}" duration="0.02"/></bml>'
            await socket.say(type="bml", xml=bml)
            time = air.live.realizer.time + 0.04
            answer = await socket.ask(type="predict", anticipator="user", sync=f"turn{turn}", time=time)
            assert answer["type"] == "accepted"
            await air.tick_until(time + 0.04)
            assert f'globalTime="{time:g}' in (await socket.hear_feedback(f'"b{turn}:w:start"'))["xml"]
        assert list(air.live.realizer.board.predictions("user")) == [f"turn{turn}" for turn in range(15, 20)]


async def test_withdrawn_points_do_not_count(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\npredicted_points = 5\n") as air:
        socket = await air.connect()
        for number in range(20):
            for time in (100, None):
                answer = await socket.ask(type="predict", anticipator="user", sync=f"p{number}", time=time)
                assert answer["type"] == "accepted"
                await air.tick()


async def test_withdrawn_points_that_a_block_waits_for_count(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\npredicted_points = 2\n") as air:
        socket = await air.connect()
        waits = "".join(f'<wait id="{sync}" start="anticipators:user:{sync}" duration="1"/>' for sync in ("a", "b"))
        await socket.ask(type="bml", xml=f'<bml {BML} id="b1">{waits}</bml>')
        await air.tick()
        answer = await socket.ask(type="predict", anticipator="user", sync="c", time=1)
        assert (answer["type"], answer["code"]) == ("error", "too-many-names")
        assert (await socket.ask(type="predict", anticipator="user", sync="a", time=0.1))["type"] == "accepted"


async def test_anticipators_of_clients_without_points_make_room_for_new_ones(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\npredicted_points = 3\n") as air:
        socket = await air.connect()
        for number in range(20):
            answer = await socket.ask(type="predict", anticipator=f"user{number}", sync="a", time=1000)
            assert answer["type"] == "accepted"
            await air.tick()
        assert {"metronome", "user17", "user18", "user19"} <= air.live.realizer.anticipators.keys()
        assert len(air.live.realizer.anticipators) < 10
        await socket.ask(type="predict", anticipator="user0", sync="a", time=air.live.realizer.time + 0.05)
        await air.tick()
        assert air.live.realizer.board.predictions("user0")


async def test_a_prediction_costs_the_same_however_many_wait_for_the_tick(
    on_air: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with on_air() as air:
        socket, board = await air.connect(), air.live.realizer.board
        looks, get = list[object](), board.get

        def look(key: PegKey) -> object:
            looks.append(key)
            return get(key)

        monkeypatch.setattr(board, "get", look)
        for number in range(200):
            await socket.ask(type="predict", anticipator="user", sync=f"p{number}", time=100)
        assert len(looks) <= 2 * 200


async def test_ticks_come_between_the_messages_of_a_client_that_sends_many_at_once(
    on_air: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with on_air() as air:
        turn, turns = 0, list[int]()

        def check(message: Message) -> None:
            turns.append(turn)

        monkeypatch.setattr(protocol, "check", check)
        socket = await air.connect()
        for number in range(50):
            await socket.raw.send_json({"type": "clock", "ref": number})
        while len(turns) < 50:
            turn += 1
            await asyncio.sleep(0)
        assert len(set(turns)) == 50


async def test_more_targets_than_the_limit_are_refused_and_known_ones_may_still_move(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\ntargets = 3\n") as air:
        socket = await air.connect()
        things = {"cup": [0, 1, 1], "hat": [0, 2, 1]}
        assert (await socket.ask(type="world", set=things))["type"] == "accepted"
        await air.tick()
        assert (await socket.ask(type="world", set={"bag": [0, 0, 1]}))["code"] == "too-many-names"
        assert (await socket.ask(type="world", set={"cup": [1, 1, 1]}))["type"] == "accepted"


@pytest.mark.parametrize("query", ["?streams=feedback,smell", "?after=yesterday", "?after=-1", "?after=" + "9" * 30])
async def test_an_address_with_an_invalid_query_is_refused(on_air: Open, query: str) -> None:
    async with on_air() as air, air.client.get("/ws" + query) as answer:
        assert answer.status == 400
        assert (await answer.json())["error"]["code"] == "bad-query"


async def test_a_request_without_a_websocket_handshake_is_refused(on_air: Open) -> None:
    async with on_air() as air, air.client.get("/ws") as answer:
        assert answer.status == 400
        assert (await answer.json())["error"]["code"] == "bad-request"
        assert air.live.clients.number == 0
