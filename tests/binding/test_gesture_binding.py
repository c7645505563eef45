"""Which entries of a gesture binding match a behavior."""

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.binding.gesture_binding import GestureBinding, RestPose
from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.binding.unit_spec import CLASS_NAMES
from reactive_realizer.bml.names import BML, BMLT
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.errors import RealizerError

ASSETS = Path(str(files("reactive_realizer"))) / "assets"

TWO = """<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints>
      <constraint name="lexeme" value="BEAT"/>
      <constraint name="mode" value="LEFT_HAND"/>
      <constraint namespace="urn:x" name="mood" value="glad"/>
    </constraints>
    <parametermap><parameter src="amount" dst="a"/></parametermap>
    <parameterdefaults>
      <parameterdefault name="file" value="beat.xml"/>
      <parameterdefault name="a" value="0.3"/>
      <parameterdefault name="hold" value="long"/>
    </parameterdefaults>
    <MotionUnit type="Gesture" class="x.y.Z"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="BEAT"/></constraints>
    <MotionUnit type="ProcAnimation" file="other.xml"/>
  </MotionUnitSpec>
  <MotionUnitSpec type="noise" namespace="http://hmi.ewi.utwente.nl/bmlt">
    <MotionUnit type="class" class="Perlin"/>
  </MotionUnitSpec>
</gesturebinding>"""


@pytest.fixture
def read(tmp_path: Path) -> Callable[[str], GestureBinding]:
    def read_text(content: str) -> GestureBinding:
        path = tmp_path / "binding.xml"
        path.write_text(content)
        return GestureBinding.read(path)

    return read_text


def files_of(binding: GestureBinding, **attributes: str) -> list[str | None]:
    """The files of the entries that fit a gesture."""
    return [spec.file for spec in binding.match("gesture", BML, attributes)]


@pytest.fixture
def hands(read: Callable[[str], GestureBinding]) -> GestureBinding:
    """One gesture, by three entries: for any hands, for the left one, for the right one."""
    entry = """<MotionUnitSpec type="gesture">
      <constraints><constraint name="lexeme" value="X"/>{mode}</constraints>
      <MotionUnit type="Gesture" file="{file}.xml"/></MotionUnitSpec>"""
    mode = '<constraint name="mode" value="{}_HAND"/>'
    entries = {"any": "", "left": mode.format("LEFT"), "right": mode.format("RIGHT")}
    content = "".join(entry.format(file=file, mode=constraint) for file, constraint in entries.items())
    return read(f"<gesturebinding>{content}</gesturebinding>")


def test_an_entry_fits_only_if_every_constraint_is_met(read: Callable[[str], GestureBinding]) -> None:
    binding = read(TWO)
    assert files_of(binding, lexeme="BEAT", mode="LEFT_HAND", **{"{urn:x}mood": "glad"}) == ["beat.xml"]
    assert files_of(binding, lexeme="BEAT", mode="LEFT_HAND", mood="glad") == ["other.xml"]
    assert files_of(binding, lexeme="OTHER") == []


def test_without_a_mode_entries_for_specific_hands_come_last(hands: GestureBinding) -> None:
    assert files_of(hands, lexeme="X") == ["any.xml", "left.xml", "right.xml"]


def test_with_a_mode_entries_for_any_hands_are_no_second_choice(hands: GestureBinding) -> None:
    assert files_of(hands, lexeme="X", mode="LEFT_HAND") == ["any.xml", "left.xml"]
    assert files_of(GestureBinding(hands.specs[::-1], ()), lexeme="X", mode="LEFT_HAND") == ["left.xml"]


def test_values_compare_without_case_and_with_either_hyphen(read: Callable[[str], GestureBinding]) -> None:
    (spec,) = read(TWO).match("gesture", BML, {"lexeme": "beat", "mode": "Left-Hand", "{urn:x}mood": "GLAD"})
    assert spec.file == "beat.xml"


