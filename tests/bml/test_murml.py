"""MURML: what a description means, and what is said of what cannot be read."""

import math
from collections.abc import Iterable

import pytest

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.murml.description import (
    GesturePlace,
    Heading,
    Keyframing,
    MurmlDescription,
    Point,
    Scope,
    Shift,
    Slot,
)
from reactive_realizer.bml.murml.symbols import SYMBOLS
from reactive_realizer.bml.names import BML, MURML
from reactive_realizer.limits import Limits

FRAMES = "<dynamic><keyframing {}><phase>{}</phase></keyframing></dynamic>"


def read(
    inside: str, element: str = "murmlgesture", limits: Limits | None = None
) -> tuple[MurmlGesture | MurmlFace | None, tuple[Problem, ...]]:
    lines = f'<bml xmlns="{BML}" id="b">\n<{element} xmlns="{MURML}" id="x"><murml-description>\n{inside}\n'
    (found,) = parse(f"{lines}</murml-description></{element}></bml>", limits or Limits())
    behaviors = found.block.behaviors if found.block else ()
    (behavior,) = behaviors or (None,)
    assert behavior is None or isinstance(behavior, MurmlGesture | MurmlFace)
    return behavior, found.problems


def meaning(inside: str) -> MurmlDescription:
    behavior, problems = read(inside)
    assert not problems
    assert isinstance(behavior, MurmlGesture)
    return behavior.description


def courses(inside: str) -> dict[tuple[Slot, Scope], list[tuple[float, object]]]:
    tracks = meaning(inside).tracks
    return {(each.slot, each.scope): [(mark.position, mark.value) for mark in each.marks] for each in tracks}


def static(value: str, slot: str = "HandLocation", more: str = "") -> str:
    return f'<static slot="{slot}" value="{value}" {more}/>'


def dynamic(*values: str, slot: str = "HandLocation", more: str = "") -> str:
    kinds = ["start", *["via"] * (len(values) - 2), "end"]
    written = "".join(f'<value type="{kind}" name="{value}"/>' for kind, value in zip(kinds, values, strict=True))
    return f'<dynamic slot="{slot}" {more}><dynamicElement type="linear">{written}</dynamicElement></dynamic>'


PLACE = (Slot.HAND_LOCATION, Scope.RIGHT)
PALM = (Slot.PALM_ORIENTATION, Scope.RIGHT)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1 0.2 -0.3", Point((0.1, 0.2, -0.3))),
        ("LocShoulder LocCenterLeft LocFar", GesturePlace(1.0, 25.0, SYMBOLS.distances["LocFar"])),
        ("LocStomach LocNear", GesturePlace(0.3, 0.0, SYMBOLS.distances["LocNear"])),
        ("LocStomach LocPeripheryRight", GesturePlace(0.3, -50.0, SYMBOLS.distances["LocNorm"])),
        ("LocAboveHead", GesturePlace(3.0, 0.0, SYMBOLS.distances["LocNorm"])),
    ],
)
def test_a_location_is_given_by_symbols_or_by_numbers(text: str, value: object) -> None:
    assert courses(static(text)) == {PLACE: [(0.0, value)]}


@pytest.mark.parametrize(
    ("text", "direction"),
    [
        ("DirUL", (1.0, 1.0, 0.0)),
        ("DirALAA", (1.0, 0.0, 3.0)),
        ("PalmRD", (-1.0, -1.0, 0.0)),
        ("DirT", (0.0, 0.0, -1.0)),
        ("1 2 3", (1.0, 2.0, 3.0)),
        ("90", (0.0, 1.0, 0.0)),
    ],
)
def test_each_letter_of_a_direction_counts(text: str, direction: tuple[float, ...]) -> None:
    ((_, value),) = courses(static(text, "PalmOrientation"))[PALM]
    assert isinstance(value, Heading)
    assert value.direction == pytest.approx(direction)


