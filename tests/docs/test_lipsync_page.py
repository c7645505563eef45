"""docs/lipsync.md: its bindings can be used as described."""

import math
import re
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.embodiment.joints import JAW
from reactive_realizer.embodiment.quaternion import rotation_vector
from reactive_realizer.engine.tts import Phoneme, Utterance, Word
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot
from tests.engines.speech.lip_sync.test_jaw_joint import with_jaw

from .conftest import fences, page

PAGE = "docs/lipsync.md"
LA = Utterance("la", 0.9, (Word("la", 0.0, 0, 2),), {}, (Phoneme("\u0251\u02d0", 0.1, 0.5), Phoneme("", 0.6, 0.3)))


def written(folder: Path) -> Path:
    for fence in fences(PAGE, "toml"):
        file = folder / fence.note
        file.parent.mkdir(exist_ok=True)
        file.write_text(fence.text, encoding="utf-8")
    return folder / "my_assets"


async def test_the_binding_of_a_character_makes_its_mouth_open_less(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assets = written(tmp_path)
    monkeypatch.setattr(TextVoice, "synthesize", lambda *_: LA)
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s"><text>la</text></speech>')
        await pilot.advance(1)
        jaw = pilot.realizer.characters["alice"].humanoid.avatar.morphs.index("jawOpen")
        assert max(frame.weights[jaw] for frame in pilot.frames["alice"]) == pytest.approx(0.2, abs=0.01)


def test_the_puppet_is_bound_by_its_own_file(tmp_path: Path) -> None:
    written(tmp_path)
    puppet = VisemeBinding.read([tmp_path / "puppet.visemes.toml"], ("Open", "Round"), Assets())
    assert puppet.shapes["aa"].morphs == {"Open": 1.0}
    assert puppet.shapes["ih"].morphs == {}
    assert puppet.visemes("b") == ("PP",)


def test_a_mistyped_morph_target_is_answered_as_shown(tmp_path: Path) -> None:
    file = written(tmp_path) / "mumble.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("jawOpen", "jawOpne"), encoding="utf-8")
    (message,) = re.findall(r"`(mumble[^`]*)`", page(PAGE).split("names it:")[1])
    with pytest.raises(RealizerError) as refused:
        VisemeBinding.read([file], ("jawOpen", "mouthLowerDownLeft", "mouthLowerDownRight"), Assets())
    assert str(refused.value) == message


async def test_the_speech_binding_opens_the_jaw(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for fence in fences(PAGE, "xml"):
        (tmp_path / fence.note).write_text(fence.text, encoding="utf-8")
    with_jaw(tmp_path / "puppet.glb")
    human = '[character.alice]\navatar = "puppet.glb"\nbindings = { speech = "speechbinding.xml" }\n'
    (tmp_path / "human.toml").write_text(human, encoding="utf-8")
    monkeypatch.setattr(TextVoice, "synthesize", lambda *_: LA)
    async with open_pilot(SceneOptions(tmp_path / "human.toml", "text", (tmp_path,))) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s"><text>la</text></speech>')
        await pilot.advance(1)
        opened = [rotation_vector(body.rotation(JAW))[0] for body in pilot.bodies()]
        assert max(opened) == pytest.approx(0.3, abs=0.01)
        assert pilot.feedback.warnings == []


def test_the_jaw_of_the_robot_turns(tmp_path: Path) -> None:
    written(tmp_path)
    robot = VisemeBinding.read([tmp_path / "robot.visemes.toml"], (), Assets(), (JAW,))
    assert robot.shapes["aa"].morphs == {f"{JAW}+x": pytest.approx(math.radians(18))}
