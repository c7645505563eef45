"""The gallery: every lexeme and motion has a strip, and each strip plays."""

import importlib
from pathlib import Path
from shutil import copy
from types import ModuleType
from typing import TYPE_CHECKING

import pytest
from lxml import etree

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.bml.extensions import MOTIONS
from reactive_realizer.engine.lexicon import LexiconEntry, lexicon_of
from reactive_realizer.testing.pilot import open_pilot

from .conftest import DOCS, page

if TYPE_CHECKING:
    from gallery_entry import Entry

SCENE = SceneOptions(voice="text")


@pytest.fixture
def gallery(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module that makes the gallery."""
    monkeypatch.syspath_prepend(str(DOCS))
    return importlib.import_module("make_gallery")


@pytest.fixture
async def entries(gallery: ModuleType) -> list["Entry"]:
    known: list[Entry] = await gallery.known(SCENE)
    return known


async def lexicon() -> list[LexiconEntry]:
    async with open_scene(SCENE) as scene:
        return [entry for entry in lexicon_of(scene.realizer.characters["alice"].engines) if entry.problem is None]


def shown(entry: "Entry") -> set[tuple[str, str]]:
    """Its elements, with their lexemes."""
    elements = () if entry.script else etree.fromstring(entry.document).iter("*")
    return {(etree.QName(one).localname, one.get("lexeme") or one.get("name") or "") for one in elements}


async def test_every_lexeme_and_motion_has_a_strip(entries: list["Entry"]) -> None:
    there = {pair for entry in entries for pair in shown(entry)}
    assert {(entry.element, entry.lexeme) for entry in await lexicon()} <= there
    assert {behavior.__name__.lower() for behavior in MOTIONS} <= {element.lower() for element, _ in there}


async def test_every_strip_has_its_own_file(entries: list["Entry"]) -> None:
    names = [entry.name for entry in entries]
    assert sorted(names) == sorted(file.stem for file in (DOCS / "gallery").glob("*.webp"))


async def test_the_page_of_the_gallery_shows_all_strips(gallery: ModuleType, entries: list["Entry"]) -> None:
    assert page("docs/gallery/README.md") == gallery.index(entries), "run `make gallery`"


async def test_each_strip_plays_without_a_warning(entries: list["Entry"]) -> None:
    async with open_pilot(SCENE) as pilot:
        for entry in entries:
            if entry.script:
                pilot.perform(f"TIME_RESET\n{entry.script}")
            else:
                pilot.perform(entry.document.replace("<bml ", '<bml composition="REPLACE" ', 1))
            await pilot.advance(0.5)
        assert pilot.feedback.warnings == []


def test_an_unknown_strip_is_refused(
    gallery: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["make_gallery.py", "--browser", "sh", "head-nod", "head-nood"])
    with pytest.raises(SystemExit, match="2"):
        gallery.main()
    assert "unknown names: head-nood; names are those of the files in gallery" in capsys.readouterr().err


@pytest.mark.browser
@pytest.mark.timeout(120)
async def test_a_comparison_finds_equal_and_different_strips(
    gallery: ModuleType,
    entries: list["Entry"],
    chromium: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(gallery, "MOMENTS", 2)
    nod, shake = (next(entry for entry in entries if entry.name == name) for name in ("head-nod", "head-shake"))
    assert await gallery.make([nod], SCENE, tmp_path, chromium, compare=False) == 0
    copy(tmp_path / "head-nod.webp", tmp_path / "head-shake.webp")
    assert await gallery.make([nod, shake], SCENE, tmp_path, chromium, compare=True) == 1
    made, same, other = capsys.readouterr().out.splitlines()
    assert (made, same) == ("head-nod.webp", "head-nod: same")
    assert other.startswith("head-shake: ")
    assert other.endswith("% differs")
