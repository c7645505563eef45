"""HTTP: requests of planners without a socket, and the files of the page."""

import asyncio
import gzip
import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from reactive_realizer.limits import Limits
from reactive_realizer.server import routes_page

from .conftest import ALICE, XML, Open, post, wait


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


async def test_stopping_twice_is_allowed(on_air: Open) -> None:
    async with on_air() as air:
        first, second = [await post(air, "/stop", "") for _ in range(2)]
        assert first[0] == second[0] == 202
        assert first[1]["blocks"] != second[1]["blocks"]
        await air.tick()
        assert not air.live.realizer.scheduler.refused


async def test_a_prediction_has_an_absolute_time_or_seconds_from_now(on_air: Open) -> None:
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
async def test_an_invalid_prediction_is_refused(on_air: Open, body: str, code: str) -> None:
    async with on_air() as air:
        status, answer = await post(air, "/predict", body)
        assert (status, answer["error"]["code"]) == (400, code)


async def test_a_prediction_for_an_anticipator_with_its_own_predictions_is_refused(on_air: Open) -> None:
    async with on_air() as air:
        said = {"anticipator": "metronome", "sync": "tick3", "in": 0.5}
        status, answer = await post(air, "/predict", json.dumps(said))
        assert (status, answer["error"]["code"]) == (409, "predicts-itself")
        assert not air.live.realizer.busy


async def test_the_status_has_ticks_clients_and_worker(on_air: Open) -> None:
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


async def test_the_world_lists_positions(on_air: Open) -> None:
    async with on_air(ALICE + "[target.bluebox]\nposition = [0.0, 1.0, 2.0]\n") as air:
        async with air.client.get("/world") as answer:
            targets = (await answer.json())["targets"]
        assert targets["bluebox"] == {"position": [0.0, 1.0, 2.0]}
        assert 1.4 < targets["alice"]["position"][1] < 1.9


async def test_the_capabilities_list_elements_and_lexemes(on_air: Open) -> None:
    async with on_air() as air:
        async with air.client.get("/capabilities") as answer:
            capabilities = await answer.json()
        assert "stroke" in capabilities["elements"]["gesture"]["syncPoints"]
        assert "repetition" in capabilities["elements"]["head"]["attributes"]
        factor, volume = {"low": 0.5, "high": 2.0}, {"low": 0.0, "high": 100.0}
        assert capabilities["elements"]["speech"]["parameters"] == {"volume": volume, "rate": factor, "pitch": factor}
        assert capabilities["elements"]["wait"]["parameters"] == {}
        parameters = capabilities["parameters"]
        assert "amount" in parameters["gesture"]
        assert parameters.items() >= {"head": ["amount"], "speech": ["pitch", "rate", "volume"]}.items()
        lexemes = {"gesture": "BEAT", "head": "TOSS", "faceLexeme": "RAISE_BROWS", "pose": "ARMS_CROSSED"}
        assert all(word in capabilities["lexemes"][element] for element, word in lexemes.items())
        assert "alice" in capabilities["targets"]
        silent = {"stretch": None, "volume": volume, "rate": None, "pitch": None}
        assert capabilities["tts"] == {"sound": False, "languages": [], "markup": ["break", "emphasis"], **silent}


