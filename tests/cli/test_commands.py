"""The common properties of all commands."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block


@pytest.mark.parametrize(
    "command", ["serve", "demo", "realize", "check", "translate", "lexicon", "avatar", "physics", "conformance"]
)
def test_every_command_has_help_with_an_example(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main([command, "--help"])
    assert ended.value.code == 0
    assert f"example: reactive-realizer {command}" in capsys.readouterr().out


@pytest.mark.parametrize(("arguments", "unneeded"), [("--help", "numpy lxml aiohttp"), ("realize --help", "aiohttp")])
def test_a_command_imports_only_what_it_needs(arguments: str, unneeded: str) -> None:
    program = f"""import sys
from reactive_realizer.__main__ import main
try:
    main({arguments.split()!r})
except SystemExit:
    assert not set({unneeded.split()!r}) & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.DEVNULL)


def run_with(words: list[str], output: int) -> tuple[int, bytes]:
    """The exit status of a command and what it writes to stderr, when its output is buffered as usual."""
    program, buffered = [sys.executable, "-m", "reactive_realizer", *words], {**os.environ, "PYTHONUNBUFFERED": ""}
    ended = subprocess.run(program, stdout=output, stderr=subprocess.PIPE, env=buffered, check=False)
    return ended.returncode, ended.stderr


@pytest.mark.parametrize("command", ["translate FILE", "lexicon", "--help"])
def test_a_command_whose_reader_has_gone_says_nothing(bml: Callable[..., str], command: str) -> None:
    words = command.replace("FILE", bml(block("b", '<wait id="w" duration="1"/>'))).split()
    reading, writing = os.pipe()
    os.close(reading)
    assert run_with(words, writing) == (0 if "--help" in words else 141, b"")
    os.close(writing)


@pytest.mark.parametrize("command", ["translate FILE", "lexicon"])
def test_a_command_whose_output_cannot_be_written_says_so_in_a_line(bml: Callable[..., str], command: str) -> None:
    words = command.replace("FILE", bml(block("b", '<wait id="w" duration="1"/>'))).split()
    with Path("/dev/full").open("wb") as full:
        assert run_with(words, full.fileno()) == (2, b"[Errno 28] No space left on device\n")


def test_a_command_may_have_no_stdout(bml: Callable[..., str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    assert main(["translate", bml(block("b"))]) == 0


@pytest.mark.parametrize("command", ["realize", "check"])
@pytest.mark.parametrize("mistake", ["bindings = { foo = 'x' }", "[limits]\nblocks_alive = -1"])
def test_the_exit_status_is_2_for_an_invalid_human_file_with_one_line_of_error(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], command: str, mistake: str
) -> None:
    human = bml(f"[character.alice]\n{mistake}", "human.toml")
    assert main([command, bml(block("b")), "--human", human]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("human.toml: ")