def test_synonyms_of_bml_are_equal(read: Callable[[str], GestureBinding]) -> None:
    binding = read(
        """<gesturebinding><MotionUnitSpec type="gaze">
          <constraints><constraint name="influence" value="neck"/></constraints>
          <MotionUnit type="class" class="gaze"/></MotionUnitSpec></gesturebinding>"""
    )
    assert binding.match("gaze", BML, {"influence": "HEAD"})
    assert not binding.match("gaze", BML, {"influence": "EYES"})


def test_entries_of_earlier_files_come_first(tmp_path: Path) -> None:
    for name in ("user", "package"):
        entry = f'<MotionUnitSpec type="gesture"><MotionUnit type="Gesture" file="{name}.xml"/></MotionUnitSpec>'
        (tmp_path / f"{name}_binding.xml").write_text(f"<gesturebinding>{entry}</gesturebinding>")
    binding = GestureBinding.read(tmp_path / "user_binding.xml", tmp_path / "package_binding.xml")
    assert files_of(binding, lexeme="X") == ["user.xml", "package.xml"]


def test_an_entry_is_for_one_element_of_one_namespace(read: Callable[[str], GestureBinding]) -> None:
    binding = read(TWO)
    assert [spec.unit for spec in binding.match("noise", BMLT, {})] == ["Perlin"]
    assert binding.match("noise", BML, {}) == ()
    assert binding.match("head", BML, {"lexeme": "BEAT"}) == ()


def test_parameters_come_from_the_behavior_or_the_defaults(read: Callable[[str], GestureBinding]) -> None:
    spec = read(TWO).specs[0]
    assert spec.parameters({"lexeme": "BEAT"}) == {"a": "0.3", "hold": "long"}
    assert spec.parameters({"amount": "0.9"}) == {"a": "0.9", "hold": "long"}
    assert finite_numbers({"a": "0.9", "hold": "long", "b": "nan", "c": "1e999"}) == {"a": 0.9}


def test_a_behavior_may_use_the_names_of_the_units_parameters(read: Callable[[str], GestureBinding]) -> None:
    spec = read(TWO).specs[0]
    assert spec.parameters({}, {"hold": "short", "b": "1"}) == {"a": "0.3", "hold": "short", "b": "1"}
    assert spec.parameters({"amount": "0.9"}, {"a": "0.1"})["a"] == "0.9"


@pytest.mark.parametrize(("name", "unit"), CLASS_NAMES.items())
def test_a_class_of_a_published_binding_is_a_unit_here(
    read: Callable[[str], GestureBinding], name: str, unit: Any
) -> None:
    assert (
        read(
            f"""<gesturebinding><MotionUnitSpec type="gaze">
          <MotionUnit type="class" class="{name}"/></MotionUnitSpec></gesturebinding>"""
        )
        .specs[0]
        .unit
        == unit
    )


def test_rest_poses_are_for_stances_and_for_poses_in_them(read: Callable[[str], GestureBinding]) -> None:
    binding = read(
        """<gesturebinding>
          <RestPoseSpec><constraints><constraint name="stance" value="sitting"/></constraints>
            <RestPose type="SkeletonPose" file="a.xml"/></RestPoseSpec>
          <RestPoseSpec><constraints>
              <constraint name="stance" value="STANDING"/><constraint name="arms" value="arms-spread"/>
            </constraints><RestPose type="SkeletonPose" file="b.xml"/></RestPoseSpec>
        </gesturebinding>"""
    )
    assert binding.rest_poses == (
        RestPose(StanceType.SITTING, {}, "a.xml"),
        RestPose(StanceType.STANDING, {PosePart.ARMS: "ARMS_SPREAD"}, "b.xml"),
    )


