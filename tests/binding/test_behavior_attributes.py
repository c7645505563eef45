"""Attributes of behaviors, as bindings see them."""

import pytest

from reactive_realizer.binding.unit_spec import behavior_attributes
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLT
from reactive_realizer.limits import Limits


def of(behavior: str) -> dict[str, str]:
    (parsed,) = parse(f'<bml xmlns="{BML}" xmlns:bmlt="{BMLT}" id="b">{behavior}</bml>', Limits())
    assert parsed.problems == ()
    assert parsed.block is not None
    return behavior_attributes(parsed.block.behaviors[0])


def test_attributes_include_defaults() -> None:
    assert of('<head id="h" lexeme="NOD"/>').items() >= {"lexeme": "NOD", "amount": "0.5", "repetition": "1"}.items()


def test_attributes_left_to_the_realizer_are_absent() -> None:
    assert "mode" not in of('<gesture id="g" lexeme="BEAT"/>')
    assert "influence" not in of('<gaze id="g" target="viewer"/>')


@pytest.mark.parametrize("written", ["NECK", "HEAD", "head"])
def test_values_have_the_spelling_of_bml(written: str) -> None:
    assert of(f'<gaze id="g" target="viewer" influence="{written}"/>')["influence"] == "HEAD"


def test_attributes_of_other_namespaces_are_qualified() -> None:
    assert of('<gaze id="g" target="viewer" bmlt:dynamic="true"/>')[f"{{{BMLT}}}dynamic"] == "true"


def test_bmlt_parameters_are_included() -> None:
    gesture = '<gesture id="g" lexeme="BEAT"><bmlt:parameter name="mood" value="glad"/></gesture>'
    assert of(gesture)["mood"] == "glad"


def test_the_stance_of_a_posture_is_included() -> None:
    assert of('<posture id="p"><stance type="SITTING"/></posture>')["stance"] == "SITTING"
    assert "stance" not in of('<posture id="p"><pose part="ARMS" lexeme="ARMS_OPEN"/></posture>')
