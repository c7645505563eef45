"""docs/conformance.md: what it shows is what comes, and it names every case."""

import asyncio
import json
import re
import shlex
from collections.abc import AsyncIterator

import pytest
from aiohttp.test_utils import TestServer

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.clock import SystemClock
from reactive_realizer.conformance.case import SUITE, read_case, read_suite
from reactive_realizer.server.app import create_app
from reactive_realizer.server.live import Live
from reactive_realizer.server.security import Security

from .conftest import fences, page

PAGE = "docs/conformance.md"
ADDRESS = "http://127.0.0.1:8088"


@pytest.fixture
async def server() -> AsyncIterator[str]:
    async with open_scene(SceneOptions(voice="text")) as scene, asyncio.TaskGroup() as group:
        live = Live(scene, SystemClock())
        ticking = group.create_task(live.run())
        async with TestServer(create_app(live, Security())) as server:
            yield str(server.make_url("")).rstrip("/")
        ticking.cancel()


async def test_the_session_goes_as_it_is_shown(server: str, capsys: pytest.CaptureFixture[str]) -> None:
    (session,) = fences(PAGE, "console")
    command, *shown = session.text.removeprefix("$ ").splitlines()
    program, *arguments = shlex.split(command.replace(ADDRESS, server))
    assert program == "reactive-realizer"
    assert await asyncio.to_thread(main, arguments) == 0
    assert capsys.readouterr().out.splitlines() == shown


async def test_the_json_has_the_fields_that_are_shown(server: str, capsys: pytest.CaptureFixture[str]) -> None:
    shown = json.loads(fences(PAGE, "json")[0].text)
    assert await asyncio.to_thread(main, ["conformance", server, "--case", "empty", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == shown | {"url": server}


def test_the_page_shows_the_case_as_it_is() -> None:
    (case,) = fences(PAGE, "xml")
    assert read_case("replace", case.text.encode()) == read_case("replace", (SUITE / "replace.xml").read_bytes())


def test_the_page_names_every_case_and_what_it_tries() -> None:
    rows = re.findall(r"^\| `([\w-]+)` \| (.*) \|$", page(PAGE), re.MULTILINE)
    assert rows == [(case.name, case.title) for case in read_suite()]
