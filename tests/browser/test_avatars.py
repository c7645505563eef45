"""A VRM avatar in the page: the package's female figure, with morph targets that only its expressions explain."""

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from playwright.async_api import Page, expect

from reactive_realizer.embodiment.glb import read_binary, write_binary

from .conftest import Serve

pytestmark = [
    pytest.mark.browser,
    pytest.mark.speech,
    pytest.mark.timeout(300),
    pytest.mark.asyncio(loop_scope="module"),
]

FEMALE = Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb"
ANNA = '[character.alice]\navatar = "avatars/anna.vrm"\n'
BML = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0"'
SPEECH = f'<bml {BML} id="b"><speech id="s"><text>Papa has a large car, far far away.</text></speech></bml>'
EYES = f'<bml {BML} id="eyes"><faceLexeme id="shut" lexeme="CLOSE_EYES" amount="1" end="20"/></bml>'


BLINK = ("eyeBlinkLeft", "eyeBlinkRight")


def group(preset: str, *targets: int) -> dict[str, Any]:
    return {"presetName": preset, "binds": [{"mesh": 0, "index": target, "weight": 100} for target in targets]}


def write_vrm(path: Path) -> dict[str, str]:
    """Write a VRM 0 file, and return the names of its morph targets by those of ARKit."""
    scene, data = read_binary(FEMALE)
    face = scene["meshes"][0]
    names: list[str] = face.pop("extras")["targetNames"]
    renamed = {name: f"key {i}" for i, name in enumerate(names)}
    for primitive in face["primitives"]:
        primitive["extras"] = {"targetNames": [*renamed.values()]}
    toe = next(i for i, node in enumerate(scene["nodes"]) if node["name"] == "LeftToeBase")
    at: Callable[[str], int] = names.index
    groups = [group("a", at("jawOpen")), group("u", at("mouthPucker")), group("blink", *map(at, BLINK))]
    springs = {"boneGroups": [{"bones": [toe], "stiffiness": 1.0, "colliderGroups": []}]}
    faces = {"blendShapeGroups": groups}
    vrm = {"humanoid": {"humanBones": []}, "blendShapeMaster": faces, "secondaryAnimation": springs}
    scene["extensionsUsed"], scene["extensions"] = ["KHR_materials_clearcoat", "VRM"], {"VRM": vrm}
    write_binary(path, scene, data)
    return renamed


async def send(page: Page, xml: str) -> None:
    await page.fill("#bml-text", xml)
    await page.click("#bml-form button[type=submit]")
    await expect(page.locator("#bml-answer")).to_have_text("Accepted")


async def shows(page: Page, morph: str, least: float) -> None:
    """Wait until a morph has more than some weight."""
    await page.wait_for_function("([morph, least]) => viewer.morph('alice', morph) > least", arg=[morph, least])


async def test_a_vrm_avatar_speaks_and_blinks_by_its_expressions(serve: Serve, tmp_path: Path) -> None:
    (tmp_path / "avatars").mkdir()
    renamed = write_vrm(tmp_path / "avatars" / "anna.vrm")
    async with serve(ANNA, "espeak", (tmp_path,)) as scene:
        page = await scene.open()
        assert await page.evaluate("viewer.morph('alice', 'jawOpen')") is None
        await send(page, SPEECH)
        await shows(page, renamed["jawOpen"], 0.3)
        await send(page, EYES)
        await shows(page, renamed["eyeBlinkLeft"], 0.9)
        assert await page.evaluate(f"viewer.morph('alice', '{renamed['eyeBlinkRight']}')") > 0.9
        scripts = await page.evaluate("performance.getEntriesByType('resource').map(({ name }) => name)")
        assert any("springbone" in name for name in scripts)


async def test_the_code_of_springs_is_not_loaded_for_avatars_without_them(serve: Serve) -> None:
    async with serve("[character.alice]\n") as scene:
        page = await scene.open()
        scripts = await page.evaluate("performance.getEntriesByType('resource').map(({ name }) => name)")
        assert any("index" in name for name in scripts)
        assert not any("springbone" in name for name in scripts)
