"""The commands on the pages run, and print the output that the pages show."""

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main

from .conftest import EXAMPLES, REPOSITORY, Fence, fences, page

PAGES = ["README.md", *(f"docs/{path.name}" for path in sorted((REPOSITORY / "docs").glob("*.md")))]
SESSIONS = [fence for name in PAGES for fence in fences(name, "console")]
RUN = ("realize", "check", "translate")


def commands(session: Fence) -> Iterator[tuple[list[str], list[str]]]:
    """Each command with the output below it."""
    for command in re.split(r"^\$ ", session.text, flags=re.MULTILINE)[1:]:
        line, *shown = command.splitlines()
        yield shlex.split(line), shown


def fits(printed: str, shown: str) -> bool:
    """Whether a line matches the page, where three dots stand for the rest of a line."""
    return printed.startswith(shown[:-3]) if shown.endswith("...") else printed == shown


def run(arguments: list[str]) -> int:
    try:
        return main(arguments)
    except SystemExit as ended:
        return int(ended.code or 0)


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A copy of the examples in a folder in which commands may write."""
    (tmp_path / "examples").symlink_to(EXAMPLES)
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("elsewhere")
@pytest.mark.parametrize("session", SESSIONS, ids=str)
def test_a_session_on_a_page_prints_the_output_on_the_page(session: Fence, capsys: pytest.CaptureFixture[str]) -> None:
    status = 0
    for (program, *arguments), shown in commands(session):
        if program == "reactive-realizer" and arguments[0] in RUN and "--video" not in arguments:
            status = run(arguments)
            printed = capsys.readouterr().out.splitlines()
            assert len(printed) == len(shown), printed
            assert [line for line, whole in zip(printed, shown, strict=True) if not fits(line, whole)] == []
        elif program == "echo":
            assert shown == [str(status)]
        else:  # other tests run servers and their clients, and film
            assert program in ("reactive-realizer", "make", "pip", "python", "curl")


@pytest.mark.usefixtures("elsewhere")
def test_the_program_on_the_page_reads_the_frames(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["realize", "examples/say_hello.xml", "--voice", "text", "--frames", "hello.npz"]) == 0
    (program,) = fences("docs/cli.md", "python")
    exec(compile(program.text, str(program), "exec"), {})
    assert re.fullmatch(r"\(\d+, 4\)\n", capsys.readouterr().out)


def test_the_lexicon_has_the_lines_on_the_page(capsys: pytest.CaptureFixture[str]) -> None:
    section = page("docs/cli.md").partition("## lexicon")[2].partition("\n## ")[0]
    shown = re.findall(r"^ {4}(RAISE_HAND.*)$", section, re.MULTILINE)
    assert run(["lexicon", "--assets", str(EXAMPLES / "gesture")]) == 0
    printed = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert [line for line in printed if line.startswith("RAISE_HAND")] == shown


@pytest.mark.parametrize(
    "command", ["realize", "check", "translate", "lexicon", "physics", "serve", "demo", "conformance"]
)
def test_the_page_lists_every_option(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([command, "--help"]) == 0
    options = set(re.findall(r"--[a-z-]+", capsys.readouterr().out)) - {"--help"}
    text = (REPOSITORY / "docs" / "cli.md").read_text(encoding="utf-8")
    assert {option for option in options if f"`{option}" not in text} == set()
