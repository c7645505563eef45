"""HTTP: what planners without a socket ask for, and what the page loads."""

import json
from collections.abc import AsyncIterator
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from reactive_realizer.limits import Limits
from reactive_realizer.server import routes_page

from .conftest import ALICE, BML, OnAir, Open, wait

XML = {"Content-Type": "application/xml"}


async def post(air: OnAir, path: str, body: str | bytes, headers: dict[str, str] = XML) -> tuple[int, dict[str, Any]]:
    async with air.client.post(path, data=body, headers=headers) as answer:
        return answer.status, await answer.json()


async def test_a_document_is_accepted_with_the_ids_of_its_blocks_and_plays(on_air: Open) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert await post(air, "/bml", wait("b1") + wait("b2")) == (202, {"blocks": ["b1", "b2"]})
        await air.tick_until(0.3)
        assert await socket.hear_feedback('"b2:end"')


@pytest.mark.parametrize(
    ("name", "body", "status", "code", "line"),
    [
        ("malformed XML", f'<bml {BML} id="b1">\n<wait\n</bml>', 400, "malformed-xml", 3),
        ("no block", "", 400, "no-block", 1),
        ("another document", "<html/>", 400, "not-bml", 1),
        ("a block without an id", f"\n<bml {BML}/>", 400, "no-block-id", 2),
        ("a DOCTYPE", f'<!DOCTYPE bml><bml {BML} id="b1"/>', 400, "doctype", 1),
        ("bytes that are no text", b"\xff\xfe\x00", 400, None, None),
        ("a character who is not there", f'<bml {BML} id="b1" characterId="zoe"/>', 404, "unknown-character", 1),
    ],
)
async def test_a_document_is_refused_at_the_door(
    on_air: Open, name: str, body: str | bytes, status: int, code: str | None, line: int | None
) -> None:
    async with on_air() as air:
        answered, body_ = await post(air, "/bml", body)
        assert answered == status, name
        fault = body_["error"]
        assert fault["message"]
        assert set(fault) == {"code", "message", "line", "column"}
        if code is not None:
            assert (fault["code"], fault["line"]) == (code, line)
        assert not air.live.realizer.busy, "nothing of it has entered"


async def test_a_document_enters_whole_or_not_at_all(on_air: Open) -> None:
    async with on_air() as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2") + "\n" + wait("b1"))
        assert (status, body["error"]["code"], body["error"]["line"]) == (409, "duplicate-block", 2)
        assert not air.live.realizer.busy


async def test_blocks_of_a_document_are_judged_beside_those_before_them(on_air: Open) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait("b1") + "\n" + wait("b1"))
        assert (status, body["error"]["code"], body["error"]["line"]) == (409, "duplicate-block", 2)
        assert not air.live.realizer.busy


