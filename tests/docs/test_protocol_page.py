"""docs/protocol.md against the schema, the routes and the frames of the server."""

import json
import re
from collections.abc import AsyncIterator
from typing import Any

import numpy as np
import pytest
from aiohttp.test_utils import TestClient, TestServer
from jsonschema import Draft202012Validator

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.bml.names import BML
from reactive_realizer.clock.clock import ManualClock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.app import create_app
from reactive_realizer.server.frame_stream import encode_frame
from reactive_realizer.server.live_scene import LiveScene
from reactive_realizer.server.protocol import DOCUMENT
from reactive_realizer.server.routes_page import STATIC
from reactive_realizer.server.security import Security

from .conftest import Fence, fences, page

Client = TestClient[Any, Any]

SCHEMA = json.loads(DOCUMENT)
PAGES = ("docs/protocol.md", "docs/anticipators.md", "docs/planners.md", "docs/audio.md")
EXAMPLES = [example for name in PAGES for example in fences(name, "json")]
MESSAGES = [example for example in EXAMPLES if not example.note]
ANSWERS = [example for example in EXAMPLES if example.note]


@pytest.fixture
async def client() -> AsyncIterator[Client]:
    async with open_scene(SceneOptions(voice="text")) as scene:
        app = create_app(LiveScene(scene, ManualClock()), Security())
        async with TestClient(TestServer(app)) as client:
            yield client


def test_every_message_on_the_pages_is_valid(subtests: pytest.Subtests) -> None:
    for example in MESSAGES:
        with subtests.test(str(example)):
            Draft202012Validator(SCHEMA).validate(json.loads(example.text))


def test_every_message_has_an_example(subtests: pytest.Subtests) -> None:
    for direction in ["ClientMessage", "ServerMessage"]:
        with subtests.test(direction):
            validator = Draft202012Validator({"$ref": f"#/$defs/{direction}", "$defs": SCHEMA["$defs"]})
            messages = [json.loads(example.text) for example in MESSAGES]
            shown = {message["type"] for message in messages if validator.is_valid(message)}
            names = [alternative["$ref"].rpartition("/")[2] for alternative in SCHEMA["$defs"][direction]["oneOf"]]
            assert shown == {SCHEMA["$defs"][name]["properties"]["type"]["const"] for name in names}


@pytest.mark.parametrize("example", ANSWERS, ids=str)
async def test_the_answer_to_a_request_has_the_fields_on_the_page(client: Client, example: Fence) -> None:
    method, path, status = example.note.removeprefix("answer: ").split()
    body = f'<bml xmlns="{BML}"/>' if method == "POST" else None
    answer = await client.request(method, path, data=body, headers={"Content-Type": "text/xml"} if body else None)
    told, shown = await answer.json(), json.loads(example.text)
    assert answer.status == int(status)
    assert told.keys() == shown.keys()
    if "error" in shown:
        assert told == shown
    for name in ("ticks", "worker"):
        assert told.get(name, {}).keys() == shown.get(name, {}).keys()


def routes_of(client: Client) -> set[str]:
    """Method and path of every route, the files of the page aside."""
    files = {f"/{file.relative_to(STATIC).as_posix()}" for file in STATIC.rglob("*")}
    routes = [(route.method, route.resource.canonical) for route in client.app.router.routes() if route.resource]
    return {f"{method} {path}" for method, path in routes if method in ("GET", "POST") and path not in files}


async def test_the_page_lists_every_route(client: Client) -> None:
    listed = set(re.findall(r"^\| `((?:GET|POST) \S+)` \|", page("docs/protocol.md"), re.MULTILINE))
    assert listed == routes_of(client)


def test_the_program_on_the_page_reads_the_frames_of_a_message() -> None:
    (program,) = fences("docs/protocol.md", "python")
    names: dict[str, Any] = {}
    exec(compile(program.text, str(program), "exec"), names)
    rotations = np.array([[1.0, 0.0, 0.0, 0.0], [0.5, -0.5, 0.5, 0.5]])
    weights = np.array([0.0, 0.25, 1.0])
    other = encode_frame(0, 7, GlobalTime(2.5), np.zeros(3), rotations[:1], weights[:0])
    frame = encode_frame(1, 7, GlobalTime(2.5), np.array([0.5, 1.0, -1.0]), rotations, weights)
    first, read = names["read_frames"](other + frame)
    assert first["character"] == 0
    assert (read["character"], read["time"], read["root"]) == (1, 2.5, [0.5, 1.0, -1.0])
    assert read["rotations"] == pytest.approx(rotations, abs=1e-4)
    assert read["weights"] == pytest.approx(weights, abs=1e-4)