def test_an_entry_of_a_timed_motion_unit_is_one_of_a_kind_that_may_be_unknown(
    read: Callable[[str], GestureBinding],
) -> None:
    binding = read(
        """<gesturebinding><TimedMotionUnitSpec type="gesture">
          <constraints><constraint name="lexeme" value="SALUTE"/></constraints>
          <TimedMotionUnit type="MURML"><murml-description/></TimedMotionUnit>
        </TimedMotionUnitSpec></gesturebinding>"""
    )
    assert [spec.unit for spec in binding.match("gesture", BML, {"lexeme": "SALUTE"})] == ["MURML"]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ('<RestPose type="X"/>', "no stance or no file"),
        ('<constraints><constraint name="stance" value="SITING"/></constraints><RestPose type="X" file="a.xml"/>',
         "stance='SITING': known are SITTING, CROUCHING, STANDING, LYING"),
        ('<constraints><constraint name="stance" value="SITTING"/><constraint name="mood" value="glad"/></constraints>'
         '<RestPose type="X" file="a.xml"/>', "a constraint on MOOD: known are stance, ARMS"),
    ],
)  # fmt: skip
def test_a_rest_pose_without_a_file_or_with_unknown_constraints_is_skipped_and_logged(
    read: Callable[[str], GestureBinding], caplog: pytest.LogCaptureFixture, content: str, reason: str
) -> None:
    binding = read(f"<gesturebinding>\n<RestPoseSpec>{content}</RestPoseSpec></gesturebinding>")
    assert binding.rest_poses == ()
    assert f"line 2, <RestPoseSpec>: {reason}" in caplog.text
    assert "it is skipped" in caplog.text


def test_a_rest_gaze_plays_gaze_shifts(read: Callable[[str], GestureBinding]) -> None:
    binding = read(
        """<gesturebinding><RestGazeSpec>
          <parametermap><parameter src="target" dst="target"/></parametermap>
          <RestGaze type="class" class="asap.animationengine.gaze.DynamicRestGaze"/>
        </RestGazeSpec></gesturebinding>"""
    )
    (spec,) = binding.match("gazeShift", BML, {"target": "viewer"})
    assert spec.unit == "rest-gaze"
    assert spec.parameters({"target": "viewer"}) == {"target": "viewer"}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("<gesturebinding>", r"binding\.xml, line 1, <gesturebinding>: "),
        ("<bindings/>", r"line 1, <bindings>: the file should begin with <gesturebinding>"),
        ("<!DOCTYPE a>\n<gesturebinding/>", r"line 2, <gesturebinding>: a DOCTYPE is refused"),
        ("<gesturebinding>\n<Motion/></gesturebinding>", r"line 2, <Motion>: known are MotionUnitSpec"),
        ('<gesturebinding>\n<MotionUnitSpec type="x"/></gesturebinding>', r"<MotionUnitSpec>: no MotionUnit inside"),
        (
            '<gesturebinding><MotionUnitSpec><MotionUnit type="x" file="y"/></MotionUnitSpec></gesturebinding>',
            r"<MotionUnitSpec>: the attribute type is missing",
        ),
        (
            '<gesturebinding><MotionUnitSpec type="x">\n<MotionUnit type="x"/></MotionUnitSpec></gesturebinding>',
            r"line 2, <MotionUnit>: neither a file nor a class",
        ),
        (
            '<gesturebinding><MotionUnitSpec type="x"><constraints>\n<constraint name="a"/></constraints>'
            '<MotionUnit type="x" file="y"/></MotionUnitSpec></gesturebinding>',
            r"line 2, <constraint>: the attribute value is missing",
        ),
        (
            '<gesturebinding>\n<MotionUnitSpec type="gesture"><constraints><constraint name="mode" value="FOOT"/>'
            '</constraints><MotionUnit type="Gesture" file="y"/></MotionUnitSpec></gesturebinding>',
            r"line 2, <MotionUnitSpec>: a constraint: not one of LEFT_HAND, RIGHT_HAND, BOTH_HANDS",
        ),
        (
            '<gesturebinding><MotionUnitSpec type="a b">'
            '<MotionUnit type="x" file="y"/></MotionUnitSpec></gesturebinding>',
            r"<MotionUnitSpec>: 'a b' of 'http://www.bml-initiative.org/bml/bml-1.0' is not a valid name",
        ),
        ("<gesturebinding><RestGazeSpec/></gesturebinding>", r"<RestGazeSpec>: no RestGaze inside"),
    ],
)
def test_an_invalid_binding_is_refused_with_file_line_element_and_reason(
    read: Callable[[str], GestureBinding], content: str, message: str
) -> None:
    with pytest.raises(RealizerError, match=message) as caught:
        read(content)
    assert caught.value.fault.code == "bad-asset"


