"""What a binding sees of a behavior."""

import pytest

from reactive_realizer.binding.seen import seen
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLT
from reactive_realizer.limits import Limits


def of(behavior: str) -> dict[str, str]:
    (parsed,) = parse(f'<bml xmlns="{BML}" xmlns:bmlt="{BMLT}" id="b">{behavior}</bml>', Limits())
    assert parsed.problems == ()
    return seen(parsed.block.behaviors[0])


def test_attributes_are_seen_as_they_are_written_and_defaults_too():
    assert of('<head id="h" lexeme="NOD"/>').items() >= {"lexeme": "NOD", "amount": "0.5", "repetition": "1"}.items()


def test_an_attribute_that_is_left_to_the_realizer_is_not_there():
    assert "mode" not in of('<gesture id="g" lexeme="BEAT"/>')
    assert "influence" not in of('<gaze id="g" target="viewer"/>')


@pytest.mark.parametrize("written", ["NECK", "HEAD", "head"])
def test_words_are_seen_in_the_spelling_of_bml_whatever_was_written(written):
    assert of(f'<gaze id="g" target="viewer" influence="{written}"/>')["influence"] == "HEAD"


def test_attributes_of_other_namespaces_are_seen_with_them():
    assert of('<gaze id="g" target="viewer" bmlt:dynamic="true"/>')[f"{{{BMLT}}}dynamic"] == "true"


def test_parameters_of_bmlt_are_seen_by_their_names():
    gesture = '<gesture id="g" lexeme="BEAT"><bmlt:parameter name="mood" value="glad"/></gesture>'
    assert of(gesture)["mood"] == "glad"


def test_the_stance_of_a_posture_is_seen():
    assert of('<posture id="p"><stance type="SITTING"/></posture>')["stance"] == "SITTING"
    assert "stance" not in of('<posture id="p"><pose part="ARMS" lexeme="ARMS_OPEN"/></posture>')
