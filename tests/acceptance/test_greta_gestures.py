"""Gestures of Greta's gestuaries: hands are at the named places at their points, and what plays of wrong files."""

from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.vocabulary import BodyAxis
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, rotate
from reactive_realizer.embodiment.vector import Vec3, distance, subtract
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.engines.animation.key_poses.arm_pose import hand_axes
from reactive_realizer.engines.animation.key_poses.gesture_space import arm_length
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

FRAMES = 50
"""Frames per second."""
BINDING = """<gesturebinding><MotionUnitSpec type="gesture">
  <parametermap><parameter src="lexeme" dst="name"/></parametermap>
  <MotionUnit type="GretaGesture" file="gestuary.xml"/>
</MotionUnitSpec></gesturebinding>"""
HUMAN = '[character.alice]\navatar = "avatars/female.glb"\nidle = 0\nbindings = { gesture = "lexicon.xml" }\n'
GESTUARY = "gestuary.xml"
POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")

Open = Callable[..., AbstractAsyncContextManager[RealizerPilot]]


def hand(side: str, x: float, y: float, z: float, inside: str = "", attributes: str = "") -> str:
    parts = zip(("horizontal", "vertical", "frontal"), (x, y, z), strict=True)
    numbers = "".join(f'<{name}Location value="{value}"/>' for name, value in parts)
    return f'<hand side="{side}" {attributes}><uniformPosition>{numbers}</uniformPosition>{inside}</hand>'


def gesture(name: str, *phases: str) -> str:
    return f'<gesture category="show" id="{name}">{"".join(f"<phase>{each}</phase>" for each in phases)}</gesture>'


SWEEP = gesture("Sweep", hand("RIGHT", 0.0, 0.2, 0.6), hand("RIGHT", 0.7, 0.2, 0.6))
BOTH = gesture("Both", hand("RIGHT", 0.2, 0.3, 0.6) + hand("LEFT", 0.4, 0.0, 0.5))


@pytest.fixture
def gestuary(tmp_path: Path) -> Open:
    """Opens a scene with gestures, and other files by their names."""

    @asynccontextmanager
    async def open_(*gestures: str, **files: str) -> AsyncIterator[RealizerPilot]:
        (tmp_path / "lexicon.xml").write_text(BINDING, encoding="utf-8")
        (tmp_path / "human.toml").write_text(HUMAN, encoding="utf-8")
        inside = "\n".join(gestures)
        (tmp_path / "gestuary.xml").write_text(f"<gestuary>\n{inside}\n</gestuary>", encoding="utf-8")
        for name, text in files.items():
            (tmp_path / f"{name}.xml").write_text(text, encoding="utf-8")
        async with open_pilot(SceneOptions(tmp_path / "human.toml", "text", (tmp_path,))) as pilot:
            pilot.watch()
            yield pilot

    return open_


def at(pilot: RealizerPilot, point: str, behavior: str = "b:g") -> Body:
    return pilot.bodies()[round(FRAMES * pilot.feedback.time(f"{behavior}:{point}"))]


def shares(body: Body, side: str) -> Vec3:
    """Return where a hand is as a gestuary states it: outward, up from the elbow, ahead; in lengths of the arm."""
    rest, arm = Body(body.skeleton), arm_length(body.skeleton)
    pelvis, shoulder, elbow = (
        subtract(rest.transform(joint).position, rest.transform("HumanoidRoot").position)
        for joint in ("HumanoidRoot", f"{side}_shoulder", f"{side}_elbow")
    )
    x, y, z = subtract(body.transform(f"{side}_wrist").position, body.transform("HumanoidRoot").position)
    outward = x if side == "l" else -x
    return ((outward - pelvis[0]) / arm, (y - elbow[1]) / arm, (z - shoulder[2]) / arm)


def palm(body: Body, side: str) -> Vec3:
    return rotate(body.transform(f"{side}_wrist").rotation, hand_axes(side, body.skeleton)[BodyAxis.PALM])


