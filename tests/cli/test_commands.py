"""The common properties of all commands."""

import subprocess
import sys
from collections.abc import Callable

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


@pytest.mark.parametrize("command", ["realize", "check"])
@pytest.mark.parametrize("mistake", ["bindings = { foo = 'x' }", "[limits]\nblocks_alive = -1"])
def test_the_exit_status_is_2_for_an_invalid_human_file_with_one_line_of_error(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], command: str, mistake: str
) -> None:
    human = bml(f"[character.alice]\n{mistake}", "human.toml")
    assert main([command, bml(block("b")), "--human", human]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("human.toml: ")
