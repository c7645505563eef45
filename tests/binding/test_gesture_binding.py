"""Which motion plays which behavior."""

from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.binding.gesture_binding import GestureBinding, numbers
from reactive_realizer.bml.names import BML, BMLT
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
def read(tmp_path):
    def read_text(content: str) -> GestureBinding:
        path = tmp_path / "binding.xml"
        path.write_text(content)
        return GestureBinding.read(path)

    return read_text


def test_every_entry_that_fits_is_given_in_the_order_of_the_file(read):
    attributes = {"lexeme": "BEAT", "mode": "LEFT_HAND", "{urn:x}mood": "glad"}
    assert [spec.file for spec in read(TWO).match("gesture", BML, attributes)] == ["beat.xml", "other.xml"]


@pytest.mark.parametrize("attributes", [{"lexeme": "BEAT"}, {"lexeme": "BEAT", "mode": "LEFT_HAND", "mood": "glad"}])
def test_an_entry_fits_only_if_every_constraint_is_met(read, attributes):
    assert [spec.file for spec in read(TWO).match("gesture", BML, attributes)] == ["other.xml"]


def test_words_compare_in_any_case_and_with_either_hyphen(read):
    (spec, _) = read(TWO).match("gesture", BML, {"lexeme": "beat", "mode": "Left-Hand", "{urn:x}mood": "GLAD"})
    assert spec.file == "beat.xml"


def test_an_entry_is_for_one_element_of_one_namespace(read):
    binding = read(TWO)
    assert [spec.implementation for spec in binding.match("noise", BMLT, {})] == ["Perlin"]
    assert binding.match("noise", BML, {}) == ()
    assert binding.match("head", BML, {"lexeme": "BEAT"}) == ()


def test_parameters_are_what_the_behavior_says_or_else_the_defaults(read):
    (spec, _) = read(TWO).match("gesture", BML, {"lexeme": "BEAT", "mode": "LEFT_HAND", "{urn:x}mood": "glad"})
    assert spec.parameters({"lexeme": "BEAT"}) == {"a": "0.3", "hold": "long"}
    assert spec.parameters({"amount": "0.9"}) == {"a": "0.9", "hold": "long"}
    assert numbers({"a": "0.9", "hold": "long", "b": "nan", "c": "1e999"}) == {"a": 0.9}


def test_rest_poses_are_left_out_and_noted(read, caplog):
    with caplog.at_level("INFO"):
        assert read("<gesturebinding><RestPoseSpec/></gesturebinding>").specs == ()
    assert "<RestPoseSpec> is not realized" in caplog.text


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
    ],
)
def test_a_wrong_binding_is_refused_by_file_line_element_and_reason(read, content, message):
    with pytest.raises(RealizerError, match=message) as caught:
        read(content)
    assert caught.value.fault.code == "bad-asset"


def test_the_binding_of_the_peer_is_read_and_finds_its_nod(shared_cases):
    binding = GestureBinding.read(shared_cases / "asap" / "gesturebinding" / "gesturebinding.xml")
    assert len(binding.specs) == 78
    (spec,) = binding.match("head", BML, {"lexeme": "NOD", "repetition": "2", "amount": "0.8"})
    assert spec.file is not None
    assert spec.file.endswith("nod.xml")
    assert spec.parameters({"repetition": "2", "amount": "0.8"}) == {"r": "2", "a": "0.8"}


OURS = GestureBinding.read(ASSETS / "gesturebinding.xml")


@pytest.mark.parametrize("lexeme", ["BEAT", "OFFER", "GREET", "WAVE", "CONDUCT", "SELF"])
@pytest.mark.parametrize(("mode", "mirror"), [("RIGHT_HAND", None), ("LEFT_HAND", "true"), (None, None)])
def test_our_binding_has_every_gesture_for_either_hand_and_the_right_one_by_default(lexeme, mode, mirror):
    attributes = {"lexeme": lexeme} | ({"mode": mode} if mode else {})
    spec = OURS.match("gesture", BML, attributes)[0]
    assert spec.file is not None
    assert spec.file.endswith("_right.xml")
    assert spec.parameters(attributes).get("mirror") == mirror


@pytest.mark.parametrize("lexeme", ["BEAT", "OFFER"])
def test_our_binding_has_beat_and_offer_for_both_hands(lexeme):
    assert OURS.match("gesture", BML, {"lexeme": lexeme, "mode": "BOTH_HANDS"})[0].file == (
        f"procanimation/{lexeme.lower()}_both.xml"
    )


@pytest.mark.parametrize("lexeme", ["NOD", "SHAKE"])
def test_our_binding_maps_amount_and_repetition_of_head_movements(lexeme):
    attributes = {"lexeme": lexeme, "amount": "0.7", "repetition": "3"}
    (spec,) = OURS.match("head", BML, attributes)
    assert numbers(spec.parameters(attributes)) == {"a": 0.7, "r": 3.0}


def test_every_file_that_our_binding_names_is_there():
    files = [spec.file for spec in OURS.specs if spec.file is not None]
    assert files
    assert all((ASSETS / file).is_file() for file in files)