async def test_the_capabilities_list_anticipators_and_their_events(on_air: Open) -> None:
    kinds = {"user": "speech_stop", "metronome": "metronome", "trainer": "exercise"}
    scene = "".join(f'[anticipator.{id_}]\nkind = "{kind}"\n' for id_, kind in kinds.items())
    async with on_air(f'[character.alice]\n{scene}names = ["down", "up"]\n') as air:
        await post(air, "/predict", '{"anticipator": "partner", "sync": "hit", "in": 1}')
        await air.tick()
        async with air.client.get("/capabilities") as answer:
            told = await answer.json()
    assert told["anticipators"] == {
        "user": {"kind": "speech_stop", "events": ["voice"], "textEvents": ["words"], "points": ["stop"]},
        "metronome": {"kind": "metronome", "events": ["tempo", "start"], "textEvents": [], "points": ["tickN"]},
        "trainer": {"kind": "exercise", "events": ["sample", "start"], "textEvents": [], "points": ["N", "down", "up"]},
        "events": {"kind": "events", "events": [], "textEvents": [], "points": []},
        "partner": {"kind": "remote", "events": [], "textEvents": [], "points": ["hit"]},
    }
    assert {"convex", "embr", "smartbody"} <= set(told["strategies"])
    assert {"instant", "linear", "ease-in-ease-out"} <= set(told["trajectories"])


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
        ("/pictures/humans/default.toml", 404),
        ("/pictures/avatars/female.glb", 404),
        ("/pictures/..%2f..%2ferrors.png", 400),
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
async def test_no_path_leads_out_of_the_served_folders(on_air: Open, path: str, status: int) -> None:
    async with on_air() as air:
        url = air.client.make_url("/").with_path(path, encoded=True)
        async with air.client.session.get(url) as answer:
            assert answer.status == status
            assert (await answer.json())["error"]["message"]


async def test_the_answer_to_an_unsupported_method_lists_the_supported_ones(on_air: Open) -> None:
    async with on_air() as air, air.client.get("/bml") as answer:
        assert answer.status == 405
        assert answer.headers["Allow"] == "POST"
        assert (await answer.json())["error"]["code"] == "wrong-method"


async def test_the_page_is_served_with_a_content_security_policy(
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


async def test_files_of_the_page_are_sent_compressed_and_those_with_a_hash_in_their_name_are_kept_by_browsers(
    on_air: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<!doctype html>hello")
    (tmp_path / "assets" / "page-1a2b.js").write_text("1")
    for file in ("index.html", "assets/page-1a2b.js"):
        (tmp_path / f"{file}.gz").write_bytes(gzip.compress(b"small"))
    monkeypatch.setattr(routes_page, "STATIC", tmp_path)
    async with on_air() as air:
        for path, caching in (("/", "no-cache"), ("/assets/page-1a2b.js", "max-age=31536000, immutable")):
            async with air.client.get(path, headers={"Accept-Encoding": "gzip"}) as answer:
                assert await answer.text() == "small"
                assert (answer.headers["Content-Encoding"], answer.headers["Cache-Control"]) == ("gzip", caching)
        async with air.client.get("/", headers={"Accept-Encoding": "identity"}) as answer:
            assert await answer.text() == "<!doctype html>hello"
        async with air.client.get("/assets/page-1a2b.js.gz") as answer:
            assert answer.status == 404


async def test_a_missing_page_is_reported_as_not_built(
    on_air: Open, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(routes_page, "STATIC", tmp_path / "static")
    async with on_air() as air, air.client.get("/") as answer:
        assert answer.status == 503
        assert "make page" in (await answer.json())["error"]["message"]


async def test_the_points_of_a_live_block_are_explained(on_air: Open) -> None:
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


@pytest.mark.parametrize("request_line", ["GET / HTTP/9.9", "GET /\x01 HTTP/1.1", "\x16\x03\x01\x02"])
async def test_a_request_that_is_not_http_is_refused_without_a_traceback_in_the_log(
    on_air: Open, request_line: str, caplog: pytest.LogCaptureFixture
) -> None:
    async with on_air() as air:
        reader, writer = await asyncio.open_connection(air.client.host, air.client.port)
        writer.write(f"{request_line}\r\nHost: localhost\r\n\r\n".encode())
        assert b"400" in await reader.readline()
        writer.close()
    assert not any(record.exc_info for record in caplog.records)


async def test_a_body_that_cannot_be_decompressed_is_a_bad_request(
    on_air: Open, caplog: pytest.LogCaptureFixture
) -> None:
    async with on_air() as air:
        status, answer = await post(air, "/bml", b"not gzip", XML | {"Content-Encoding": "gzip"})
        assert (status, answer["error"]["code"]) == (400, "bad-request")
    assert not any(record.exc_info for record in caplog.records)
