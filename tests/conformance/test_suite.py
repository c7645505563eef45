"""The conformance suite against this realizer, against faulty ones, and against servers that are not realizers."""

import asyncio
import json
import sys
from collections import Counter
from pathlib import Path

import pytest
from aiohttp import web
from aiohttp.test_utils import unused_port

from reactive_realizer.__main__ import main
from reactive_realizer.cli import conformance as command
from reactive_realizer.conformance import suite
from reactive_realizer.conformance.case import Profile, read_suite
from reactive_realizer.conformance.connection import SocketConnection
from reactive_realizer.conformance.suite import Outcome, Verdict, run_suite

from .conftest import NOT_REALIZED, WrongRealizer, address_of, plain_realizer

ADAPTER = Path(__file__).resolve().parents[2] / "examples" / "conformance_adapter.py"


async def outcomes(url: str, *names: str, patience: float = suite.PATIENCE) -> list[Outcome]:
    cases = [case for case in read_suite() if not names or case.name in names]
    return [outcome async for outcome in run_suite(SocketConnection(url, patience), cases)]


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
    assert "  nothing:start was reported 2 times (all of nothing is between its start and its end)\n" in out
    assert "predicted" not in out


async def test_what_a_profile_adds_is_asserted_if_it_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    prediction = "  nothing was predicted of nothing before nothing:end was reported (the last prediction before it)\n"
    async with address_of(WrongRealizer().serve) as url:
        assert await conformance(url, "--case", "empty", "--profile", "predictions") == 1
        assert prediction in capsys.readouterr().out
        assert await conformance(url, "--case", "empty", "--profile", "status") == 1
        out = capsys.readouterr().out
    assert "  nothing ended None instead of DONE (nothing ends DONE)\n" in out
    assert prediction not in out


async def test_a_realizer_that_tells_only_what_bml_requires_conforms(capsys: pytest.CaptureFixture[str]) -> None:
    """It has no states and no predictions, and warns of other things in other words."""
    cases = ("empty", "wait", "append", "bad-lexeme", "posture")
    async with plain_realizer() as url:
        arguments = [word for name in cases for word in ("--case", name)]
        assert await conformance(url, *arguments) == 0, capsys.readouterr().out
        assert await conformance(url, *arguments, "--profile", "all") == 1


def test_without_profiles_no_case_of_an_extension_is_asked_of_a_realizer() -> None:
    names = {case.name for case in read_suite() if case.profile is Profile.BML}
    assert "append" in names
    assert not [name for name in names if name.startswith("bmla")]


# --- a program instead of a server


async def test_a_realizer_may_be_a_program_that_reads_and_writes_lines(
    realizer: str, capsys: pytest.CaptureFixture[str]
) -> None:
    program = f"{sys.executable} {ADAPTER} {realizer}"
    names = ("wait", "speech", "bad-xml")
    arguments = [word for name in names for word in ("--case", name)]
    assert await conformance("--program", program, *arguments, "--profile", "all") == 0, capsys.readouterr().out
    assert "3 passed" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("no-such-program", "no-such-program"),
        ('unclosed "quote', "No closing quotation"),
        ("", "at : no program is named"),
        (" ", "at  : no program is named"),
        (f'{sys.executable} -c "raise SystemExit(3)"', "it ended with status 3"),
        (f'{sys.executable} -c "print(17_000_000 * chr(65))"', "it wrote a line of more than 16000000 bytes"),
    ],
    ids=["none", "no command", "empty", "blank", "ends", "endless line"],
)
async def test_the_exit_status_is_2_if_the_program_cannot_be_tested(
    capsys: pytest.CaptureFixture[str], program: str, said: str
) -> None:
    assert await conformance("--program", program, "--case", "empty") == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    "program",
    [
        "yes '<feedback/>'",
        "yes '<syncPointProgress id=\"b:w:start\"/>'",
        "yes '<oops'",
        "sh -c 'yes \"<feedback/>\" | cat'",
        'sh -c \'trap "" TERM; yes "<feedback/>"\'',
    ],
    ids=["unknown feedback", "progress", "no XML", "by another program", "unwilling to end"],
)
async def test_the_exit_status_is_2_soon_if_the_program_never_stops_to_send(
    capsys: pytest.CaptureFixture[str], program: str
) -> None:
    async with asyncio.timeout(15):
        assert await conformance("--program", program, "--start", "20") == 2
    sent = "'<oops'" if "oops" in program else "'<"
    assert f"it sends more than 10000 messages for a case, the last one {sent}" in capsys.readouterr().err


async def test_the_exit_status_is_2_if_the_program_says_nothing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "PATIENCE", 0.05)
    program = f'{sys.executable} -c "import sys; sys.stdin.read()"'
    assert await conformance("--program", program) == 2
    assert "sent no feedback for 0.05 s" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("cat", "sent no feedback for 0.3 s, only '<bml xmlns="),
        ("sh -c 'echo loading; cat >/dev/null'", "sent no feedback for 0.3 s, only 'loading'"),
        ("sh -c 'while read line; do echo \"<oops\"; done'", "sent no feedback for 0.3 s, only '<oops'"),
        ("sh -c 'cat >/dev/null'", "sent no feedback for 0.3 s\n"),
    ],
    ids=["an echo", "a log", "no XML", "silence"],
)
async def test_the_exit_status_is_2_soon_if_the_program_sends_no_feedback(
    capsys: pytest.CaptureFixture[str], program: str, said: str
) -> None:
    assert await conformance("--program", program, "--start", "0.3") == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert said in captured.err


@pytest.mark.parametrize(("option", "said"), [("--tolerance=nan", "nan"), ("--profile=x", "'bml', 'bmla', 'ext")])
def test_options_without_a_meaning_are_refused(capsys: pytest.CaptureFixture[str], option: str, said: str) -> None:
    with pytest.raises(SystemExit):
        main(["conformance", "--program", "true", option])
    assert said in capsys.readouterr().err


async def test_the_json_output_has_the_results_of_the_table(realizer: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance(realizer, "--case", "speech", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["passed"], told["failed"], told["unsupported"]) == (1, 0, 0)
    (case,) = told["cases"]
    assert (case["name"], case["verdict"], case["problems"]) == ("speech", "passed", [])
    assert case["checks"] >= 4


async def test_the_exit_status_is_2_if_no_server_listens(capsys: pytest.CaptureFixture[str]) -> None:
    url = f"http://127.0.0.1:{unused_port()}"
    assert await conformance(url) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"no realizer can be reached at {url}: ")


@pytest.mark.parametrize("url", ["nonsense", "", "http://", "127.0.0.1:8088", "ftp://127.0.0.1:1"])
async def test_the_exit_status_is_2_for_an_invalid_address_which_is_shown_without_its_token(
    url: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert await conformance(f"{url}?token=secret") == 2
    reason = "this is not an address such as http://127.0.0.1:8088"
    assert capsys.readouterr().err == f"no realizer can be reached at {url}: {reason}\n"


async def test_the_exit_status_is_2_for_an_invalid_port(capsys: pytest.CaptureFixture[str]) -> None:
    assert await conformance("http://127.0.0.1:notaport") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "port" in line.partition(": ")[2]


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
    monkeypatch.setattr(command, "PATIENCE", 0.05)
    listened: list[str] = []

    async def listen(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_json({"type": "hello", "protocol": 2})
        listened.extend([message.data async for message in socket])
        return socket

    async with address_of(listen) as url:
        assert await conformance(url) == 2
    assert "sent no feedback for 0.05 s" in capsys.readouterr().err
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