async def test_a_replace_makes_room_for_the_blocks_behind_it(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 2\n") as air:
        socket = await air.connect()
        await post(air, "/bml", wait("q1", 9) + wait("q2", 9))
        await air.tick()
        replace = f'<bml {BML} id="x" composition="REPLACE"/>'
        assert await post(air, "/bml", replace + wait("q1")) == (202, {"blocks": ["x", "q1"]})
        await air.tick_until(0.3)
        assert "INTERRUPTED" in (await socket.hear_feedback('"q1:end"'))["xml"]
        assert "DONE" in (await socket.hear_feedback('"q1:end"'))["xml"]
        assert not air.live.realizer.scheduler.refused


async def test_blocks_before_one_in_its_document_count_among_those_alive(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 2\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2") + wait("b3"))
        assert (status, body["error"]["code"]) == (429, "too-many-blocks")


async def test_a_replace_makes_no_room_among_the_blocks_of_another_character(on_air: Open) -> None:
    async with on_air(ALICE + "[character.bert]\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        replace = f'<bml {BML} id="x" characterId="bert" composition="REPLACE"/>'
        assert (await post(air, "/bml", replace + wait("b1")))[0] == 409


async def test_a_block_that_fails_at_once_leaves_its_id_to_the_next(on_air: Open) -> None:
    async with on_air() as air:
        fails = f'<bml {BML} id="b1"><required><wait id="w" duration="soon"/></required></bml>'
        assert (await post(air, "/bml", fails + wait("b1")))[0] == 202
        await air.tick()
        assert not air.live.realizer.scheduler.refused


SPEECH = f'<bml {BML} id="b1"><speech id="s"><text>d\u00e9j\u00e0 vu</text></speech></bml>'


@pytest.mark.parametrize(
    ("charset", "body"),
    [
        ("iso-8859-1", SPEECH.encode("iso-8859-1")),
        ("ISO-8859-1", f'<?xml version="1.0" encoding="UTF-8"?>{SPEECH}'.encode("iso-8859-1")),
        ("iso-8859-1", SPEECH.encode("utf-8-sig")),
        ("utf-8", f'<?xml version="1.0" encoding="ISO-8859-1"?>{SPEECH}'.encode()),
        ("utf-16", SPEECH.encode("utf-16")),
        ("utf-16", SPEECH.encode("utf-16-be")),
        ("utf-16le", SPEECH.encode("utf-16-le")),
    ],
)
async def test_a_charset_goes_before_the_declaration_and_a_byte_order_mark_before_both(
    on_air: Open, charset: str, body: bytes
) -> None:
    async with on_air() as air:
        socket = await air.connect()
        assert (await post(air, "/bml", body, {"Content-Type": f"text/xml; charset={charset}"}))[0] == 202
        await air.tick()
        assert "d\u00e9j\u00e0 vu" in (await socket.hear_feedback("predictionFeedback"))["xml"]


@pytest.mark.parametrize("charset", ["klingon", "utf-7", "zlib", "rot13", '""'])
async def test_a_charset_that_is_not_read_is_refused(on_air: Open, charset: str) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait(), {"Content-Type": f"text/xml; charset={charset}"})
        assert (status, body["error"]["code"]) == (415, "wrong-charset")


@pytest.mark.parametrize(
    ("charset", "body", "code"),
    [("us-ascii", SPEECH.encode(), "malformed-xml"), ("utf-16", b"<bml/>?", "bad-encoding")],
)
async def test_bytes_that_are_not_of_their_charset_are_refused(
    on_air: Open, charset: str, body: bytes, code: str
) -> None:
    async with on_air() as air:
        status, answer = await post(air, "/bml", body, {"Content-Type": f"text/xml; charset={charset}"})
        assert (status, answer["error"]["code"]) == (400, code)


async def test_a_document_above_the_limit_of_bytes_is_refused(on_air: Open) -> None:
    async with on_air(ALICE + f"[limits]\nbml_bytes = {len(wait())}\n") as air:
        assert (await post(air, "/bml", wait()))[0] == 202
        status, body = await post(air, "/bml", wait() + " ")
        assert (status, body["error"]["code"]) == (413, "too-many-bytes")


async def test_a_body_without_end_is_not_read_to_its_end(on_air: Open) -> None:
    spaces = iter([b" " * 100_000] * 1000)

    async def body() -> AsyncIterator[bytes]:
        for some in spaces:
            yield some

    async with on_air(ALICE + "[limits]\nbml_bytes = 1000\n") as air:
        async with air.client.post("/bml", data=body(), headers=XML) as answer:
            assert answer.status == 413
        assert len(list(spaces)) > 100, "most of it was never asked for"


async def test_more_blocks_alive_than_the_limit_are_refused_until_they_are_stopped(on_air: Open) -> None:
    async with on_air(ALICE + "[limits]\nblocks_alive = 1\n") as air:
        await post(air, "/bml", wait("b1", 9))
        await air.tick()
        status, body = await post(air, "/bml", wait("b2"))
        assert (status, body["error"]["code"]) == (429, "too-many-blocks")
        await post(air, "/stop", "")
        await air.tick()
        assert (await post(air, "/bml", wait("b2")))[0] == 202


@pytest.mark.parametrize("media_type", ["text/plain", "application/json", "application/x-www-form-urlencoded"])
async def test_bml_that_is_not_sent_as_xml_is_refused(on_air: Open, media_type: str) -> None:
    async with on_air() as air:
        status, body = await post(air, "/bml", wait(), {"Content-Type": media_type})
        assert (status, body["error"]["code"]) == (415, "wrong-media-type")


async def test_stop_ends_the_blocks_of_all_characters(on_air: Open) -> None:
    async with on_air(ALICE + "[character.bert]\n") as air:
        socket = await air.connect()
        await post(air, "/bml", wait("b1", 9) + wait("b2", 9).replace("<bml", '<bml characterId="bert"'))
        await air.tick()
        status, _ = await post(air, "/stop", "")
        assert status == 202
        await air.tick()
        for block in ("b1", "b2"):
            assert "INTERRUPTED" in (await socket.hear_feedback(f'id="{block}:end"'))["xml"]


async def test_stopping_twice_is_no_mistake(on_air: Open) -> None:
    async with on_air() as air:
        first, second = [await post(air, "/stop", "") for _ in range(2)]
        assert first[0] == second[0] == 202
        assert first[1]["blocks"] != second[1]["blocks"]
        await air.tick()
        assert not air.live.realizer.scheduler.refused


async def test_a_prediction_comes_as_json_for_a_time_or_for_so_many_seconds_from_now(on_air: Open) -> None:
    async with on_air() as air:
        await air.tick_until(1.0)
        json_type = {"Content-Type": "application/json"}
        said = {"anticipator": "test", "sync": "hit", "in": 0.5}
        assert await post(air, "/predict", json.dumps(said), json_type) == (202, {"time": 1.5})
        said = {"anticipator": "test", "sync": "hit", "time": None}
        assert await post(air, "/predict", json.dumps(said), json_type) == (202, {"time": None})


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("", "bad-json"),
        ("[]", "unknown-message"),
        ('{"anticipator":"a","sync":"s","time":NaN}', "bad-json"),
        ('{"anticipator":"a","sync":"s"}', "bad-message"),
        ('{"anticipator":"a","sync":"s","time":-1e6}', "absurd-time"),
    ],
)
async def test_a_prediction_that_cannot_be_is_refused(on_air: Open, body: str, code: str) -> None:
    async with on_air() as air:
        status, answer = await post(air, "/predict", body)
        assert (status, answer["error"]["code"]) == (400, code)


