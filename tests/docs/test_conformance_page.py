"""docs/conformance.md: its output is what the command prints, and it lists every case."""

import asyncio
import json
import os
import re
import shlex
import sys
from pathlib import Path

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.conformance.case import SUITE, read_case, read_suite

from .conftest import ADDRESS, REPOSITORY, Fence, fences, page

PAGE = "docs/conformance.md"


@pytest.mark.parametrize("session", fences(PAGE, "console"), ids=str)
async def test_a_session_prints_the_output_on_the_page(
    server: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, session: Fence
) -> None:
    monkeypatch.chdir(REPOSITORY)
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}:{os.environ['PATH']}")
    command, *shown = session.text.removeprefix("$ ").splitlines()
    program, *arguments = shlex.split(command.replace(ADDRESS, server.rstrip("/")))
    assert program == "reactive-realizer"
    assert await asyncio.to_thread(main, arguments) == 0
    assert capsys.readouterr().out.splitlines() == shown


async def test_the_json_output_has_the_fields_on_the_page(server: str, capsys: pytest.CaptureFixture[str]) -> None:
    shown = json.loads(fences(PAGE, "json")[0].text)
    assert await asyncio.to_thread(main, ["conformance", server, "--case", "empty", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == shown | {"realizer": server}


def test_the_page_shows_the_case_of_the_suite() -> None:
    (case,) = fences(PAGE, "xml")
    assert read_case("replace", case.text.encode()) == read_case("replace", (SUITE / "replace.xml").read_bytes())


def test_the_page_lists_every_case_with_its_title() -> None:
    table = page(PAGE).partition("| case | asserts |")[2]
    rows = re.findall(r"^\| `([\w-]+)` \| (.*) \|$", table, re.MULTILINE)
    assert rows == [(case.name, case.title) for case in read_suite()]