def test_movements_in_parallel_take_equally_long_and_poses_are_kept() -> None:
    found = courses(
        f"<parallel>{dynamic('0 0 1', '0 0 2', '0 0 3')}{static('PalmU', 'PalmOrientation')}"
        f"{dynamic('DirU', 'DirA', slot='ExtFingerOrientation')}</parallel>"
    )
    assert [position for position, _ in found[PLACE]] == [0.0, 1.0, 2.0]
    assert [position for position, _ in found[PALM]] == [0.0, 2.0]
    assert [position for position, _ in found[Slot.EXT_FINGER_ORIENTATION, Scope.RIGHT]] == [0.0, 2.0]


def test_movements_in_a_sequence_follow_each_other() -> None:
    there = f"<parallel>{static('0 0 3')}{static('PalmU', 'PalmOrientation')}</parallel>"
    found = courses(f"<sequence>{dynamic('0 0 1', '0 0 2')}{dynamic('0 0 2', '0 0 4')}{there}</sequence>")
    places = [(position, value.target[2]) for position, value in found[PLACE] if isinstance(value, Point)]
    assert places == [(0.0, 1.0), (1.0, 2.0), (2.0, 4.0), (3.0, 3.0)]
    assert [position for position, _ in found[PALM]] == [3.0]


def test_a_movement_may_be_given_by_its_direction_and_distance() -> None:
    values = (
        '<value type="start" name="0 0 1"/><value type="direction" name="DirU"/><value type="distance" name="DistFar"/>'
    )
    found = courses(f'<dynamic slot="HandLocation"><dynamicElement type="linear">{values}</dynamicElement></dynamic>')
    assert found[PLACE] == [(0.0, Point((0.0, 0.0, 1.0))), (1.0, Shift((0.0, 1.0, 0.0), SYMBOLS.ways["DistFar"]))]


SIGNS = {
    "Sym": ((1, 1, 1), (1, 1, 1)),
    "SymMS": ((-1, 1, 1), (-1, 1, 1)),
    "SymMT": ((-1, -1, 1), (1, -1, 1)),
    "SymMF": ((-1, 1, -1), (1, 1, -1)),
    "SymMST": ((-1, -1, 1), (-1, -1, 1)),
    "SymMSF": ((-1, 1, -1), (-1, 1, -1)),
    "SymMTF": ((-1, -1, -1), (1, -1, -1)),
    "SymMSTF": ((-1, -1, -1), (-1, -1, -1)),
}


@pytest.mark.parametrize("symmetry", SIGNS)
def test_the_other_hand_is_mirrored_in_the_planes_of_a_symmetry(symmetry: str) -> None:
    inside = f"<parallel>{static('1 2 3')}{static('1 2 3', 'PalmOrientation')}</parallel>"
    found = courses(f'<symmetrical dominant="left_arm" symmetry="{symmetry}">{inside}</symmetrical>')
    place, direction = ((x, 2.0 * y, 3.0 * z) for x, y, z in SIGNS[symmetry])
    assert found[Slot.HAND_LOCATION, Scope.LEFT] == [(0.0, Point((1.0, 2.0, 3.0)))]
    assert found[PLACE] == [(0.0, Point(place))]
    assert found[PALM] == [(0.0, Heading(direction))]


def keyframing(attributes: str, frames: str) -> Keyframing:
    found = meaning(FRAMES.format(attributes, frames)).keyframing
    assert found is not None
    return found


def test_the_times_of_a_phase_count_from_the_end_of_the_one_before() -> None:
    frame = '<frame ftime="{}"><posture>Humanoid (vc4 3 1 2 3) (l_elbow 7)</posture></frame>'
    found = keyframing("", f"{frame.format(0.5)}{frame.format(1)}</phase><phase>{frame.format(0.25)}")
    assert [each.time for each in found.frames] == [0.5, 1.0, 1.25]
    assert found.frames[0].values == {"vc4": (1.0, 2.0, 3.0), "l_elbow": (7.0,)}