async def test_a_prediction_of_what_predicts_by_itself_is_refused_and_changes_nothing(on_air: Open) -> None:
    async with on_air() as air:
        said = {"anticipator": "metronome", "sync": "tick3", "in": 0.5}
        status, answer = await post(air, "/predict", json.dumps(said))
        assert (status, answer["error"]["code"]) == (409, "predicts-itself")
        assert not air.live.realizer.busy


async def test_the_status_tells_how_it_goes(on_air: Open) -> None:
    async with on_air() as air:
        await air.connect()
        await post(air, "/bml", wait("b1", 0.1) + wait("b2", 9))
        await air.tick_until(0.5)
        async with air.client.get("/status") as answer:
            status = await answer.json()
        assert set(status) == {
            "version", "protocol", "session", "time", "ticks", "clients", "blocks", "worker", "limits",
        }  # fmt: skip
        assert status["session"] == air.live.session
        assert status["time"] == 0.5
        assert status["clients"] == 1
        assert status["blocks"] == {"IN_EXEC": 1, "DONE": 1}
        assert set(status["ticks"]) == {"late_p50_ms", "late_p99_ms", "overruns"}
        assert set(status["worker"]) == {"alive", "restarts"}
        assert status["limits"]["clients"] == Limits().clients


async def test_the_world_tells_where_everything_is(on_air: Open) -> None:
    async with on_air(ALICE + "[target.bluebox]\nposition = [0.0, 1.0, 2.0]\n") as air:
        async with air.client.get("/world") as answer:
            targets = (await answer.json())["targets"]
        assert targets["bluebox"] == {"position": [0.0, 1.0, 2.0]}
        assert 1.4 < targets["alice"]["position"][1] < 1.9


