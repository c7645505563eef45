"""Goals out of reach are reported once, and the figure comes as near as possible."""

import math
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.embodiment.vector import FORWARD, distance, dot, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

REACH = """<ProcAnimation prefDuration="2">
  <EndEffector target="l_wrist" local="{}" translation="{}"/>
  <KeyPosition id="ready" time="0.25"/><KeyPosition id="relax" time="0.75"/><Parameter sid="far" value="0"/>
</ProcAnimation>"""

ABOVE = "0.2; 1.15 + far; 0.3"
"""A place that a hand reaches, and others above it."""

BINDING = """<gesturebinding><MotionUnitSpec type="gesture">
  <constraints><constraint name="lexeme" value="REACH"/></constraints>
  <MotionUnit type="Sequence" file="twice.xml"/>
</MotionUnitSpec></gesturebinding>"""

TWICE = """<Sequence><Motion type="ProcAnimation" file="reach.xml" start="0"/>
  <Motion type="ProcAnimation" file="reach.xml" start="2"/></Sequence>"""

FAR = '<bmlt:parameter name="far" value="2"/>'

EYES = ("l_eyeball_joint", "r_eyeball_joint")


@pytest.fixture
async def pilot(tmp_path: Path) -> AsyncIterator[RealizerPilot]:
    for name, text in {"gesturebinding.xml": BINDING, "twice.xml": TWICE}.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "reach.xml").write_text(REACH.format("false", ABOVE))
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), verify=True)) as pilot:
        pilot.watch()
        yield pilot


def told(pilot: RealizerPilot) -> list[str]:
    """The warnings about behaviors that continue."""
    warnings = pilot.feedback.of("warningFeedback")
    assert {warning.element.get("type") for warning in warnings} <= {"EXECUTION_FAILURE"}
    return [warning.text.partition(": ")[2] for warning in warnings]


@pytest.mark.parametrize(
    "xml",
    [
        '<bmlt:procanimation id="x" name="reach">{}</bmlt:procanimation>',
        '<bmlt:procanimationgesture id="x" name="reach">{}</bmlt:procanimationgesture>',
        '<gesture id="x" lexeme="REACH">{}</gesture>',
    ],
)
async def test_an_unreachable_goal_is_reported_once_and_the_motion_continues(pilot: RealizerPilot, xml: str) -> None:
    pilot.block("b", xml.format(FAR))
    pilot.block("c", xml.format(""), composition="APPEND")
    await pilot.advance(12)
    (said,) = told(pilot)
    assert said.startswith("l_wrist cannot reach its goal in reach.xml at phase 0.")
    assert pilot.feedback.warnings == [("b:x", "EXECUTION_FAILURE")]
    assert pilot.feedback.reached("b:x:end")
    assert pilot.feedback.reached("c:x:end")


async def test_a_hand_comes_as_near_as_possible_and_its_distance_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<bmlt:procanimation id="x" name="reach" start="0">{FAR}</bmlt:procanimation>')
    await pilot.advance(1.5)
    body = pilot.bodies()[60]
    wrist, shoulder, goal = body.transform("l_wrist").position, body.transform("l_shoulder").position, (0.2, 3.15, 0.3)
    way = unit(subtract(goal, shoulder))
    assert dot(unit(subtract(wrist, shoulder)), way) > 0.999
    (said,) = told(pilot)
    assert float(said.split()[-4]) == pytest.approx(distance(wrist, goal), abs=0.05)