def test_values_of_frames_beyond_the_limit_are_left_out_from_a_frame_on_and_named() -> None:
    frames = "".join(
        f'\n<frame ftime="{number}"><posture>Humanoid (vc4 1 2) (l_elbow 1 7)</posture></frame>'
        for number in range(1, 6)
    )
    for element in ("murmlgesture", "murmlface"):
        behavior, problems = read(FRAMES.format("", frames), element, Limits(goals_per_behavior=5))
        assert behavior is not None
        found = behavior.description.keyframing if isinstance(behavior, MurmlGesture) else behavior.keyframing
        assert found is not None
        assert [frame.time for frame in found.frames] == [1.0, 2.0]
        told = "this frame and all after it are left out: at most 5 values of frames are played (goals_per_behavior)"
        assert [(each.fault.line, each.fault.sentence) for each in problems] == [(6, told)]


def test_movements_beyond_the_limit_are_left_out_and_the_first_one_is_named() -> None:
    inside = "\n".join(static(f"0 0 0.{number}") for number in range(1, 8))
    palm = static("PalmU", "PalmOrientation")
    both = f"<parallel><sequence>{inside}</sequence>{palm}</parallel>"
    behavior, problems = read(both, limits=Limits(movements_per_gesture=4))
    assert isinstance(behavior, MurmlGesture)
    places = {track.slot: [mark.position for mark in track.marks] for track in behavior.description.tracks}
    assert places == {Slot.HAND_LOCATION: [0.0, 1.0, 2.0, 3.0], Slot.PALM_ORIENTATION: [0.0]}
    told = "this value and all after it are left out: at most 4 movements are played (movements_per_gesture)"
    assert [(each.fault.line, each.fault.sentence) for each in problems] == [(7, told)]


def test_a_way_to_a_frame_eases_about_its_turning_point() -> None:
    frame = '<frame ftime="1"><posture>Humanoid (vc4 3 1 2 3)</posture></frame>'
    even, soft, late = (
        keyframing(f'easescale="{scale}" easeturningpoint="{point}"', frame).progress
        for scale, point in ((0, 0.5), (10, 0.5), (10, 0.8))
    )
    assert [even(0.25), soft(0.5), soft(0.0), soft(1.0)] == pytest.approx([0.25, 0.5, 0.0, 1.0])
    assert soft(0.25) < 0.1
    assert late(0.5) < 0.1
    assert math.isclose(soft(0.25) + soft(0.75), 1.0)


GOOD = static("0 0 1")
LEFT = static("0 0 1", more='scope="left_arm"')
POSTURE = "<posture>Humanoid (vc4 3 1 2 3)</posture>"

