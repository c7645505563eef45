"""The parts of the body that behaviors move."""

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Posture, PostureShift, RecordedSpeech, Wait
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.extensions import FACES, Activate, AudioFile, Emit, Interrupt, ParameterValueChange
from reactive_realizer.planunit.body_parts import BodyPart, parts_of

UNMOVING = {Wait, Activate, Interrupt, ParameterValueChange, Emit, AudioFile}
WITH_POSES = {Posture, PostureShift}


def parts_of_kind(kind: type[Behavior]) -> frozenset[BodyPart]:
    return parts_of(object.__new__(kind))


@pytest.mark.parametrize("name", ELEMENTS)
def test_every_element_moves_parts_of_the_body_or_none_at_all(name: str) -> None:
    kind = ELEMENTS[name].behavior
    if kind not in WITH_POSES:
        assert bool(parts_of_kind(kind)) is (kind not in UNMOVING)


def test_each_language_of_the_face_moves_it() -> None:
    assert {parts_of_kind(kind) for kind in FACES} == {frozenset({BodyPart.FACE})}


def test_a_speech_from_a_file_uses_the_voice() -> None:
    assert parts_of_kind(RecordedSpeech) == {BodyPart.VOICE}
