"""Gestuaries of Greta: what they say about hands, and what is left out of wrong ones."""

import logging
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.binding.gestuary import Gestuary, read_hand_shapes
from reactive_realizer.binding.gestuary_phases import HandPhase, Wave, filled
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.errors import RealizerError

Read = Callable[..., Gestuary]
PLACE = (
    "<symbolicPosition><horizontalLocation value='XP'/><verticalLocation value='YCC'/>"
    "<frontalLocation value='ZFar'/></symbolicPosition>"
)


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Reads a file with phases of a gesture ``show=Box``."""

    def read_(*phases: str) -> Gestuary:
        inside = "\n".join(f"<phase>{each}</phase>" for each in phases)
        path = tmp_path / "gestuary.xml"
        path.write_text(f'<gestuary>\n<gesture category="show" id="Box">\n{inside}\n</gesture>\n</gestuary>')
        return Gestuary.read(path)

    return read_


def hand(inside: str, attributes: str = 'side="RIGHT"') -> str:
    return f"<hand {attributes}>{inside}</hand>"


def only(gestuary: Gestuary) -> HandPhase:
    ((phase,),) = (gestuary.gesture("Box").phases,)
    (found,) = phase
    return found


def test_symbols_of_a_place_are_lengths_of_the_arm(read: Read) -> None:
    assert only(read(hand(PLACE))).place == (0.5, 0.25, 0.95)


def test_symbols_may_be_text_as_in_older_files(read: Read) -> None:
    text = "<symbolicPosition><verticalLocation>YUpperP</verticalLocation></symbolicPosition>"
    assert only(read(hand(text))).place == (0.5, 0.9, 0.5)


def test_places_may_be_numbers(read: Read) -> None:
    parts = zip(("horizontal", "vertical", "frontal"), (0.3, -0.2, 0.7), strict=True)
    numbers = "".join(f'<{name}Location value="{value}"/>' for name, value in parts)
    assert only(read(hand(f"<uniformPosition>{numbers}</uniformPosition>"))).place == (0.3, -0.2, 0.7)
    assert only(read(hand('<uniformPosition x="0.1" y="0.2" z="0.3"/>'))).place == (0.1, 0.2, 0.3)


def test_a_hand_has_a_shape_an_orientation_and_an_openness(read: Read) -> None:
    inside = '<handShape value="FORM_FIST"/><wristOrientation global="true" w="2" x="0" y="0" z="0"/>'
    found = only(read(hand(f"{PLACE}{inside}", 'side="left" openness="0.4"')))
    assert (found.side, found.shape, found.turn, found.of_figure) == ("l", "FORM_FIST", (1.0, 0.0, 0.0, 0.0), True)
    assert found.openness == 0.4


@pytest.mark.parametrize("name", ["Box", "box", "show=Box", "SHOW=BOX", "gesture=box"])
def test_a_gesture_is_found_by_its_id_with_or_without_its_category(read: Read, name: str) -> None:
    assert read(hand(PLACE)).gesture(name).id == "Box"


def test_an_unknown_gesture_is_an_error_that_names_the_known_ones(read: Read) -> None:
    with pytest.raises(RealizerError, match=r"gestuary.xml has no gesture 'Boxx'; .*'Box'"):
        read(hand(PLACE)).gesture("Boxx")


def test_of_two_gestures_with_an_id_the_category_selects_one(tmp_path: Path) -> None:
    path = tmp_path / "two.xml"
    path.write_text('<gestuary><gesture category="a" id="x"/><gesture category="b" id="x"/></gestuary>')
    read = Gestuary.read(path)
    assert [read.gesture(name).category for name in ("x", "a=x", "b=x")] == ["a", "a", "b"]


def test_a_hand_keeps_what_a_phase_leaves_open(read: Read) -> None:
    turned = '<wristOrientation global="true" w="1" x="0" y="0" z="0"/>'
    relaxed, fist = hand(f'{PLACE}{turned}<handShape value="RELAX"/>'), hand('<handShape value="FORM_FIST"/>')
    phases = read(relaxed, hand(PLACE), fist, "", hand(PLACE, 'side="LEFT"')).gesture("Box").phases
    right = filled(phases, "r").values()
    assert [each.shape for each in right] == ["RELAX", "RELAX", "FORM_FIST", "FORM_FIST", "FORM_FIST"]
    assert {each.place for each in right} == {(0.5, 0.25, 0.95)}
    assert {(each.turn, each.of_figure) for each in right} == {((1.0, 0.0, 0.0, 0.0), True)}
    assert list(filled(phases, "l")) == [4]


def test_a_hand_is_mirrored(read: Read) -> None:
    inside = '<touchPosition value="hip_R"/><wristOrientation w="1" x="0" y="0.5" z="0.5"/>'
    once = only(read(hand(inside)))
    other = once.mirrored()
    assert (other.side, other.touch) == ("l", "hip_L")
    assert once.turn is not None
    assert other.turn is not None
    x, y, z = rotate(once.turn, (1.0, 2.0, 3.0))
    assert rotate(other.turn, (-1.0, 2.0, 3.0)) == pytest.approx((-x, y, z))
    assert other.mirrored() == once


@pytest.mark.parametrize(
    ("inside", "reason"),
    [
        (
            "<symbolicPosition><verticalLocation value='YUp'/></symbolicPosition>",
            "there is no 'YUp'; known are YUpperEP",
        ),
        ("<uniformPosition><horizontalLocation value='far'/></uniformPosition>", "value='far' is not a number"),
        ("<uniformPosition><height value='1'/></uniformPosition>", "known are horizontalLocation"),
        ("<wristOrientation w='0' x='0' y='0' z='0'/>", "the quaternion is 0"),
        ("<trajectory type='circle'><parameters axis='w' amplitude='1'/></trajectory>", "axis='w': known are x, y, z"),
        ("<palm/>", "known are symbolicPosition"),
    ],
)
def test_a_wrong_part_is_named_with_its_line_and_the_others_are_read(read: Read, inside: str, reason: str) -> None:
    gesture = read(hand('<handShape value="RELAX"/>'), hand(f"{inside}<handShape value='FORM_FIST'/>")).gesture("Box")
    (fault,) = gesture.faults
    assert fault.sentence.startswith("gestuary.xml, line 4, <")
    assert reason in fault.sentence
    assert [phase[0].shape for phase in gesture.phases] == ["RELAX", "FORM_FIST"]


def test_a_hand_without_a_side_is_left_out(read: Read) -> None:
    gesture = read(hand(PLACE, 'side="BOTH"') + hand(PLACE)).gesture("Box")
    assert [each.side for each in gesture.phases[0]] == ["r"]
    assert "side='BOTH': known are LEFT, RIGHT" in gesture.faults[0].sentence


def test_a_gesture_without_an_id_is_logged_and_left_out(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = tmp_path / "nameless.xml"
    path.write_text('<gestuary>\n<gesture category="a"/>\n<gesture id="b"/></gestuary>')
    with caplog.at_level(logging.WARNING):
        assert [gesture.id for gesture in Gestuary.read(path).gestures] == ["b"]
    assert "nameless.xml, line 2, <gesture>: the attribute id is missing; it is left out" in caplog.text


@pytest.mark.parametrize("text", ["<gestures/>", "<gestuary", '<!DOCTYPE gestuary [<!ENTITY a "b">]><gestuary/>'])
def test_a_file_that_is_no_gestuary_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "wrong.xml"
    path.write_text(text)
    with pytest.raises(RealizerError, match=r"wrong.xml, line 1"):
        Gestuary.read(path)


def test_only_the_first_hundred_phases_are_used(read: Read) -> None:
    gesture = read(*[hand(PLACE)] * 101).gesture("Box")
    assert len(gesture.phases) == 100
    assert "101 phases; the first 100 are used" in gesture.faults[0].sentence


def test_a_trajectory_has_a_wave_along_each_axis(read: Read) -> None:
    axis = (
        '<parameters axis="y" amplitude="0.2" frequency="2" shift="0.25" spatialVariation="-" temporalVariation="+"/>'
    )
    waves = only(read(hand(f'{PLACE}<trajectory type="circle">{axis}</trajectory>'))).waves
    assert waves == (Wave(0.0), Wave(0.2, 2.0, 0.25, -1, 1), Wave(0.0))
    assert only(read(hand(f'{PLACE}<trajectory type="LINEAR">{axis}</trajectory>'))).waves == ()


STEPS = st.floats(-2, 2)


@given(STEPS, st.floats(0, 4), STEPS, st.sampled_from((-1, 0, 1)), st.sampled_from((-1, 0, 1)), st.floats(0, 1))
def test_a_wave_begins_and_ends_on_the_straight_way(
    amplitude: float, frequency: float, shift: float, growth: int, haste: int, done: float
) -> None:
    wave = Wave(amplitude, frequency, shift, growth, haste)
    assert wave.off(0.0) == pytest.approx(0.0, abs=1e-9)
    assert wave.off(1.0) == pytest.approx(0.0, abs=1e-9)
    assert abs(wave.off(done)) <= 2.0 * abs(amplitude) + 1e-9


def test_shapes_are_rotations_of_the_joints_of_right_hands(tmp_path: Path) -> None:
    path = tmp_path / "HandShape.xml"
    path.write_text('<HandShapes><HandShape id="Hook"><r_index1 x="90" y="0" z="90"/></HandShape></HandShapes>')
    turn = read_hand_shapes(path)["hook"]["r_index1"]
    assert rotate(turn, (0.0, 1.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0))
    assert rotate(turn, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))