FAULTY: Iterable[tuple[str, str]] = (
    (static("LocElbow LocFar"), "HandLocation has no LocElbow; it has LocHip"),
    (static("LocHead LocCenterleft LocFar"), "did you mean 'LocCenterLeft'?"),
    (static("LocHead LocCenterLeft LocFar LocFar"), "a place has a height, a direction and a distance"),
    (static("1 2"), "HandLocation '1 2': a place has three numbers"),
    (static("1e400 0 0"), "HandLocation has no 1e400"),
    (static("DirX", "PalmOrientation"), "PalmOrientation 'DirX': a direction has letters of L, R, U, D, A and T"),
    (static("DirLR", "ExtFingerOrientation"), "ExtFingerOrientation 'DirLR': it has no direction"),
    (static("../fist", "HandShape"), "it is no name of a hand shape"),
    (static("BSfist (ThExt)", "HandShape"), "a modified hand shape has no effect"),
    (static("DirA", "GazeDirection"), "GazeDirection has no effect: use the behavior of BML"),
    (static("DirA", "Elbow"), "slot of static has no Elbow; it has HandLocation"),
    ('<static slot="HandLocation"/>', "this movement of HandLocation needs the attribute value"),
    (static("0 0 1", more='scope="leg"'), "scope has no leg; it has left_arm, right_arm"),
    ("<loop/>", "unknown loop in <parallel>"),
    ('<symmetrical symmetry="SymX"/>', "symmetry has no SymX; it has Sym, SymMS"),
    ('<dynamic slot="HandLocation"><dynamicElement/></dynamic>', "needs values of the types start and end"),
    (
        '<dynamic slot="HandLocation"><dynamicElement type="curve"><value type="start" name="0 0 1"/>'
        '<value type="end" name="0 0 2"/></dynamicElement></dynamic>',
        "needs a value of the type normal; it is straight now",
    ),
    (dynamic("0 0 1", "0 0 2").replace("linear", "spiral"), "type of dynamicElement has no spiral"),
    (
        '<dynamic slot="HandLocation"><dynamicElement><value type="start" name="0 0 1"/>'
        '<value type="direction" name="DirU"/><value type="distance" name="-0.3"/></dynamicElement></dynamic>',
        "distance '-0.3': it must not be below 0",
    ),
    (dynamic("0 0 1", "0 0 2").replace('"start"', '"begin"'), "type of value has no begin"),
)


CURVE = """<dynamic slot="HandLocation"><dynamicElement type="curve"><value type="start" name="0 0 1"/>
<value type="end" name="0 0 2"/><value type="normal" name="DirU"/><value type="{}" name="{}"/>
</dynamicElement></dynamic>"""


@pytest.mark.parametrize(
    ("form", "text", "told"),
    [
        ("roundness", "Round", "roundness has no Round; it has Sharp, Normal, Broad"),
        ("skewedness", "1.5", "skewedness '1.5': it must be from -1 to 1"),
        ("extent", "-0.2", "extent '-0.2': it must not be below 0"),
    ],
)
def test_a_form_that_a_curve_cannot_have_is_named(form: str, text: str, told: str) -> None:
    behavior, problems = read(f"<parallel>{LEFT}{CURVE.format(form, text)}</parallel>")
    assert isinstance(behavior, MurmlGesture)
    assert [told in each.fault.sentence for each in problems] == [True]
    assert [each.fault.line for each in problems] == [4]


MOVE = '<value type="start" name="0 0 1"/><value type="direction" name="DirU"/>'
DOUBLED: Iterable[tuple[str, str]] = (
    (static("0 0 2"), "HandLocation of right_arm is given twice; where both have a value, this one counts"),
    (f"<sequence>{static('0 0 2')}</sequence>", "HandLocation of right_arm is given twice"),
    (
        f'<symmetrical dominant="left_arm" symmetry="SymMS">{static("0 0 2")}</symmetrical>',
        "HandLocation of right_arm is given twice",
    ),
    (
        f'<dynamic slot="HandLocation" scope="left_arm"><dynamicElement>{MOVE}\n'
        '<value type="direction" name="DirD"/></dynamicElement></dynamic>',
        "the value 'direction' is given twice; this one counts",
    ),
    (
        f'<dynamic slot="HandLocation" scope="left_arm"><dynamicElement>{MOVE}\n'
        '<value type="start" name="0 0 2"/></dynamicElement></dynamic>',
        "the value 'start' is given twice; each of them counts",
    ),
)


@pytest.mark.parametrize(("second", "sentence"), DOUBLED)
def test_what_is_given_twice_is_named_with_its_place(second: str, sentence: str) -> None:
    behavior, problems = read(f"<parallel>{GOOD}\n{second}</parallel>")
    assert isinstance(behavior, MurmlGesture)
    (told,) = problems
    assert sentence in told.fault.sentence
    assert told.fault.line == 4 + second.count("\n")


def test_slots_one_after_the_other_and_of_both_hands_are_not_doubled() -> None:
    left = static("0 0 1", more='scope="left_arm"')
    meaning(f"<parallel><sequence>{GOOD}{GOOD}{static('0 0 2')}</sequence>{left}</parallel>")