def test_a_binding_as_they_are_published_is_read_and_finds_its_entries(tests_data: Path) -> None:
    binding = GestureBinding.read(tests_data / "bindings" / "published.xml")
    assert len(binding.specs) == 13
    assert [rest.stance for rest in binding.rest_poses] == ["CROUCHING"]
    (spec,) = binding.match("head", BML, {"lexeme": "OVER_THERE", "repetition": "2", "amount": "0.8"})
    assert spec.file is not None
    assert spec.file.endswith("headpolar.xml")
    assert spec.parameters({"repetition": "2", "amount": "0.8"}) == {"r": "2", "a": "0.8", "dy": "1"}


def test_asaprealizers_binding_is_read_and_finds_its_nod(shared_cases: Path) -> None:
    binding = GestureBinding.read(shared_cases / "asap" / "gesturebinding" / "gesturebinding.xml")
    assert len(binding.specs) == 79
    assert [rest.stance for rest in binding.rest_poses] == ["SITTING"]
    (spec,) = binding.match("head", BML, {"lexeme": "NOD", "repetition": "2", "amount": "0.8"})
    assert spec.file is not None
    assert spec.file.endswith("nod.xml")
    assert spec.parameters({"repetition": "2", "amount": "0.8"}) == {"r": "2", "a": "0.8"}


OURS = GestureBinding.read(ASSETS / "gesturebinding.xml")


@pytest.mark.parametrize("lexeme", ["BEAT", "OFFER", "GREET", "WAVE", "CONDUCT", "SELF", "ONE", "REFUSE"])
@pytest.mark.parametrize(("mode", "mirror"), [("RIGHT_HAND", None), ("LEFT_HAND", "true"), (None, None)])
def test_the_default_binding_has_every_gesture_for_either_hand_and_prefers_the_right_one(
    lexeme: str, mode: str | None, mirror: str | None
) -> None:
    attributes = {"lexeme": lexeme} | ({"mode": mode} if mode else {})
    spec = OURS.match("gesture", BML, attributes)[0]
    assert spec.file is not None
    assert "both" not in spec.file
    assert spec.parameters(attributes).get("mirror") == mirror


@pytest.mark.parametrize("lexeme", ["BEAT", "OFFER"])
def test_the_default_binding_has_beat_and_offer_for_both_hands(lexeme: str) -> None:
    assert OURS.match("gesture", BML, {"lexeme": lexeme, "mode": "BOTH_HANDS"})[0].file == (
        f"procanimation/{lexeme.lower()}_both.xml"
    )


@pytest.mark.parametrize("lexeme", ["NOD", "SHAKE", "TILT", "TOSS", "WIGGLE"])
def test_the_default_binding_maps_amount_and_repetition_of_head_movements(lexeme: str) -> None:
    attributes = {"lexeme": lexeme, "amount": "0.7", "repetition": "3"}
    (spec,) = OURS.match("head", BML, attributes)
    assert finite_numbers(spec.parameters(attributes)) == {"a": 0.7, "r": 3.0}


def test_every_file_of_the_default_binding_exists() -> None:
    files = [spec.file for spec in OURS.specs if spec.file is not None]
    assert files
    assert all((ASSETS / file).is_file() for file in files)


def test_a_binding_of_100_megabytes_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "binding.xml"
    with path.open("wb") as file:
        file.truncate(100_000_000)
    with pytest.raises(RealizerError) as caught:
        GestureBinding.read(path)
    assert caught.value.fault.code == "asset-too-big"
