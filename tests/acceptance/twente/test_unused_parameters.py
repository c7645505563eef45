"""Unused parameters of behaviors and bindings are reported, and the rest plays."""

import logging
from collections.abc import AsyncIterator
from pathlib import Path
from shutil import copy

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.lexicon import LexiconProvider
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .motions import FILES, told

VAIN = '<bmlt:parameter name="{}" value="0.5"/>'

BINDING = """
<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="SWING"/><constraint name="style" value="wide"/></constraints>
    <parametermap><parameter src="width" dst="a"/><parameter src="height" dst="up"/></parametermap>
    <parameterdefaults><parameterdefault name="depth" value="1"/></parameterdefaults>
    <MotionUnit type="ProcAnimation" file="moves/swing.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="TWO"/></constraints>
    <MotionUnit type="Sequence" file="two.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="ANY"/></constraints>
    <parametermap><parameter src="motion" dst="name"/><parameter src="height" dst="up"/></parametermap>
    <MotionUnit type="ProcAnimation"/>
  </MotionUnitSpec>
</gesturebinding>
"""
TWO = """
<Sequence>
  <Motion type="ProcAnimation" file="moves/swing.xml" start="0"/>
  <Motion type="ProcAnimation" file="moves/swing.xml" start="1"><parameter name="a" value="0.1"/></Motion>
</Sequence>
"""


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    for name, text in {**FILES, "gesturebinding.xml": BINDING, "two.xml": TWO}.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), verify=True)) as pilot:
        yield pilot


@pytest.mark.parametrize(
    ("xml", "known"),
    [
        (
            '<gesture id="x" lexeme="BEAT">{}</gesture>',
            "amount, file, fluidity, joints, mirror, name, postStrokeHoldDuration",
        ),
        ('<gesture id="x" lexeme="TWO">{}</gesture>', "a, file, joints, mirror, name, replacementgroup"),
        ('<head id="x" lexeme="NOD">{}</head>', "amount, file, joints, mirror, name, repetition, replacementgroup"),
        ('<gaze id="x" target="bluebox">{}</gaze>', "back, chest, eyes, head, neck, replacementgroup"),
        ('<gazeShift id="x" target="bluebox">{}</gazeShift>', "back, chest, eyes, head, neck, replacementgroup"),
        ('<headDirectionShift id="x" target="bluebox">{}</headDirectionShift>', "back, chest, head, neck"),
        ('<pointing id="x" target="bluebox">{}</pointing>', "asymmetry, fluidity, hand, postStrokeHoldDuration, power"),
        ('<posture id="x"><stance type="SITTING"/>{}</posture>', "replacementgroup"),
        ('<bmlt:procanimation id="x" name="swing">{}</bmlt:procanimation>', "a, file"),
        ('<bmlt:procanimationgesture id="x" name="swing">{}</bmlt:procanimationgesture>', "a, amount, file"),
        (
            '<bmlt:keyframe id="x" name="wave">{}</bmlt:keyframe>',
            "additive, below, fadeIn, fadeOut, file, filter, group, joints, loop, mirror, name",
        ),
        ('<bmlt:noise id="x" type="perlin" joint="vl5">{}</bmlt:noise>', "baseamplitudex, baseamplitudey"),
        ('<bmlt:transition id="x" class="SlerpTransition">{}</bmlt:transition>', "class, joints, replacementgroup"),
    ],
)
async def test_an_unknown_parameter_is_reported_once_and_the_behavior_plays(
    pilot: RealizerPilot, xml: str, known: str
) -> None:
    pilot.block("b", f'\n<head id="nod" lexeme="NOD"/>\n{xml.format(VAIN.format("amuont"))}')
    await pilot.advance(9)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]
    assert f"line 3, column 1: unknown parameter amuont of <{xml.partition(' ')[0][1:].rpartition(':')[2]}>" in told(
        pilot
    )
    assert known in told(pilot)
    assert pilot.feedback.reached("b:x:end")
    assert pilot.feedback.reached("b:nod:end")
    assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize(
    "xml",
    [
        '<gesture id="x" lexeme="BEAT"><bmlt:parameter name="amount" value="0.5"/></gesture>',
        '<gesture id="x" lexeme="BEAT"><bmlt:parameter name="mode" value="LEFT_HAND"/></gesture>',
        '<gesture id="x" lexeme="TWO"><bmlt:parameter name="a" value="0.5"/></gesture>',
        '<gesture id="x" lexeme="SWING"><bmlt:parameter name="style" value="wide"/>'
        '<bmlt:parameter name="width" value="1"/><bmlt:parameter name="a" value="1"/></gesture>',
        '<head id="x" lexeme="NOD"><bmlt:parameter name="repetition" value="2"/></head>',
        '<gaze id="x" target="bluebox"><bmlt:parameter name="neck" value="0.5"/></gaze>',
        '<pointing id="x" target="bluebox"><bmlt:parameter name="hand" value="LEFT_HAND"/>'
        '<bmlt:parameter name="steepness" value="2"/></pointing>',
        '<bmlt:procanimation id="x"><bmlt:parameter name="file" value="moves/swing.xml"/></bmlt:procanimation>',
        '<bmlt:keyframe id="x"><bmlt:parameter name="name" value="wave"/><bmlt:parameter name="filter" value="5"/>'
        '<bmlt:parameter name="mirror" value="true"/><bmlt:parameter name="joints" value="l_shoulder"/>'
        '<bmlt:parameter name="replacementgroup" value="arms"/></bmlt:keyframe>',
        '<bmlt:transition id="x" class="SlerpTransition"><bmlt:parameter name="joints" value="vl5"/></bmlt:transition>',
    ],
)
async def test_used_parameters_give_no_warning(pilot: RealizerPilot, xml: str) -> None:
    pilot.block("b", xml)
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.reached("b:x:end")


