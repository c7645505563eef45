"""How a planner asks for what an entry plays."""

from pathlib import Path
from xml.etree.ElementTree import Element, fromstring

import pytest

from reactive_realizer.binding.asking import asking
from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.names import BML, BMLT


@pytest.fixture
def asked(tmp_path: Path):
    def ask(type_: str, inside: str = "", unit: str = 'type="class" class="x"') -> Element | None:
        path = tmp_path / "binding.xml"
        entry = f'<MotionUnitSpec type="{type_}">{inside}<MotionUnit {unit}/></MotionUnitSpec>'
        path.write_text(f"<gesturebinding>{entry}</gesturebinding>")
        text = asking(GestureBinding.read(path).specs[0], "viewer")
        return None if text is None else fromstring(text)

    return ask


def constraints(**values: str) -> str:
    pairs = (f'<constraint name="{name}" value="{value}"/>' for name, value in values.items())
    return f"<constraints>{''.join(pairs)}</constraints>"


def test_by_an_element_that_has_the_attributes_that_are_wanted(asked):
    element = asked("gesture", constraints(lexeme="BEAT", mode="LEFT_HAND"))
    assert element.tag == f"{{{BML}}}gesture"
    assert element.attrib == {"id": "word", "lexeme": "BEAT", "mode": "LEFT_HAND"}


def test_at_something_where_a_target_is_wanted(asked):
    assert asked("pointing").get("target") == "viewer"


def test_by_a_parameter_where_bml_has_no_such_attribute(asked):
    (parameter,) = asked("gesture", constraints(lexeme="BEAT", **{"a mood": "glad"}))
    assert parameter.tag == f"{{{BMLT}}}parameter"
    assert parameter.attrib == {"name": "a mood", "value": "glad"}


def test_in_the_stance_that_is_wanted_and_else_standing(asked):
    assert asked("posture", constraints(stance="sitting"))[0].attrib == {"type": "SITTING"}
    assert asked("postureShift")[0].attrib == {"type": "STANDING"}


def test_not_at_all_where_the_behavior_has_to_say_more(asked):
    assert asked("gesture") is None, "which lexeme"
    by_name = '<parametermap><parameter src="name" dst="file"/></parametermap>'
    assert asked("anything", by_name, 'type="ProcAnimation"') is None, "which file"
