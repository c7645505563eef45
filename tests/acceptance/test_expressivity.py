"""Expressivity of gestures and pointing: its laws (EMBR, section 5), read from feedback and frames."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import Vec3, dot, subtract, unit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .expressive_motion import Performance, accelerations, gesture, parameters, performed, pointing
from .parameter_changes import change

PREPARATION, SWING_HOLD, STROKE, RETURN, HOLD, RETRACTION = range(6)
CLAP = """<ProcAnimation prefDuration="0.6">
  <EndEffector target="l_wrist" local="true" translation="0.06 - 0.18*t; -0.17; 0.27"/>
  <EndEffector target="r_wrist" local="true" translation="-0.06 + 0.18*t; -0.17; 0.27"/>
  <KeyPosition id="ready" time="0"/><KeyPosition id="stroke" time="1"/><KeyPosition id="relax" time="1"/>
</ProcAnimation>"""
CIRCLE = """<ProcAnimation prefDuration="1.2">
  <EndEffector target="r_wrist" local="true" translation="-0.05; -0.1 - 0.08*cos(6.2832*t); 0.3 + 0.08*sin(6.2832*t)"/>
  <KeyPosition id="ready" time="0"/><KeyPosition id="stroke" time="0.5"/><KeyPosition id="relax" time="1"/>
  <Parameter sid="power" value="0.3"/>
</ProcAnimation>"""
BINDING = """<gesturebinding><MotionUnitSpec type="gesture">
  <constraints><constraint name="lexeme" value="OWN"/></constraints>
  <MotionUnit type="Gesture" file="own.xml"/>