def test_a_joint_that_a_frame_gives_twice_is_named_and_the_last_one_counts() -> None:
    frame = '<frame ftime="1">\n<posture>Humanoid (vc4 3 1 2 3) (vc4 3 4 5 6)</posture></frame>'
    behavior, problems = read(FRAMES.format("", frame))
    assert isinstance(behavior, MurmlGesture)
    assert behavior.description.keyframing is not None
    assert behavior.description.keyframing.frames[0].values == {"vc4": (4.0, 5.0, 6.0)}
    told = [(each.fault.line, each.fault.sentence) for each in problems]
    assert told == [(4, "vc4 is given twice; the last one counts")]


@pytest.mark.parametrize(("wrong", "sentence"), FAULTY)
def test_what_cannot_be_read_is_named_with_its_place_and_the_rest_plays(wrong: str, sentence: str) -> None:
    behavior, problems = read(f"<parallel>{LEFT}\n  {wrong}</parallel>")
    assert isinstance(behavior, MurmlGesture)
    assert behavior.description.tracks
    (problem,) = problems
    assert sentence in problem.fault.sentence
    assert problem.fault.line == 4
    assert problem.fault.column is not None
    assert problem.fault.column >= 3
    assert problem.id == "b:x"


def test_superposed_frames_of_a_face_replace_others_with_a_note() -> None:
    face, problems = read(FRAMES.format('applymode="superpose"', f'<frame ftime="1">{POSTURE}</frame>'), "murmlface")
    assert isinstance(face, MurmlFace)
    (problem,) = problems
    assert problem.fault.sentence.startswith("applymode='superpose' has no effect: frames of a face")


@pytest.mark.parametrize(
    ("attributes", "wrong", "sentence"),
    [
        ('easescale="steep"', "", "easescale='steep' of <keyframing>: not a finite number"),
        ('applymode="superposed"', "", "applymode='superposed' of <keyframing>: not one of exclusive, superpose"),
        ('easeturningpoint="2"', "", "easeturningpoint='2' of <keyframing>: not between 0 and 1"),
        ("", f"<frame>{POSTURE}</frame>", "<frame> requires the attribute 'ftime'"),
        ("", f'<frame ftime="0.5">{POSTURE}</frame>', "is not after the one before it, at 1"),
        (
            "",
            '<frame ftime="2"><posture>Humanoid (vc4 3 1 2)</posture></frame>',
            "'(vc4 3 1 2)' is no part of a posture",
        ),
        ("", '<frame ftime="2"/>', "<frame> has nothing that can be played"),
        ("", "<posture/>", "unknown posture in <phase>"),
    ],
)
def test_frames_that_cannot_be_read_are_named_and_the_others_play(attributes: str, wrong: str, sentence: str) -> None:
    behavior, problems = read(FRAMES.format(attributes, f'<frame ftime="1">{POSTURE}</frame>\n{wrong}'))
    assert isinstance(behavior, MurmlGesture)
    assert behavior.description.keyframing is not None
    assert len(behavior.description.keyframing.frames) == 1
    assert sentence in problems[0].fault.sentence
    assert problems[0].fault.line in (3, 4)


@pytest.mark.parametrize(
    ("element", "inside", "sentence"),
    [
        ("murmlgesture", "", "<murml-description> has nothing that can be played"),
        ("murmlgesture", static("nowhere"), "HandLocation has no nowhere"),
        ("murmlgesture", FRAMES.format("", ""), "<keyframing> has nothing that can be played"),
        ("murmlface", GOOD, "<murmlface> has nothing that can be played"),
    ],
)
def test_a_description_without_anything_to_play_is_refused(element: str, inside: str, sentence: str) -> None:
    behavior, (problem,) = read(inside, element)
    assert behavior is None
    assert sentence in problem.fault.sentence