async def test_an_unused_parameter_is_reported_when_the_behavior_is_planned(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<head id="x" lexeme="NOD" start="5">{VAIN.format("repeat")}</head>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]


async def test_all_unused_parameters_of_a_behavior_are_in_one_warning(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<head id="x" lexeme="NOD">{VAIN.format("repeat")}{VAIN.format("aim")}</head>')
    await pilot.advance(3)
    assert len(pilot.feedback.warnings) == 1
    assert "unknown parameter aim, repeat of <head>" in told(pilot)


async def test_attributes_of_a_gaze_are_not_parameters(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gaze id="x" target="bluebox"><bmlt:parameter name="influence" value="WAIST"/></gaze>')
    await pilot.advance(3)
    assert "unknown parameter influence of <gaze>" in told(pilot)


async def test_a_parameter_mapped_to_an_unknown_one_is_reported(pilot: RealizerPilot) -> None:
    style = '<bmlt:parameter name="style" value="wide"/>'
    pilot.block("b", f'<gesture id="x" lexeme="SWING">{style}{VAIN.format("height")}</gesture>')
    await pilot.advance(3)
    assert "unknown parameter height of <gesture>; it has file, joints, mirror, name," in told(pilot)


async def test_an_unused_parameter_of_an_entry_is_logged_once(
    pilot: RealizerPilot, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    for number in range(2):
        style = '<bmlt:parameter name="style" value="wide"/>'
        pilot.block(f"b{number}", f'<gesture id="x" lexeme="SWING">{style}</gesture>')
        await pilot.advance(3)
    assert pilot.feedback.warnings == []
    said = "gesturebinding.xml, line 3: the motion of this entry has no parameter depth, up; it has a, file, joints"
    assert caplog.text.count(said) == 1


async def test_an_entry_for_any_animation_may_name_parameters_that_only_some_of_them_have(
    pilot: RealizerPilot, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    pilot.block("b", '<gesture id="x" lexeme="ANY"><bmlt:parameter name="motion" value="swing"/></gesture>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert "parameter" not in caplog.text


async def test_an_unused_parameter_of_a_part_of_a_sequence_is_logged_once(
    pilot: RealizerPilot, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "two.xml").write_text(TWO.replace('name="a"', 'name="far"'))
    caplog.set_level(logging.WARNING)
    for number in range(2):
        pilot.block(f"b{number}", '<gesture id="x" lexeme="TWO"/>')
        await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert caplog.text.count("two.xml, line 4, <Motion>: no parameter far of this motion; it has a, file") == 1


async def said_of_entries(caplog: pytest.LogCaptureFixture, *assets: Path) -> list[str]:
    """What is logged of the parameters of a binding when all its entries are tried, before those of the package."""
    async with open_pilot(SceneOptions(voice="text", assets=assets)) as pilot:
        (engine,) = (each for each in pilot.realizer.characters["alice"].engines if each.name.endswith("/animation"))
        assert isinstance(engine, LexiconProvider)
        assert {word.element for word in engine.lexicon()} >= {"gesture", "head", "gaze", "pointing"}
    return [line for line in caplog.messages if line.startswith("gesturebinding.xml, line ") and "parameter" in line]


async def test_the_default_binding_logs_no_unused_parameters(caplog: pytest.LogCaptureFixture) -> None:
    assert await said_of_entries(caplog) == []


async def test_a_published_binding_logs_no_unused_parameters(
    tmp_path: Path, tests_data: Path, caplog: pytest.LogCaptureFixture
) -> None:
    copy(tests_data / "bindings" / "published.xml", tmp_path / "gesturebinding.xml")
    assert await said_of_entries(caplog, tmp_path) == []


async def test_an_entry_of_a_published_binding_may_name_a_parameter_that_a_file_of_the_user_lacks(
    tmp_path: Path, tests_data: Path, caplog: pytest.LogCaptureFixture
) -> None:
    copy(tests_data / "bindings" / "published.xml", tmp_path / "gesturebinding.xml")
    file = tmp_path / "procanimation" / "enterface" / "headpolar.xml"
    file.parent.mkdir(parents=True)
    file.write_text('<ProcAnimation prefDuration="1"><Rotation target="vc4" rotation="dy*r*t;0;0"/></ProcAnimation>')
    # Entries of the package use this file too, with one more parameter.
    (line,) = (line for line in await said_of_entries(caplog, tmp_path) if "dx" not in line)
    assert "no parameter a; it has dy, file, joints, mirror, name, r" in line


async def test_asaprealizers_binding_logs_one_unused_parameter(
    tmp_path: Path, shared_cases: Path, caplog: pytest.LogCaptureFixture
) -> None:
    copy(shared_cases / "asap" / "gesturebinding" / "gesturebinding.xml", tmp_path)
    (line,) = await said_of_entries(caplog, tmp_path, shared_cases / "asap")
    assert "no parameter a; it has file, joints, mirror, name, xoff, yoff, zoff" in line


async def test_a_change_of_an_unknown_parameter_is_reported_and_the_motion_continues(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <bmlt:procanimation id="p" name="swing" start="0"/>
        <bmla:parametervaluechange id="c" target="p" paramId="b" start="0.5" end="1">
          <bmla:trajectory type="linear" targetValue="0.4"/></bmla:parametervaluechange>
        """,
    )
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:c", "NO_SUCH_TARGET")]
    assert "'p' has no parameter 'b'; it has a" in told(pilot)
    assert pilot.feedback.reached("b:p:end")
