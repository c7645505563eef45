"""Elements of any namespace that entries of bindings play (thesis 8.16.1)."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .living_time import nod, texts

MOVES = 'xmlns:m="urn:example:moves"'

GESTURES = """
<gesturebinding>
  <MotionUnitSpec type="greet" namespace="urn:example:moves">
    <constraints><constraint name="style" value="nod"/></constraints>
    <parametermap><parameter src="size" dst="a"/></parametermap>
    <MotionUnit type="ProcAnimation" file="procanimation/smartbody/nod.xml"/>
  </MotionUnitSpec>
</gesturebinding>
"""
FACES = """
<facebinding>
  <FaceUnitSpec type="beam" namespace="urn:example:moves">
    <parametermap><parameter src="size" dst="intensity"/></parametermap>
    <parameterdefaults><parameterdefault name="targetname" value="mouthSmileLeft"/></parameterdefaults>
    <FaceUnit type="Morph"/>
  </FaceUnitSpec>
</facebinding>
"""
HUMAN = '[character.alice]\nidle = false\nbindings = { gesture = "moves.xml", face = "faces.xml" }'


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    for name, text in (("moves.xml", GESTURES), ("faces.xml", FACES), ("human.toml", HUMAN)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    async with open_pilot(SceneOptions(tmp_path / "human.toml", "text", (tmp_path,), verify=True)) as pilot:
        pilot.watch()
        yield pilot


async def test_a_motion_plays_an_element_of_another_namespace_with_the_points_of_the_motion(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", f'<m:greet {MOVES} id="g" style="nod" start="0.3"/>' + nod("n", start="g:stroke"))
    await pilot.advance(3)
    assert texts(pilot) == []
    assert_time(pilot.feedback, "b:g:start", 0.3)
    assert pilot.feedback.time("b:g:start") < pilot.feedback.time("b:g:stroke") < pilot.feedback.time("b:g:end")
    assert_linked(pilot.feedback, "b:n:start", "b:g:stroke")


@pytest.mark.parametrize(("size", "depth"), [("0.3", (0.3, 2.5)), ("1", (3.5, 40))])
async def test_its_attributes_are_parameters_of_the_motion(
    pilot: RealizerPilot, size: str, depth: tuple[float, float]
) -> None:
    pilot.block("b", f'<m:greet {MOVES} id="g" style="nod" size="{size}"/>')
    await pilot.advance(1.5)
    heights = pilot.path("skullbase")[:, 1]
    assert depth[0] < 1000 * float(heights.max() - heights.min()) < depth[1]


async def test_a_parameter_changes_while_the_motion_plays(pilot: RealizerPilot) -> None:
    change = (
        '<bmla:parametervaluechange id="p" target="b:g" paramId="size" start="0.1">'
        '<bmla:trajectory type="instant" targetValue="0"/></bmla:parametervaluechange>'
    )
    pilot.block("b", f'<m:greet {MOVES} id="g" style="nod" size="1"/>' + change)
    await pilot.advance(2)
    assert texts(pilot) == []
    heights = pilot.path("skullbase")[:, 1]
    assert 1000 * float(heights[0] - heights.min()) < 1.5


async def test_a_face_plays_an_element_of_another_namespace(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<m:beam {MOVES} id="f" size="0.8" start="0" end="2"/>')
    await pilot.advance(1)
    names = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    weights = dict(zip(names, pilot.frames["alice"][-1].weights, strict=True))
    assert weights["mouthSmileLeft"] > 0.7
    assert texts(pilot) == []


async def test_what_no_entry_plays_is_named(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<m:greet {MOVES} id="g" style="kiss"/><m:leave {MOVES} id="l"/>' + nod("n"))
    await pilot.advance(2)
    assert sorted(text.partition(": ")[2] for text in texts(pilot)) == [
        "<leave> of urn:example:moves is left out: no engine and no entry of a binding plays it",
        "no entry of the binding plays <greet> with style='kiss'",
    ]
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.reached("b:n:end")
