"""Face bindings in AsapRealizer's format, as seen in frames."""

from collections.abc import Callable
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .conftest import STILL, weight
from .test_face_lexemes import OURS

BINDING = """<facebinding>
  <FaceUnitSpec type="faceLexeme">
    <constraints><constraint name="lexeme" value="delighted"/></constraints>
    <parametermap><parameter src="amount" dst="intensity"/></parametermap>
    <parameterdefaults>
      <parameterdefault name="angle" value="315"/><parameterdefault name="activation" value="5.4"/>
    </parameterdefaults>
    <FaceUnit type="Plutchik"/>
  </FaceUnitSpec>
  <FaceUnitSpec type="faceLexeme">
    <constraints><constraint name="lexeme" value="skeptical"/></constraints>
    <parametermap><parameter src="amount" dst="intensity"/></parametermap>
    <parameterdefaults><parameterdefault name="intensity" value="1"/></parameterdefaults>
    <FaceUnit type="FACS" filename="Humanoids/anyone/skeptical.xml"/>
  </FaceUnitSpec>
  <FaceUnitSpec type="faceLexeme">
    <constraints><constraint name="lexeme" value="pout"/></constraints>
    <parameterdefaults><parameterdefault name="targetname" value="mouthPucker"/></parameterdefaults>
    <FaceUnit type="Morph"/>
  </FaceUnitSpec>
  <FaceUnitSpec type="faceLexeme">
    <constraints><constraint name="lexeme" value="SMILE"/></constraints>
    <parameterdefaults><parameterdefault name="targetname" value="head-mesh-smile"/></parameterdefaults>
    <FaceUnit type="Morph"/>
  </FaceUnitSpec>
</facebinding>"""

SKEPTICAL = """<FACSConfiguration>
  <AU number="2" side="LEFT" value="0.8"/><AU number="4" side="RIGHT" value="0.5"/>
  <AU number="17" side="NONE" value="0.4"/>
</FACSConfiguration>"""


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    (tmp_path / "facebinding.xml").write_text(BINDING)
    (tmp_path / "skeptical.xml").write_text(SKEPTICAL)
    (tmp_path / "still.toml").write_text(STILL)
    return tmp_path


def scene(assets: Path, human: Path = DEFAULT_HUMAN) -> SceneOptions:
    return SceneOptions(human, "text", (assets,))


async def played(options: SceneOptions, lexeme: str, amount: float = 0.5) -> RealizerPilot:
    async with open_pilot(options) as pilot:
        pilot.watch()
        pilot.block("b", f'<faceLexeme id="f" lexeme="{lexeme}" amount="{amount}"/>')
        await pilot.advance(2.1)
        return pilot


async def test_a_lexeme_plays_a_place_on_the_wheel_a_morph_target_or_action_units_from_a_file(assets: Path) -> None:
    delighted = await played(scene(assets), "DELIGHTED", 0.5)
    assert delighted.feedback.warnings == []
    assert weight(delighted, "mouthSmileLeft").max() == pytest.approx(0.5 * OURS["JOY"]["mouthSmileLeft"])
    assert weight(await played(scene(assets), "pout"), "mouthPucker").max() == 1.0
    skeptical = await played(scene(assets, assets / "still.toml"), "skeptical", 0.5)
    shown = {
        morph: weight(skeptical, morph).max() for morph in ("browOuterUpLeft", "browOuterUpRight", "browDownRight")
    }
    assert shown == pytest.approx({"browOuterUpLeft": 0.4, "browOuterUpRight": 0.0, "browDownRight": 0.25})


async def test_what_no_entry_can_play_is_played_by_the_package(assets: Path, caplog: pytest.LogCaptureFixture) -> None:
    pilot = await played(scene(assets), "SMILE", 1.0)
    assert weight(pilot, "mouthSmileLeft").max() == pytest.approx(OURS["SMILE"]["mouthSmileLeft"])
    assert "facebinding.xml, line 21: this entry is skipped: the avatar has no morph target 'head-mesh-smile'" in (
        caplog.text
    )
    brows = await played(scene(assets), "RAISE_BROWS", 1.0)
    assert weight(brows, "browOuterUpLeft").max() == pytest.approx(OURS["RAISE_BROWS"]["browOuterUpLeft"])


