"""The parts of the body that behaviors move."""

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Posture, PostureShift, Wait
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.extensions import FACES, Activate, AudioFile, Emit, Interrupt, ParameterValueChange
from reactive_realizer.bml.idle_change import IdleChange
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.names import OWN, Location
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.speech import RecordedSpeech
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.planunit.body_parts import BodyPart, parts_of

UNMOVING = {Wait, Activate, Interrupt, ParameterValueChange, Emit, AudioFile, IdleChange, Release}
WITH_POSES = {Posture, PostureShift, KeyPoses}


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


@pytest.mark.parametrize("group", BodyGroup)
def test_key_poses_move_the_parts_of_their_group(group: BodyGroup) -> None:
    place = Location(1, 1)
    moved = parts_of(KeyPoses(id="k", namespace=OWN, name="keyPoses", location=place, order=0, group=group, poses=()))
    assert (BodyPart.ARMS in moved) is (group.endswith(("ARM", "HAND", "SHOULDERS", "WHOLEBODY")))
    assert (BodyPart.HEAD in moved) is (group.startswith("HEAD") or group is BodyGroup.WHOLEBODY)
