"""Bridges of plug-ins that are broken: a command that asks for one says so in a line, and no other is hurt."""

from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.registry import load_all
from reactive_realizer.cli.bridge import bridge

Install = Callable[..., None]
ROOM = """
import asyncio
from reactive_realizer.bridges.bridge import Bridge

async def run(url, options): ...

def no_options(parser):
    raise KeyError("--room")

GOOD = Bridge("Connects a room.", run)
BAD_OPTIONS = Bridge("Connects no room.", run, no_options)
NUMBER = 5

async def fails(url, options):
    raise LookupError("the room\\nis dark")

async def fails_in_a_group(url, options):
    async with asyncio.TaskGroup() as group:
        group.create_task(fails(url, options))

async def waits_for_what_is_canceled(url, options):
    task = asyncio.create_task(asyncio.sleep(9))
    task.cancel()
    await task

FAILS = Bridge("Fails.", fails)
FAILS_IN_A_GROUP = Bridge("Fails.", fails_in_a_group)
NO_COROUTINE = Bridge("Fails.", lambda url, options: None)
WAITS = Bridge("Waits.", waits_for_what_is_canceled)
"""
CANNOT = "'room' in the plug-in group bridges cannot be used: acme (%s): %s"


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Install:
    """Puts a distribution with one bridge on the path."""

    def install(distribution: str, name: str, value: str) -> None:
        metadata = tmp_path / f"{distribution}-1.dist-info"
        metadata.mkdir()
        (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 1\n")
        (metadata / "entry_points.txt").write_text(f"[reactive_realizer.bridges]\n{name} = {value}\n")
        monkeypatch.syspath_prepend(str(tmp_path))

    (tmp_path / "acme_room.py").write_text(ROOM)
    (tmp_path / "acme_raises.py").write_text("raise RuntimeError('no\\nluck')")
    (tmp_path / "acme_exits.py").write_text("raise SystemExit(0)")
    return install


@pytest.mark.parametrize("command", [["serve", "--bridge", "room"], ["bridge", "room", "http://127.0.0.1:9"]])
@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("acme_nowhere:ROOM", "ModuleNotFoundError: No module named 'acme_nowhere'"),
        ("acme_room:ROOM", "AttributeError: module 'acme_room' has no attribute 'ROOM'"),
        ("acme_raises:ROOM", "RuntimeError: no luck"),
        ("acme_exits:ROOM", "SystemExit: 0"),
        ("acme_room:NUMBER", "it is of the type int, not Bridge"),
        ("acme_room:BAD_OPTIONS", "KeyError: '--room'"),
    ],
)
def test_a_bridge_that_cannot_be_used_is_named_with_its_distribution_and_the_reason(
    install: Install, capsys: pytest.CaptureFixture[str], command: list[str], value: str, reason: str
) -> None:
    install("acme", "room", value)
    assert main(command) == 2
    assert capsys.readouterr().err == CANNOT % (value, reason) + "\n"


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("acme_room:FAILS", "LookupError: the room is dark"),
        ("acme_room:FAILS_IN_A_GROUP", "LookupError: the room is dark"),
        ("acme_room:NO_COROUTINE", "ValueError: a coroutine was expected, got None"),
        ("acme_room:WAITS", "CancelledError"),
    ],
)
def test_a_bridge_that_fails_while_it_runs_says_why_in_a_line(
    install: Install, capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture, value: str, reason: str
) -> None:
    install("acme", "room", value)
    assert main(["bridge", "room", "http://127.0.0.1:9"]) == 2
    assert capsys.readouterr().err == f"the bridge room has failed: {reason}\n"
    assert caplog.records == [], "a traceback is only written with --verbose"


def test_the_traceback_of_a_bridge_that_fails_is_in_the_verbose_log(
    install: Install, caplog: pytest.LogCaptureFixture
) -> None:
    install("acme", "room", "acme_room:FAILS")
    caplog.set_level("INFO")
    assert main(["--verbose", "bridge", "room", "http://127.0.0.1:9"]) == 2
    assert "in fails\n" in caplog.text


@pytest.mark.parametrize("command", [["serve", "--bridge", "embr"], ["bridge", "embr", "http://127.0.0.1:9"]])
def test_a_bridge_with_the_name_of_another_is_named_with_both_distributions(
    install: Install, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    install("acme", "embr", "acme_room:GOOD")
    assert main(command) == 2
    both = "acme (acme_room:GOOD), reactive-realizer (reactive_realizer.bridges.embr:BRIDGE)"
    said = capsys.readouterr().err
    assert said == f"'embr' in the plug-in group bridges is defined more than once: {both}\n"


def test_a_broken_bridge_that_is_not_asked_for_does_no_harm(
    install: Install, capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    install("acme", "room", "acme_raises:ROOM")
    assert bridge("embr").name == "embr"
    with pytest.raises(SystemExit, match="0"):
        main(["bridge", "--help"])
    load_all()
    assert CANNOT % ("acme_raises:ROOM", "RuntimeError: no luck") in caplog.messages
