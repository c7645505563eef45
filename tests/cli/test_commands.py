"""The common properties of all commands."""

from collections.abc import Callable

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block


@pytest.mark.parametrize("command", ["realize", "check"])
def test_every_command_has_help_with_an_example(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main([command, "--help"])
    assert ended.value.code == 0
    assert f"example: reactive-realizer {command}" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["realize", "check"])
@pytest.mark.parametrize("mistake", ["bindings = { foo = 'x' }", "[limits]\nblocks_alive = -1"])
def test_the_exit_status_is_2_for_an_invalid_human_file_with_one_line_of_error(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], command: str, mistake: str
) -> None:
    human = bml(f"[character.alice]\n{mistake}", "human.toml")
    assert main([command, bml(block("b")), "--human", human]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("human.toml: ")
