"""Files for the command line, and its output."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block

HELLO = block(
    "hello",
    """
    <speech id="say"><text>Hello, <sync id="you"/>how are you?</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="say:you"/>
    <gaze id="look" target="bluebox" start="0.5" end="2"/>
    """,
)


@pytest.fixture
def bml(tmp_path: Path) -> Callable[..., str]:
    def write(text: str, name: str = "a.xml") -> str:
        (tmp_path / name).write_text(text)
        return str(tmp_path / name)

    return write


@pytest.fixture
def realize(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> Callable[..., tuple[int, list[tuple[float, str]], str]]:
    """Runs ``realize``: exit status, feedback as (time, xml), stderr."""

    def run(*arguments: str) -> tuple[int, list[tuple[float, str]], str]:
        file = tmp_path / "feedback.jsonl"
        status = main(["realize", *arguments, "--voice", "text", "--feedback", str(file)])
        lines = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
        assert all(set(line) == {"time", "xml"} for line in lines)
        captured = capsys.readouterr()
        assert captured.out == "", "stdout carries only what was asked for"
        return status, [(line["time"], line["xml"]) for line in lines], captured.err

    return run