async def test_a_goal_that_gets_out_of_reach_during_the_motion_is_reported(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <bmlt:procanimation id="x" name="reach" start="0" end="4"/>
        <bmla:parametervaluechange id="c" target="x" paramId="far" start="1" end="3">
          <bmla:trajectory type="linear" targetValue="2"/></bmla:parametervaluechange>
        """,
    )
    await pilot.advance(1)
    assert told(pilot) == []
    await pilot.advance(3)
    assert len(told(pilot)) == 1


@pytest.mark.parametrize(("stretch", "warnings"), [(0.0, 0), (0.15, 0), (0.6, 1)])
async def test_a_local_goal_may_be_that_of_a_longer_arm(
    pilot: RealizerPilot, tmp_path: Path, stretch: float, warnings: int
) -> None:
    """As in the published files: of the female figure shoulder and wrist are 0.45 m apart."""
    (tmp_path / "reach.xml").write_text(REACH.format("true", f"0; 0; {0.4 + stretch}"))
    pilot.block("b", '<bmlt:procanimation id="x" name="reach"/>')
    await pilot.advance(3)
    assert len(told(pilot)) == warnings


async def test_a_goal_too_near_for_a_folded_arm_is_reported(pilot: RealizerPilot, tmp_path: Path) -> None:
    place = pilot.realizer.characters["alice"].humanoid.body.transform("l_shoulder").position
    (tmp_path / "reach.xml").write_text(REACH.format("false", ";".join(f"{at:.3f}" for at in place)))
    pilot.block("b", '<bmlt:procanimation id="x" name="reach"/>')
    await pilot.advance(3)
    assert len(told(pilot)) == 1


def missed(body: Body, joint: str, target: tuple[float, float, float]) -> float:
    """How far aside of a target a joint looks or points, degrees."""
    place = body.transform(joint)
    way = unit(subtract(target, place.position))
    return math.degrees(math.acos(max(-1.0, min(1.0, dot(way, rotate(place.rotation, FORWARD))))))


async def sit(pilot: RealizerPilot) -> None:
    """A figure that sits does not turn on its feet."""
    pilot.block("a", '<postureShift id="p" start="0" end="1"><stance type="SITTING"/></postureShift>')
    await pilot.advance(2)


@pytest.mark.parametrize(
    ("xml", "yaw"),
    [
        ('<gaze id="x" target="camera" influence="EYES"/>', 60),
        ('<gaze id="x" target="camera" influence="HEAD"/>', 140),
        ('<gaze id="x" target="camera" influence="WAIST"/>', -175),
        ('<gazeShift id="x" target="camera" influence="EYES"/>', -60),
        ('<gazeShift id="x" target="camera" influence="SHOULDER"/>', 170),
    ],
)
async def test_a_gaze_that_falls_short_is_reported_once_with_its_angle(
    pilot: RealizerPilot, xml: str, yaw: int
) -> None:
    target = (5.0 * math.sin(math.radians(yaw)), 1.6, 5.0 * math.cos(math.radians(yaw)))
    pilot.move("camera", target)
    await sit(pilot)
    pilot.block("b", xml)
    await pilot.advance(4)
    (said,) = told(pilot)
    assert said.endswith("degrees short of its target, which is beyond the reach of the joints that take part")
    nearest = min(max(missed(body, eye, target) for eye in EYES) for body in pilot.bodies())
    assert int(said.split()[3]) == pytest.approx(nearest, abs=2.5)
    assert pilot.feedback.reached("b:x:end")


async def test_a_head_direction_that_falls_short_is_reported(pilot: RealizerPilot) -> None:
    pilot.move("camera", (5.0, 1.6, -5.0))
    await sit(pilot)
    pilot.block("b", '<headDirectionShift id="x" target="camera"/>')
    await pilot.advance(3)
    (said,) = told(pilot)
    assert int(said.split()[3]) == pytest.approx(missed(pilot.bodies()[-1], "skullbase", (5.0, 1.6, -5.0)), abs=4.0)


@pytest.mark.parametrize("xml", ['<gaze id="x" target="camera"/>', '<gazeShift id="x" target="camera"/>'])
@pytest.mark.parametrize("yaw", [0, 60, -110])
async def test_a_gaze_that_reaches_its_target_gives_no_warning(pilot: RealizerPilot, xml: str, yaw: int) -> None:
    pilot.move("camera", (5.0 * math.sin(math.radians(yaw)), 1.6, 5.0 * math.cos(math.radians(yaw))))
    pilot.block("b", xml)
    await pilot.advance(3)
    assert told(pilot) == []


async def test_a_gaze_after_one_with_a_turned_trunk_gives_no_warning(pilot: RealizerPilot) -> None:
    pilot.move("camera", (3.0, 1.6, -3.0))
    pilot.move("viewer", (-3.0, 1.6, -0.8))
    pilot.block(
        "b",
        """
        <gazeShift id="far" target="camera" influence="WAIST" start="0" end="1"/>
        <gazeShift id="x" target="viewer" influence="HEAD" start="2" end="2.6"/>
        """,
    )
    await pilot.advance(4)
    assert told(pilot) == []


async def test_partial_eye_weights_give_no_warning(pilot: RealizerPilot) -> None:
    pilot.move("camera", (3.0, 1.6, 3.0))
    half = '<bmlt:parameter name="eyes" value="0.5"/>'
    pilot.block("b", f'<gaze id="x" target="camera" influence="EYES">{half}</gaze>')
    await pilot.advance(3)
    assert told(pilot) == []


async def test_a_target_that_moves_out_of_view_is_reported_then(pilot: RealizerPilot) -> None:
    pilot.move("camera", (0.0, 1.6, 3.0))
    pilot.block("b", '<gaze id="x" target="camera" start="0" ready="0.5" relax="5" end="6" bmlt:dynamic="true"/>')
    await pilot.advance(2)
    assert told(pilot) == []
    pilot.move("camera", (0.5, 1.6, -3.0))
    await pilot.advance(3)
    assert len(told(pilot)) == 1