async def test_a_binding_is_that_of_one_character(assets: Path, tmp_path: Path) -> None:
    (assets / "facebinding.xml").rename(assets / "moods.xml")
    human = tmp_path / "two.toml"
    human.write_text('[character.alice]\nbindings = { face = "moods.xml" }\n[character.bert]\n')
    async with open_pilot(scene(assets, human)) as pilot:
        for character in ("alice", "bert"):
            pilot.block("b", '<faceLexeme id="f" lexeme="delighted"/>', characterId=character)
        await pilot.advance(2.1)
        assert pilot.feedback.warnings == [("b:f", "CANNOT_CREATE_BEHAVIOR")]
        assert "there is no face lexeme 'delighted'" in pilot.feedback.of("warningFeedback")[0].text


async def test_the_lexicon_and_the_warning_of_an_unknown_lexeme_list_the_lexemes_of_a_binding(assets: Path) -> None:
    pilot = await played(scene(assets), "skepticall")
    assert "did you mean 'skeptical'?" in pilot.feedback.of("warningFeedback")[0].text
    async with open_scene(scene(assets)) as opened:
        found = {
            entry.lexeme: entry.problem
            for entry in lexicon_of(opened.realizer.characters["alice"].engines)
            if entry.element == "faceLexeme"
        }
    assert found["delighted"] is found["skeptical"] is found["RAISE_BROWS"] is None
    assert "no morph target 'head-mesh-smile'" in (found["SMILE"] or "")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: text.replace("facebinding", "gesturebinding"), "line 1, <gesturebinding>"),
        (
            lambda text: text.replace("FaceUnitSpec", "MotionUnitSpec"),
            "line 2, <MotionUnitSpec>: known is FaceUnitSpec",
        ),
        (lambda text: text.replace("parametermap", "map", 2), "line 4, <map>: known are constraints"),
        (lambda text: text.replace(' type="Plutchik"', ""), "line 8, <FaceUnit>: the attribute type is missing"),
        (lambda text: text.replace('<FaceUnit type="Plutchik"/>', ""), "line 2, <FaceUnitSpec>: no FaceUnit inside"),
        (lambda text: text[:-5], "<facebinding>"),
    ],
)
async def test_a_binding_with_another_format_is_refused_with_line_and_element(
    assets: Path, change: Callable[[str], str], message: str
) -> None:
    (assets / "facebinding.xml").write_text(change(BINDING))
    with pytest.raises(RealizerError) as refused:
        async with open_scene(scene(assets)):
            pass
    assert message in refused.value.fault.sentence


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('"Plutchik"', '"Plutchick"', "line 2: this entry is skipped: there is no face unit 'Plutchick'"),
        (
            'name="angle" value="315"',
            'name="angle" value="north"',
            "line 2: this entry is skipped: the parameter angle",
        ),
        ('name="angle"', 'name="degrees"', "line 2: the face unit Plutchik has no parameter degrees; it has angle"),
    ],
)
async def test_what_an_entry_gets_wrong_is_logged_with_its_line(
    assets: Path, caplog: pytest.LogCaptureFixture, before: str, after: str, message: str
) -> None:
    (assets / "facebinding.xml").write_text(BINDING.replace(before, after, 1))
    pilot = await played(scene(assets), "delighted")
    assert pilot.feedback.warnings == [("b:f", "CANNOT_CREATE_BEHAVIOR")]
    assert message in caplog.text


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("<Configuration/>", "the file should begin with <FACSConfiguration>"),
        ("<FACSConfiguration><UA/></FACSConfiguration>", "line 1, <UA>: known is AU"),
        ('<FACSConfiguration><AU number="51" value="1"/></FACSConfiguration>', "there is no action unit '51'"),
        ('<FACSConfiguration><AU number="2" side="UP" value="1"/></FACSConfiguration>', "side='UP': known are NONE"),
    ],
)
async def test_a_bad_file_of_action_units_drops_the_behavior_with_a_reason(
    assets: Path, content: str, message: str
) -> None:
    (assets / "skeptical.xml").write_text(content)
    pilot = await played(scene(assets), "skeptical")
    assert message in pilot.feedback.of("warningFeedback")[0].text


@pytest.mark.parametrize("lexeme", ["joy", "anger", "sadness", "interest", "surprise", "think", "smile"])
async def test_the_binding_of_asap_realizer_plays(shared_cases: Path, lexeme: str) -> None:
    pilot = await played(scene(shared_cases / "asap" / "facebinding"), lexeme)
    assert pilot.feedback.warnings == []
    assert max(frame.weights.max() for frame in pilot.frames["alice"]) > 0.05
