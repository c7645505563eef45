"""docs/anticipators.md: the plug-in of its example is found and predicts."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

from .conftest import EXAMPLES, fences

PLUGIN = EXAMPLES / "anticipator"
ENTRY_POINTS = "[reactive_realizer.anticipators]\nturn_end = turn_end:TurnEnd\n"


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The plug-in as pip would leave it: on the path, with metadata that name its entry point."""
    metadata = tmp_path / "turn_end-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: turn-end\nVersion: 1.0\n", encoding="utf-8")
    (metadata / "entry_points.txt").write_text(ENTRY_POINTS, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.syspath_prepend(str(PLUGIN))


@pytest.mark.usefixtures("installed")
async def test_the_answer_comes_when_the_turn_is_predicted_to_end_and_waits_when_that_is_taken_back() -> None:
    async with open_pilot(SceneOptions(PLUGIN / "human.toml", "text")) as pilot:
        pilot.perform((PLUGIN / "reply.xml").read_bytes())
        await pilot.advance(1)
        pilot.event("user", "pause")
        await pilot.advance(0.1)
        assert pilot.feedback.predicted("reply:words:start") == pytest.approx(1.6)
        pilot.event("user", "voice")
        await pilot.advance(1.9)
        assert not pilot.feedback.reached("reply:words:start")
        pilot.event("user", "pause")
        await pilot.advance(3)
        assert pilot.feedback.time("reply:listening:start") == pytest.approx(3.2)
        assert pilot.feedback.time("reply:words:start") == pytest.approx(3.6)
        assert pilot.feedback.status("reply") == "DONE"
        assert pilot.feedback.warnings == []


def test_the_page_shows_the_files_of_the_example() -> None:
    (program,) = fences("docs/anticipators.md", "python")
    (block,) = fences("docs/anticipators.md", "xml")
    entry_points, human = fences("docs/anticipators.md", "toml")
    assert program.text == (PLUGIN / "turn_end.py").read_text(encoding="utf-8")
    assert block.text == (PLUGIN / "reply.xml").read_text(encoding="utf-8")
    assert entry_points.text in (PLUGIN / "pyproject.toml").read_text(encoding="utf-8")
    assert human.text in (PLUGIN / "human.toml").read_text(encoding="utf-8")