async def test_the_capabilities_tell_what_may_be_asked_for(on_air: Open) -> None:
    async with on_air() as air:
        async with air.client.get("/capabilities") as answer:
            capabilities = await answer.json()
        assert "stroke" in capabilities["elements"]["gesture"]["syncPoints"]
        assert "repetition" in capabilities["elements"]["head"]["attributes"]
        assert capabilities["elements"]["speech"]["parameters"] == {"volume": {"low": 0.0, "high": 100.0}}
        assert capabilities["elements"]["wait"]["parameters"] == {}
        parameters = capabilities["parameters"]
        assert parameters.items() >= {"gesture": ["amount"], "head": ["amount"], "speech": ["volume"]}.items()
        lexemes = {"gesture": "BEAT", "head": "TOSS", "faceLexeme": "RAISE_BROWS", "pose": "ARMS_CROSSED"}
        assert all(word in capabilities["lexemes"][element] for element, word in lexemes.items())
        assert "alice" in capabilities["targets"]


async def test_the_schema_of_the_protocol_is_served(on_air: Open) -> None:
    async with on_air() as air, air.client.get("/protocol.json") as answer:
        Draft202012Validator.check_schema(await answer.json(content_type=None))


async def test_the_avatars_of_hello_can_be_fetched(on_air: Open) -> None:
    async with on_air() as air:
        (character,) = (await air.connect()).hello["characters"]
        async with air.client.get(character["avatar"]) as answer:
            assert answer.content_type == "model/gltf-binary"
            assert (await answer.content.readexactly(4)) == b"glTF"


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/avatars/nobody.glb", 404),
        ("/avatars/LICENSE.md", 404),
        ("/avatars/humans/default.toml", 404),
        ("/avatars/..%2f..%2ferrors.py", 400),
        ("/avatars/%2e%2e/%2e%2e/errors.py", 400),
        ("/avatars/%2fetc%2fpasswd", 404),
        ("/avatars/a%5c..%5cb.glb", 400),
        ("/..%2f..%2ferrors.py", 404),
        ("/audio/..%2fsecret.wav", 404),
        ("/nothing/here", 404),
    ],
)
async def test_no_address_leads_out_of_what_is_served(on_air: Open, path: str, status: int) -> None:
    async with on_air() as air:
        url = air.client.make_url("/").with_path(path, encoded=True)
        async with air.client.session.get(url) as answer:
            assert answer.status == status
            assert (await answer.json())["error"]["message"]


async def test_a_method_that_is_not_taken_is_answered_with_those_that_are(on_air: Open) -> None:
    async with on_air() as air, air.client.get("/bml") as answer:
        assert answer.status == 405
        assert answer.headers["Allow"] == "POST"
        assert (await answer.json())["error"]["code"] == "wrong-method"


async def test_the_page_is_served_and_may_run_only_what_comes_from_here(
    on_air: Open, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "static").mkdir()
    (tmp_path / "static" / "index.html").write_text("<!doctype html>hello")
    (tmp_path / "static" / "page.js").write_text("1")
    monkeypatch.setattr(routes_page, "STATIC", tmp_path / "static")
    async with on_air() as air:
        async with air.client.get("/") as answer:
            assert await answer.text() == "<!doctype html>hello"
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy
            assert "unsafe" not in policy
        async with air.client.get("/page.js") as answer:
            assert answer.status == 200
            assert answer.headers["X-Content-Type-Options"] == "nosniff"


async def test_a_page_that_was_not_built_is_said_to_be_so(
    on_air: Open, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(routes_page, "STATIC", tmp_path / "static")
    async with on_air() as air, air.client.get("/") as answer:
        assert answer.status == 503
        assert "make page" in (await answer.json())["error"]["message"]


async def test_a_block_alive_explains_the_times_of_its_points(on_air: Open) -> None:
    async with on_air() as air:
        await post(air, "/bml", wait("b1", 9) + wait("b2"))
        await air.tick_until(0.3)
        async with air.client.get("/explain/b1") as answer:
            told = await answer.json()
        assert (told["character"], told["block"]) == ("alice", "b1")
        assert told["points"]["b1:w:end"]["sources"]
        refused = [
            ("nobody", 404, "no-such-block"),
            ("b2", 410, "block-ended"),
            ("b1?character=zoe", 404, "unknown-character"),
        ]
        for block, status, code in refused:
            async with air.client.get(f"/explain/{block}") as answer:
                assert answer.status == status
                assert (await answer.json())["error"]["code"] == code
