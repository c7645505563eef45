"""The suite against our own realizer, and against those that are none or bad ones."""

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
    "locomotion",
}


async def outcomes(url: str, *names: str, patience: float = suite.PATIENCE) -> list[Outcome]:
    cases = [case for case in read_suite() if not names or case.name in names]
    return [outcome async for outcome in run_suite(url, cases, patience)]


async def test_our_own_realizer_passes_every_case_of_what_it_realizes(realizer: str) -> None:
    came = await outcomes(realizer)
    assert [(o.case.name, o.problems) for o in came if o.verdict is Verdict.FAILED] == []
    assert {o.case.name for o in came if o.verdict is Verdict.UNSUPPORTED} <= NOT_REALIZED
    assert sum(o.checks for o in came) > 700


async def test_it_may_be_run_again_and_stops_whatever_plays(realizer: str) -> None:
    names = ("two-voices", "replace")
    for _ in range(2):
        assert {o.verdict for o in await outcomes(realizer, *names)} == {Verdict.PASSED}


async def test_a_realizer_that_does_everything_wrong_fails_every_case() -> None:
    async with address_of(WrongRealizer().serve) as url:
        came = await outcomes(url, patience=0.02)
    assert Counter(o.verdict for o in came) == {Verdict.FAILED: len(read_suite())}
    (empty,) = [o for o in came if o.case.name == "empty"]
    assert any("more than once" in problem and "nothing:start" in problem for problem in empty.problems)
    assert any("nothing:start was reported 2 times" in problem for problem in empty.problems)


# --- the command


async def conformance(*arguments: str) -> int:
    return await asyncio.to_thread(main, ["conformance", *arguments])


async def test_that_all_cases_passed_is_0_and_a_table(realizer: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(realizer, "--case", "empty", "--case", "locomotion", "--case", "wait") == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    verdicts = [line.split()[:2] for line in captured.out.splitlines() if line[:1] != " "]
    assert verdicts[0] == ["passed", "empty"]
    assert verdicts[1][1] == "locomotion"
    assert verdicts[2] == ["passed", "wait"]
    assert captured.out.splitlines()[-1].endswith("0 failed, 1 unsupported")


async def test_that_a_case_failed_is_1_and_the_table_says_why(capsys: pytest.CaptureFixture[str]) -> None:
    async with address_of(WrongRealizer().serve) as url:
        assert await conformance(url, "--case", "empty") == 1
    out = capsys.readouterr().out
    assert out.startswith("failed")
    assert "  nothing was predicted of nothing before nothing:end was reported (the last prediction before it)\n" in out


async def test_json_says_the_same(realizer: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(realizer, "--case", "speech", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["passed"], told["failed"], told["unsupported"]) == (1, 0, 0)
    (case,) = told["cases"]
    assert (case["name"], case["verdict"], case["problems"]) == ("speech", "passed", [])
    assert case["checks"] > 4


async def test_that_nobody_is_there_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    url = f"http://127.0.0.1:{unused_port()}"
    assert await conformance(url) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"no realizer can be reached at {url}: ")


@pytest.mark.parametrize("url", ["nonsense", "http://", "ftp://127.0.0.1:1", "http://127.0.0.1:notaport"])
async def test_what_is_no_address_is_2(url: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(url) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


async def test_a_server_of_something_else_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    async def page(request: web.Request) -> web.Response:
        return web.Response(text="welcome")

    async with address_of(page) as url:
        assert await conformance(url) == 2
    assert "no realizer can be reached at" in capsys.readouterr().err


async def test_a_realizer_of_another_protocol_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    async with address_of(WrongRealizer({"type": "hello", "protocol": 2}).serve) as url:
        assert await conformance(url) == 2
    assert 'protocol": 2' in capsys.readouterr().err


async def test_a_realizer_that_goes_away_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    async def leave(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 1})
        await socket.receive()
        return socket

    async with address_of(leave) as url:
        assert await conformance(url) == 2
    assert "the connection was lost" in capsys.readouterr().err


async def test_a_realizer_that_says_hello_and_then_nothing_is_2_without_trying_every_case(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "run_suite", partial(run_suite, patience=0.05))
    listened: list[str] = []

    async def listen(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 1})
        listened.extend([message.data async for message in socket])
        return socket

    async with address_of(listen) as url:
        assert await conformance(url) == 2
    assert "sent no message for 0.05 s" in capsys.readouterr().err
    assert len(listened) == 1


def test_a_case_that_there_is_not_is_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["conformance", "http://127.0.0.1:1", "--case", "no-such-case"])
    assert ended.value.code == 2
    assert "no-such-case" in capsys.readouterr().err


def test_its_help_has_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["conformance", "--help"])
    assert "example: reactive-realizer conformance" in capsys.readouterr().out
