"""Example behaviors for the entries of a binding."""

from collections.abc import Callable
from pathlib import Path
from xml.etree.ElementTree import Element, fromstring

import pytest

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.names import BML, BMLT
from reactive_realizer.engines.animation.lexicon import example_behavior

Ask = Callable[..., Element | None]


@pytest.fixture
def asked(tmp_path: Path) -> Ask:
    def ask(type_: str, inside: str = "", unit: str = 'type="class" class="x"') -> Element | None:
        path = tmp_path / "binding.xml"
        entry = f'<MotionUnitSpec type="{type_}">{inside}<MotionUnit {unit}/></MotionUnitSpec>'
        path.write_text(f"<gesturebinding>{entry}</gesturebinding>")
        text = example_behavior(GestureBinding.read(path).specs[0], "viewer")
        return None if text is None else fromstring(text)

    return ask


def constraints(**values: str) -> str:
    pairs = (f'<constraint name="{name}" value="{value}"/>' for name, value in values.items())
    return f"<constraints>{''.join(pairs)}</constraints>"


def test_the_example_has_the_attributes_of_the_entry(
    asked: Ask,
) -> None:
    element = asked("gesture", constraints(lexeme="BEAT", mode="LEFT_HAND"))
    assert element is not None
    assert element.tag == f"{{{BML}}}gesture"
    assert element.attrib == {"id": "example", "lexeme": "BEAT", "mode": "LEFT_HAND"}


def test_the_example_has_a_target_if_its_element_needs_one(
    asked: Ask,
) -> None:
    element = asked("pointing")
    assert element is not None
    assert element.get("target") == "viewer"


def test_constraints_that_are_not_attributes_become_parameters(
    asked: Ask,
) -> None:
    element = asked("gesture", constraints(lexeme="BEAT", **{"a mood": "glad"}))
    assert element is not None
    (parameter,) = element
    assert parameter.tag == f"{{{BMLT}}}parameter"
    assert parameter.attrib == {"name": "a mood", "value": "glad"}


def test_the_example_of_a_posture_has_the_stance_of_the_entry_or_standing(
    asked: Ask,
) -> None:
    sitting, standing = asked("posture", constraints(stance="sitting")), asked("postureShift")
    assert sitting is not None
    assert standing is not None
    assert sitting[0].attrib == {"type": "SITTING"}
    assert standing[0].attrib == {"type": "STANDING"}


def test_an_entry_that_needs_more_has_no_example(asked: Ask) -> None:
    assert asked("gesture") is None, "which lexeme"
    by_name = '<parametermap><parameter src="name" dst="file"/></parametermap>'
    assert asked("anything", by_name, 'type="ProcAnimation"') is None, "which file"
