"""The conformance suite against this realizer, against faulty ones, and against servers that are not realizers."""

import asyncio
import json
from collections import Counter
from functools import partial

import pytest
from aiohttp import web
from aiohttp.test_utils import unused_port

from reactive_realizer.__main__ import main
from reactive_realizer.cli import conformance as command
from reactive_realizer.conformance import suite
from reactive_realizer.conformance.case import read_suite
from reactive_realizer.conformance.suite import Outcome, Verdict, run_suite

from .conftest import WrongRealizer, address_of

NOT_REALIZED = {
    "face",
    "face-facs",
    "face-shift",
}


async def outcomes(url: str, *names: str, patience: float = suite.PATIENCE) -> list[Outcome]:
    cases = [case for case in read_suite() if not names or case.name in names]
    return [outcome async for outcome in run_suite(url, cases, patience)]


async def test_this_realizer_passes_every_case_that_it_supports(realizer: str) -> None:
    came = await outcomes(realizer)
    assert [(o.case.name, o.problems) for o in came if o.verdict is Verdict.FAILED] == []
    assert {o.case.name for o in came if o.verdict is Verdict.UNSUPPORTED} <= NOT_REALIZED
    assert sum(o.checks for o in came) > 700


async def test_the_suite_can_be_repeated_and_stops_all_blocks_before_each_case(realizer: str) -> None:
    names = ("two-voices", "replace")
    for _ in range(2):
        assert {o.verdict for o in await outcomes(realizer, *names)} == {Verdict.PASSED}


async def test_a_realizer_with_wrong_feedback_fails_every_case() -> None:
    async with address_of(WrongRealizer().serve) as url:
        came = await outcomes(url, patience=0.02)
    assert Counter(o.verdict for o in came) == {Verdict.FAILED: len(read_suite())}
    (empty,) = [o for o in came if o.case.name == "empty"]
    assert any("more than once" in problem and "nothing:start" in problem for problem in empty.problems)
    assert any("nothing:start was reported 2 times" in problem for problem in empty.problems)


# --- the command


async def conformance(*arguments: str) -> int:
    return await asyncio.to_thread(main, ["conformance", *arguments])


async def test_the_exit_status_is_0_and_a_table_is_printed_if_all_cases_pass(
    realizer: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert await conformance(realizer, "--case", "empty", "--case", "locomotion", "--case", "wait") == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    verdicts = [line.split()[:2] for line in captured.out.splitlines() if line[:1] != " "]
    assert verdicts[0] == ["passed", "empty"]
    assert verdicts[1] == ["passed", "locomotion"]
    assert verdicts[2] == ["passed", "wait"]
    assert captured.out.splitlines()[-1].endswith("3 passed, 0 failed, 0 unsupported")


async def test_the_exit_status_is_1_and_the_table_gives_the_reasons_if_a_case_fails(
    capsys: pytest.CaptureFixture[str],
) -> None:
    async with address_of(WrongRealizer().serve) as url:
        assert await conformance(url, "--case", "empty") == 1
    out = capsys.readouterr().out
    assert out.startswith("failed")
    assert "  nothing was predicted of nothing before nothing:end was reported (the last prediction before it)\n" in out


async def test_the_json_output_has_the_results_of_the_table(realizer: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(realizer, "--case", "speech", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["passed"], told["failed"], told["unsupported"]) == (1, 0, 0)
    (case,) = told["cases"]
    assert (case["name"], case["verdict"], case["problems"]) == ("speech", "passed", [])
    assert case["checks"] > 4


async def test_the_exit_status_is_2_if_no_server_listens(capsys: pytest.CaptureFixture[str]) -> None:
    url = f"http://127.0.0.1:{unused_port()}"
    assert await conformance(url) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"no realizer can be reached at {url}: ")


@pytest.mark.parametrize("url", ["nonsense", "http://", "ftp://127.0.0.1:1", "http://127.0.0.1:notaport"])
async def test_the_exit_status_is_2_for_an_invalid_address(url: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(url) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


async def test_the_exit_status_is_2_if_the_server_is_not_a_realizer(capsys: pytest.CaptureFixture[str]) -> None:
    async def page(request: web.Request) -> web.Response:
        return web.Response(text="welcome")

    async with address_of(page) as url:
        assert await conformance(url) == 2
    assert "no realizer can be reached at" in capsys.readouterr().err


async def test_the_exit_status_is_2_for_another_protocol_version(capsys: pytest.CaptureFixture[str]) -> None:
    async with address_of(WrongRealizer({"type": "hello", "protocol": 3}).serve) as url:
        assert await conformance(url) == 2
    assert 'protocol": 3' in capsys.readouterr().err


async def test_the_exit_status_is_2_if_the_connection_is_lost(capsys: pytest.CaptureFixture[str]) -> None:
    async def leave(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 2})
        await socket.receive()
        return socket

    async with address_of(leave) as url:
        assert await conformance(url) == 2
    assert "the connection was lost" in capsys.readouterr().err


async def test_the_exit_status_is_2_after_one_case_if_the_realizer_does_not_respond(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "run_suite", partial(run_suite, patience=0.05))
    listened: list[str] = []

    async def listen(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 2})
        listened.extend([message.data async for message in socket])
        return socket

    async with address_of(listen) as url:
        assert await conformance(url) == 2
    assert "sent no message for 0.05 s" in capsys.readouterr().err
    assert len(listened) == 1


def test_the_exit_status_is_2_for_an_unknown_case(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["conformance", "http://127.0.0.1:1", "--case", "no-such-case"])
    assert ended.value.code == 2
    assert "no-such-case" in capsys.readouterr().err


def test_the_help_contains_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["conformance", "--help"])
    assert "example: reactive-realizer conformance" in capsys.readouterr().out