async def test_hands_are_at_their_places_at_the_points_of_a_gesture(gestuary: Open) -> None:
    async with gestuary(SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Sweep" start="0.2"/>')
        await pilot.advance(4)
    told = pilot.feedback
    assert told.warnings == []
    assert [each for each in told.progress if each.startswith("b:g:")] == [f"b:g:{point}" for point in POINTS]
    assert shares(at(pilot, "ready"), "r") == pytest.approx((0.0, 0.2, 0.6), abs=0.03)
    assert shares(at(pilot, "strokeEnd"), "r") == pytest.approx((0.7, 0.2, 0.6), abs=0.03)
    middle = pilot.bodies()[round(FRAMES * 0.5 * (told.time("b:g:ready") + told.time("b:g:strokeEnd")))]
    assert shares(middle, "r")[1:] == pytest.approx((0.2, 0.6), abs=0.03)  # straight
    assert (
        distance(at(pilot, "start").transform("r_wrist").position, at(pilot, "end").transform("r_wrist").position)
        < 0.03
    )


async def test_symbols_name_places_from_wide_and_high_to_across_and_low(gestuary: Open) -> None:
    def place(*symbols: str) -> str:
        parts = zip(("horizontal", "vertical", "frontal"), symbols, strict=True)
        inside = "".join(f'<{name}Location value="{symbol}"/>' for name, symbol in parts)
        return f'<hand side="LEFT"><symbolicPosition>{inside}</symbolicPosition></hand>'

    far = gesture("Far", place("XP", "YUpperC", "ZMiddle"), place("XOppC", "YLowerC", "ZMiddle"))
    async with gestuary(far) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="show=Far"/>')
        await pilot.advance(5)
    assert shares(at(pilot, "ready"), "l") == pytest.approx((0.5, 0.6, 0.65), abs=0.05)
    assert shares(at(pilot, "strokeEnd"), "l") == pytest.approx((-0.25, 0.0, 0.65), abs=0.05)


async def test_the_stroke_follows_the_points_to_which_it_is_tied(gestuary: Open) -> None:
    async with gestuary(SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="sweep" strokeStart="2" strokeEnd="4"/>')
        await pilot.advance(6)
    assert pilot.feedback.time("b:g:strokeEnd") == 4.0
    assert shares(pilot.bodies()[3 * FRAMES], "r")[0] == pytest.approx(0.35, abs=0.05)


@pytest.mark.parametrize(("mode", "moved"), [("LEFT_HAND", "l"), ("RIGHT_HAND", "r"), ("BOTH_HANDS", "lr")])
async def test_a_mode_gives_a_gesture_of_one_hand_to_the_hands_that_it_names(
    gestuary: Open, mode: str, moved: str
) -> None:
    async with gestuary(SWEEP) as pilot:
        pilot.block("b", f'<gesture id="g" lexeme="Sweep" mode="{mode}"/>')
        await pilot.advance(4)
    ready = at(pilot, "ready")
    for side in "lr":
        there = shares(ready, side) == pytest.approx((0.0, 0.2, 0.6), abs=0.04)
        assert there == (side in moved)


async def test_a_mode_selects_one_hand_of_a_gesture_of_both(gestuary: Open) -> None:
    async with gestuary(BOTH) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Both" mode="LEFT_HAND"/>')
        await pilot.advance(4)
        pilot.block("c", '<gesture id="g" lexeme="Both"/>')
        await pilot.advance(4)
    first, second = at(pilot, "ready"), at(pilot, "ready", "c:g")
    assert shares(first, "l") == pytest.approx((0.4, 0.0, 0.5), abs=0.03)
    assert shares(first, "r")[2] < 0.2
    assert shares(second, "r") == pytest.approx((0.2, 0.3, 0.6), abs=0.03)


async def test_an_orientation_turns_the_hand_from_the_forearm_or_in_the_axes_of_the_figure(gestuary: Open) -> None:
    up = '<wristOrientation w="0.7071" x="0" y="-0.7071" z="0"/>'
    ahead = '<wristOrientation global="true" w="0.5" x="-0.5" y="-0.5" z="0.5"/>'
    async with gestuary(
        gesture("Up", hand("RIGHT", 0.35, 0.0, 0.7, up)), gesture("Ahead", hand("RIGHT", 0.3, 0.5, 0.5, ahead))
    ) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Up"/>')
        await pilot.advance(3)
        pilot.block("c", '<gesture id="g" lexeme="Ahead"/>')
        await pilot.advance(3)
    assert palm(at(pilot, "ready"), "r")[1] > 0.8
    turned = rotate((0.5, -0.5, -0.5, 0.5), hand_axes("r", pilot.bodies()[0].skeleton)[BodyAxis.PALM])
    # The elbow keeps clear of the trunk, and the hand goes with its forearm.
    assert palm(at(pilot, "ready", "c:g"), "r") == pytest.approx(turned, abs=0.2)


async def test_an_openness_lifts_the_elbow(gestuary: Open) -> None:
    closed, open_ = (
        gesture(name, hand("RIGHT", 0.2, 0.4, 0.4, "", f'openness="{openness}"'))
        for name, openness in (("Closed", 0), ("Open", 1))
    )
    async with gestuary(closed, open_) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Closed"/>')
        await pilot.advance(3)
        pilot.block("c", '<gesture id="g" lexeme="Open"/>')
        await pilot.advance(3)
    low, high = (at(pilot, "ready", behavior).transform("r_elbow").position for behavior in ("b:g", "c:g"))
    assert low[0] - high[0] > 0.02
    assert high[1] - low[1] > 0.015


async def test_fingers_have_the_shape_of_the_file_of_shapes_or_else_the_most_similar_one(gestuary: Open) -> None:
    point = gesture("Point", hand("LEFT", 0.3, 0.2, 0.6, '<handShape value="form_point1"/>'))
    shapes = '<HandShapes><HandShape id="FORM_POINT1"><r_pinky1 x="0" y="0" z="40"/></HandShape></HandShapes>'
    async with gestuary(point) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Point"/>')
        await pilot.advance(3)
    similar = at(pilot, "ready")
    async with gestuary(point, HandShape=shapes) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Point"/>')
        await pilot.advance(3)
    own = at(pilot, "ready")
    assert angle(similar.rotation("l_index2")) < 0.3 < angle(similar.rotation("l_middle2"))
    assert own.rotation("l_pinky1") == pytest.approx(
        (np.cos(np.radians(20)), 0.0, 0.0, -np.sin(np.radians(20))), abs=0.01
    )


async def test_a_circle_goes_around_the_place_and_takes_its_time(gestuary: Open) -> None:
    axes = "".join(
        f'<parameters axis="{axis}" amplitude="0.15" frequency="2" shift="{shift}"/>'
        for axis, shift in (("x", 0), ("y", 0.25))
    )
    circle = f'<trajectory type="circle">{axes}</trajectory>'
    async with gestuary(gesture("Stir", hand("RIGHT", 0.3, 0.2, 0.6, circle), hand("RIGHT", 0.3, 0.2, 0.6))) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Stir"/>')
        await pilot.advance(5)
    told = pilot.feedback
    begin, end = (round(FRAMES * told.time(f"b:g:{point}")) for point in ("ready", "strokeEnd"))
    path = np.array([shares(body, "r") for body in pilot.bodies()[begin : end + 1]])
    assert np.ptp(path, axis=0) == pytest.approx((0.3, 0.3, 0.0), abs=0.05)
    assert end - begin > 0.5 * FRAMES


async def test_a_hand_touches_the_body_with_its_knuckles(gestuary: Open) -> None:
    touch = gesture("Me", '<hand side="RIGHT"><touchPosition value="chest"/></hand>')
    async with gestuary(touch) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Me"/>')
        await pilot.advance(3)
    ready = at(pilot, "ready")
    knuckles, chest = (ready.transform(joint).position for joint in ("r_middle1", "vt6"))
    assert abs(knuckles[0] - chest[0]) < 0.05
    assert 0.08 < knuckles[2] - chest[2] < 0.2


async def test_what_cannot_be_played_is_told_once_with_its_line_and_the_rest_plays(gestuary: Open) -> None:
    wrong = '<handShape value="Tentacle"/><wristOrientation w="0" x="0" y="0" z="0"/>'
    nowhere = '<hand side="RIGHT"><touchPosition value="tail"/></hand>'
    async with gestuary(
        gesture("Odd", *[hand("RIGHT", 0.2, 0.2, 0.6, wrong)] * 2), gesture("Tail", nowhere), gesture("Empty"), SWEEP
    ) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="Odd"/>')
        pilot.block(
            "c", '<gesture id="t" lexeme="Tail"/><gesture id="e" lexeme="Empty"/><gesture id="n" lexeme="None"/>'
        )
        pilot.block("d", '<gesture id="g" lexeme="Sweep" start="b:g:end"/>')
        await pilot.advance(6)
    told = pilot.feedback
    texts = [message.text for message in told.of("warningFeedback") if message.id == "b:g"]
    assert len([text for text in texts if "there is no shape 'Tentacle'" in text]) == 1
    assert all("gestuary.xml, line 2" in text for text in texts)
    dropped = {message.id: message.text for message in told.of("warningFeedback")}
    assert "there is no place 'tail' on the body; known are skulltop" in dropped["c:t"]
    assert "Empty has no phases in gestuary.xml" in dropped["c:e"]
    assert "gestuary.xml has no gesture 'None'" in dropped["c:n"]
    assert told.time("b:g:end") > 1.0
    assert told.time("d:g:end") > told.time("b:g:end") + 1.0


async def test_entries_of_the_package_play_what_the_gestuary_lacks(gestuary: Open) -> None:
    async with gestuary(SWEEP) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="BEAT"/>')
        await pilot.advance(3)
    assert pilot.feedback.warnings == []


async def test_the_lexicon_lists_the_gestures_of_the_file(gestuary: Open) -> None:
    async with gestuary(SWEEP, BOTH) as pilot:
        entries = lexicon_of(pilot.realizer.characters["alice"].engines)
    listed = [(each.element, each.lexeme, each.sync_points, each.problem) for each in entries if each.file == GESTUARY]
    assert listed == [("gesture", name, POINTS, None) for name in ("Sweep", "Both")]


async def test_the_lexicon_tells_what_is_wrong_with_the_file(gestuary: Open, tmp_path: Path) -> None:
    async with gestuary(SWEEP) as pilot:
        (tmp_path / GESTUARY).write_text("<gestures/>", encoding="utf-8")
        entries = lexicon_of(pilot.realizer.characters["alice"].engines)
    (problem,) = [each.problem for each in entries if each.file == GESTUARY]
    assert problem is not None
    assert "the file should begin with <gestuary>" in problem


async def test_drafts_name_gestures_in_the_description_of_greta(gestuary: Open) -> None:
    reference = '<description level="1" type="gretabml"><reference>show=Sweep</reference></description>'
    async with gestuary(SWEEP) as pilot:
        pilot.perform(f'<bml id="b"><gesture id="g" start="0">{reference}</gesture></bml>')
        await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert shares(at(pilot, "strokeEnd"), "r") == pytest.approx((0.7, 0.2, 0.6), abs=0.03)