</MotionUnitSpec></gesturebinding>"""


async def play(behavior: str, seconds: float = 4.0, options: SceneOptions | None = None) -> Performance:
    """How the behavior alone is performed, without a warning."""
    async with open_pilot(options or SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        performance = await performed(pilot, behavior, seconds)
        assert pilot.feedback.warnings == []
        return performance


# --- spatial extent


@pytest.mark.parametrize(
    ("lexeme", "mode"), [("BEAT", "RIGHT_HAND"), ("CONDUCT", "RIGHT_HAND"), ("WAVE", "RIGHT_HAND")]
)
async def test_spatial_extent_scales_a_stroke_about_the_center_of_its_box_and_keeps_its_shape(
    lexeme: str, mode: str
) -> None:
    usual = (await play(gesture(lexeme, mode))).between("ready", "relax")
    center = (usual.min(axis=0) + usual.max(axis=0)) / 2
    for value in (-1.0, 0.5):  # of larger ones, BEAT would need longer arms
        scaled = (await play(gesture(lexeme, mode, spatialExtent=value))).between("ready", "relax")
        box = np.ptp(scaled, axis=0) / np.ptp(usual, axis=0)
        assert box[np.ptp(usual, axis=0) > 0.03] == pytest.approx(1.0 + 0.5 * value, rel=0.05)
        assert (scaled.min(axis=0) + scaled.max(axis=0)) / 2 == pytest.approx(center, abs=0.006)


async def test_spatial_extent_brings_two_hands_apart() -> None:
    usual, wide = [await play(gesture("CONTAINER", "BOTH_HANDS", spatialExtent=value)) for value in (0, 1)]
    assert wide.at(wide.points["stroke"])[0] / usual.at(usual.points["stroke"])[0] == pytest.approx(1.5, abs=0.08)


@pytest.mark.parametrize("value", [-1.0, 1.0])
async def test_a_hand_on_the_heart_stays_there_whatever_its_expressivity(value: float) -> None:
    usual = await play(gesture("SELF"))
    for name in ("spatialExtent", "power", "fluidity"):
        changed = await play(gesture("SELF").replace("</", parameters({name: value}) + "</"))
        apart = changed.between("stroke", "relax") - usual.at(usual.points["relax"])
        assert np.linalg.norm(changed.at(changed.points["relax"]) - usual.at(usual.points["relax"])) < 0.005
        assert apart[:, 2].min() > -0.02, "not into the chest"


async def test_hands_that_clap_meet_whatever_their_extent(tmp_path: Path) -> None:
    (tmp_path / "own.xml").write_text(CLAP)
    (tmp_path / "gesturebinding.xml").write_text(BINDING)
    options = SceneOptions(voice="text", assets=(tmp_path,))
    usual, wide = [
        await play(f'<gesture id="g" lexeme="OWN">{parameters({"spatialExtent": value})}</gesture>', 3.0, options)
        for value in (0, 1)
    ]
    assert wide.at(wide.points["stroke"]) == pytest.approx(usual.at(usual.points["stroke"]), abs=0.01)
    assert np.linalg.norm(wide.stroke) > 1.3 * np.linalg.norm(usual.stroke)


async def test_an_animation_keeps_parameters_of_the_same_name_for_itself(tmp_path: Path) -> None:
    (tmp_path / "own.xml").write_text(CIRCLE)
    (tmp_path / "gesturebinding.xml").write_text(BINDING)
    options = SceneOptions(voice="text", assets=(tmp_path,))
    usual, other = [
        await play(f'<gesture id="g" lexeme="OWN">{parameters(values)}</gesture>', 3.0, options)
        for values in ({}, {"power": 7})
    ]
    assert (usual.hand == other.hand).all()


# --- temporal extent


@pytest.mark.parametrize("value", [0.3, 1.0])
@pytest.mark.parametrize("behavior", [gesture, pointing])
async def test_temporal_extent_lengthens_each_movement_by_the_logarithm_of_its_duration(
    behavior: Callable[..., str], value: float
) -> None:
    usual, slow = [await play(behavior(temporalExtent=each), 6.0) for each in (0, value)]
    moving = [PREPARATION, STROKE, RETURN, RETRACTION] if behavior is gesture else [PREPARATION, RETRACTION]
    expected = usual.durations + 1.5 * value * np.log(1.0 + usual.durations)
    assert slow.durations[moving] == pytest.approx(expected[moving], abs=0.002)
    assert slow.durations[HOLD] == pytest.approx(usual.durations[HOLD], abs=0.002)


async def test_a_quick_gesture_is_not_hurried() -> None:
    usual, quick = [await play(gesture("OFFER", temporalExtent=value)) for value in (0, -1)]
    moving = [PREPARATION, STROKE, RETURN, RETRACTION]
    assert quick.durations[moving] == pytest.approx(0.6 * usual.durations[moving], abs=0.002)
    assert accelerations(quick.hand).max() < 60.0


async def test_temporal_extent_does_not_move_what_is_tied(pilot: RealizerPilot) -> None:
    pilot.block("b", gesture(syncs='start="0.4" ready="1.1" stroke="1.5" end="3"', temporalExtent=1))
    await pilot.advance(4)
    times = [pilot.feedback.time(f"b:g:{point}") for point in ("start", "ready", "stroke", "end")]
    assert times == pytest.approx([0.4, 1.1, 1.5, 3.0])
    assert pilot.feedback.warnings == []


# --- power


@pytest.mark.parametrize("value", [0.5, 1.0])
async def test_a_powerful_stroke_swings_back_holds_and_is_quicker(value: float) -> None:
    usual, strong = [await play(gesture("CHOP", power=each)) for each in (0, value)]
    back = strong.at(strong.points["strokeStart"]) - usual.at(usual.points["strokeStart"])
    along = usual.stroke / np.linalg.norm(usual.stroke)
    assert -back @ along / np.linalg.norm(usual.stroke) == pytest.approx(0.1 * value, abs=0.02)
    assert strong.durations[SWING_HOLD] == pytest.approx(0.3 * value, abs=0.002)
    assert np.ptp(strong.between("ready", "strokeStart"), axis=0).max() < 0.02, "it holds"
    expected = usual.durations[[STROKE, RETURN]] / (1.0 + 0.2 * value)
    assert strong.durations[[STROKE, RETURN]] == pytest.approx(expected, abs=0.002)


async def test_the_more_power_a_stroke_has_the_further_it_goes_beyond_its_end() -> None:
    beyond = []
    for value in (0.0, 0.5, 1.0):
        played = await play(gesture("OFFER", power=value))
        way = played.between("stroke", "relax") - played.at(played.points["stroke"])
        beyond.append((way @ played.stroke).max() / (played.stroke @ played.stroke))
    assert beyond[0] < beyond[1] < beyond[2] < 0.15
    assert beyond[2] > beyond[0] + 0.05


@pytest.mark.parametrize("behavior", [gesture, pointing])
async def test_the_way_to_a_stroke_is_straight_with_power_and_curved_without(behavior: Callable[..., str]) -> None:
    curves = []
    for value in (-1, 0, 1):
        way = (await play(behavior(power=value))).between("start", "ready")
        chord = (way[-1] - way[0]) / np.linalg.norm(way[-1] - way[0])
        aside = way - way[0] - np.outer((way - way[0]) @ chord, chord)
        curves.append(np.linalg.norm(aside, axis=1).max())
    assert curves[2] < 0.3 * curves[1] < curves[1] < curves[0]


# --- fluidity


async def test_fluidity_shortens_pauses_and_without_it_the_hand_rests_at_each_point() -> None:
    usual, fluid, halting = [await play(gesture("OFFER", fluidity=value), 5.0) for value in (0, 1, -1)]
    assert fluid.durations[HOLD] == pytest.approx(usual.durations[HOLD] - 0.3, abs=0.002)
    assert halting.durations[HOLD] == pytest.approx(usual.durations[HOLD] + 0.3, abs=0.002)
    moving = [PREPARATION, STROKE, RETRACTION]
    assert fluid.durations[moving] == pytest.approx(usual.durations[moving], abs=0.002)
    assert halting.durations[SWING_HOLD] == pytest.approx(0.3, abs=0.002)
    assert halting.durations[RETURN] == pytest.approx(usual.durations[RETURN] + 0.3, abs=0.002)
    stroke = halting.points["stroke"]
    resting = (halting.frames > stroke + 0.03) & (halting.frames < stroke + 0.28)
    assert np.ptp(halting.hand[resting], axis=0).max() < 0.01


async def test_fluidity_takes_pauses_from_power() -> None:
    assert (await play(gesture(power=1, fluidity=1))).durations[SWING_HOLD] == pytest.approx(0.0, abs=1e-6)


# --- pointing


def off_target(body: Body, target: Vec3) -> float:
    """Angle between the right index finger and the way from it to a target, degrees."""
    base, tip = (body.transform(f"r_index{number}").position for number in (1, 3))
    return math.degrees(math.acos(min(1.0, dot(unit(subtract(tip, base)), unit(subtract(target, base))))))


@pytest.mark.parametrize("name", ["spatialExtent", "temporalExtent", "power", "fluidity"])
async def test_a_finger_meets_its_target_whatever_its_expressivity(still: RealizerPilot, name: str) -> None:
    target = still.realizer.world.position("floor")
    assert target is not None
    for number, value in enumerate((-1.0, 1.0)):
        still.block(f"b{number}", pointing("floor", syncs='start="0.2"', **{name: value}))
        begun = still.now
        await still.advance(5)
        ready, relax = (still.feedback.time(f"b{number}:g:{point}") for point in ("ready", "relax"))
        shown = [
            body
            for frame, body in zip(still.frames["alice"], still.bodies(), strict=True)
            if begun < frame.time and ready <= frame.time <= relax
        ]
        assert len(shown) > 20
        assert max(off_target(body, target) for body in shown) < 2.0
    assert still.feedback.warnings == []


async def test_spatial_extent_stretches_a_pointing_arm() -> None:
    reach = []
    for value in (-1, 0, 1):
        played = await play(pointing(spatialExtent=value))
        reach.append(np.linalg.norm(played.at(played.points["stroke"])))
    assert reach[0] + 0.05 < reach[1] < reach[2]


# --- while it plays


def fastest(pilot: RealizerPilot) -> float:
    """The greatest acceleration of the right wrist in all frames, m/s^2."""
    return float(accelerations(pilot.path("r_wrist")).max())


async def test_a_change_of_extent_makes_a_playing_gesture_larger_and_leaves_its_points(pilot: RealizerPilot) -> None:
    pilot.watch()
    widths = []
    for more in ("", change("p", 'start="1.4" end="2"', target="g", parameter="spatialExtent", targetValue=1)):
        played = await performed(pilot, gesture("WAVE", syncs='start="0.2" end="4"') + more, 5.0)
        late = (played.frames > played.points["start"] + 2.0) & (played.frames < played.points["relax"])
        widths.append(np.ptp(played.hand[late], axis=0)[0])
        points = [played.points[point] - played.points["start"] for point in ("stroke", "relax", "end")]
        assert points == pytest.approx([points[0], points[1], 3.8], abs=0.01)
    assert widths[1] == pytest.approx(1.5 * widths[0], rel=0.1)
    assert pilot.feedback.warnings == []


async def with_extent(behavior: str, value: float, *, at: float, kind: str = "instant") -> Performance:
    """How a behavior is performed whose temporal extent changes at a time, without a warning."""
    extent = change(
        "p", f'start="{at}"', target="g", parameter="temporalExtent", type=kind, targetValue=value, initialValue=0
    )
    return await play(behavior + extent, 7.0)


@pytest.mark.parametrize("value", [-1.0, 0.5, 1.0])
@pytest.mark.parametrize("kind", ["instant", "linear"])
async def test_a_change_of_temporal_extent_changes_the_durations_of_the_phases_ahead(value: float, kind: str) -> None:
    usual, planned = [await play(gesture(syncs='start="0.2"', temporalExtent=each), 7.0) for each in (0, value)]
    early = 0.5 if kind == "instant" else 0.1
    changed = await with_extent(gesture(syncs='start="0.2"'), value, at=early, kind=kind)
    later = slice(STROKE, None) if kind == "instant" else slice(RETURN, None)  # a linear change takes half a second
    assert changed.durations[later] == pytest.approx(planned.durations[later], abs=0.003)
    preparations = sorted((usual.durations[PREPARATION], planned.durations[PREPARATION]))
    assert preparations[0] < changed.durations[PREPARATION] < preparations[1]
    assert accelerations(changed.hand).max() < 60.0


async def test_the_rest_of_a_phase_takes_as_much_longer_as_the_whole_phase_would() -> None:
    usual, slow = [await play(pointing(syncs='start="0.2"', temporalExtent=each), 7.0) for each in (0, 1)]
    changed = await with_extent(pointing(syncs='start="0.2"'), 1, at=0.4)
    done, whole = 0.2 / usual.durations[PREPARATION], slow.durations[PREPARATION]
    assert changed.durations[PREPARATION] == pytest.approx(0.2 + (1.0 - done) * whole, abs=0.02)
    assert changed.durations[RETRACTION] == pytest.approx(slow.durations[RETRACTION], abs=0.003)


@pytest.mark.parametrize(
    ("syncs", "stays", "moves"),
    [
        ('start="0.2" stroke="2"', ("ready", "strokeStart", "stroke"), ("strokeEnd", "relax", "end")),
        ('start="0.2" end="4"', ("ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"), ()),
        ('start="0.2" relax="3"', ("ready", "strokeStart", "stroke", "strokeEnd", "relax"), ("end",)),
    ],
)
async def test_a_change_of_temporal_extent_leaves_points_that_are_tied_and_what_is_before_them(
    pilot: RealizerPilot, syncs: str, stays: tuple[str, ...], moves: tuple[str, ...]
) -> None:
    times = []
    for name in ("a", "b"):
        pilot.block(name, gesture(syncs=syncs))
        begun = pilot.now
        await pilot.advance(0.6)
        if name == "b":
            pilot.block("c", change("p", 'start="0"', target="b:g", parameter="temporalExtent", targetValue=1))
        await pilot.advance(7)
        times.append({sync: pilot.feedback.time(f"{name}:g:{sync}") - begun for sync in (*stays, *moves)})
    assert [times[1][sync] for sync in stays] == pytest.approx([times[0][sync] for sync in stays], abs=0.002)
    assert all(times[1][sync] > times[0][sync] + 0.1 for sync in moves)
    assert pilot.feedback.warnings == []


async def test_a_behavior_that_is_tied_to_a_gesture_keeps_its_point_when_the_extent_changes(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", gesture(syncs='start="0.2"') + '<head id="n" lexeme="NOD" start="g:relax"/>')
    await pilot.advance(0.5)
    planned = pilot.feedback.predicted("b:g:relax")
    pilot.block("c", change("p", 'start="0"', target="b:g", parameter="temporalExtent", targetValue=1))
    await pilot.advance(7)
    assert pilot.feedback.time("b:g:relax") == pytest.approx(planned)
    assert pilot.feedback.time("b:n:start") == pytest.approx(planned)


@pytest.mark.parametrize("syncs", ['start="2.2"', 'stroke="2.6"', 'start="g:end"'])
async def test_a_gesture_that_becomes_slower_relaxes_in_time_for_the_next_one(pilot: RealizerPilot, syncs: str) -> None:
    following = f'<gesture id="h" lexeme="BEAT" mode="RIGHT_HAND" {syncs}/>'
    pilot.block("b", gesture("OFFER", syncs='start="0.2"') + following)
    await pilot.advance(0.4)
    planned = pilot.feedback.predicted("b:h:start"), pilot.feedback.predicted("b:h:stroke")
    pilot.block("c", change("p", 'start="0"', target="b:g", parameter="temporalExtent", targetValue=1))
    await pilot.advance(8)
    assert pilot.feedback.warnings == []
    times = pilot.feedback.time("b:h:start"), pilot.feedback.time("b:h:stroke")
    assert times == pytest.approx(planned)
    assert pilot.feedback.time("b:g:relax") <= times[0] + 0.01


async def test_an_extent_that_changes_before_a_gesture_begins_counts_from_its_start(pilot: RealizerPilot) -> None:
    slow = await play(gesture(syncs='start="0.2"', temporalExtent=1), 7.0)
    pilot.block("b", gesture(syncs='start="1"'))
    await pilot.advance(0.2)
    pilot.block("c", change("p", 'start="0"', target="b:g", parameter="temporalExtent", targetValue=1))
    await pilot.advance(8)
    times = [pilot.feedback.time(f"b:g:{point}") for point in ("start", "ready", "relax", "end")]
    expected = [slow.points[point] - slow.points["start"] for point in ("start", "ready", "relax", "end")]
    assert [time - times[0] for time in times] == pytest.approx(expected, abs=0.01)


async def test_a_hand_follows_changes_ten_times_a_second_within_its_limits(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", gesture("CONDUCT", syncs='start="0.2" end="5"'))
    values = np.random.default_rng(1).uniform(-1, 1, 40)
    for number, value in enumerate(values):
        name = ("spatialExtent", "power", "fluidity", "temporalExtent")[number % 4]
        pilot.block(f"c{number}", change("p", 'start="0"', target="b:g", parameter=name, targetValue=value))
        await pilot.advance(0.1)
    await pilot.advance(2)
    assert fastest(pilot) < 60.0
    assert pilot.feedback.status("b") == "DONE"


async def test_a_jump_while_another_number_changes_is_smooth_too(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block("b", pointing("greensphere", syncs='start="0" stroke="0.7"', spatialExtent=1))
    await pilot.advance(0.2)
    pilot.block("c", change("p", 'start="0"', target="b:g", parameter="spatialExtent", targetValue=-1))
    await pilot.advance(0.1)
    pilot.block("d", change("p", 'start="0"', target="b:g", parameter="power", type="instant", targetValue=0.5))
    await pilot.advance(3)
    assert fastest(pilot) < 60.0


@pytest.mark.parametrize("way", ["interrupt", "REPLACE"])
async def test_an_expressive_gesture_can_be_broken_off_at_any_time(pilot: RealizerPilot, way: str) -> None:
    pilot.watch()
    for number in range(6):
        pilot.block(f"b{number}", gesture("CHOP", power=1, spatialExtent=1, fluidity=-1, temporalExtent=-1))
        await pilot.advance(0.4 + 0.2 * number)
        if way == "interrupt":
            pilot.block(f"i{number}", f'<bmla:interrupt id="i" target="b{number}"/>')
        else:
            pilot.block(f"i{number}", '<head id="h" lexeme="NOD"/>', composition="REPLACE")
        await pilot.advance(0.8)
    assert fastest(pilot) < 60.0
    assert pilot.feedback.warnings == []


async def test_a_stroke_that_a_prediction_moves_keeps_its_expressivity(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", gesture("CHOP", syncs='stroke="anticipators:t:hit"', power=1, spatialExtent=1))
    await pilot.advance(0.6)
    for later in (1.7, 1.6, 1.9):
        pilot.predict("t", "hit", later)
        await pilot.advance(0.1)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:stroke") == pytest.approx(1.9)
    assert fastest(pilot) < 60.0
    assert pilot.feedback.warnings == []


# --- where it comes from


async def test_a_character_has_an_expressivity_and_its_behaviors_another_one(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\nexpressivity = { temporal_extent = 0.5, fluidity = 1 }\n")
    options = SceneOptions(human, "text")
    own, given, given_too, usual = (
        await play(gesture("OFFER"), options=options),
        await play(gesture("OFFER", temporalExtent=0.5, fluidity=1)),
        await play(gesture("OFFER", temporalExtent=0, fluidity=0), options=options),
        await play(gesture("OFFER")),
    )
    assert own.points == given.points
    assert given_too.points == usual.points
    assert (given_too.hand == usual.hand).all()


# --- what cannot be


@pytest.mark.parametrize("behavior", [gesture, pointing])
@pytest.mark.parametrize("value", ["NaN", "1e9", "-1.01", "inf", "strong", ""])
async def test_a_value_that_is_none_is_named_and_nothing_else_is_lost(
    pilot: RealizerPilot, behavior: Callable[..., str], value: str
) -> None:
    pilot.block("b", behavior(power=value) + '<head id="h" lexeme="NOD"/>')
    await pilot.advance(2)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "b:g"
    assert "power" in warning.text
    assert "-1" in warning.text
    assert pilot.feedback.status("b") == "DONE"


async def test_names_may_be_in_any_case(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        gesture().replace("</gesture>", parameters({"SPATIALEXTENT": 1, "tempo": 1}) + "</gesture>")
        + gesture().replace('"g"', '"h"').replace("RIGHT", "LEFT"),
    )
    await pilot.advance(3)
    assert len(pilot.feedback.warnings) == 1
