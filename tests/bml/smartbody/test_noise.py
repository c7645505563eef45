"""Noise of SmartBody."""

from reactive_realizer.bml.behaviors import Gesture
from reactive_realizer.bml.extensions import Noise

from .reading import behaviors, told


def test_noise_turns_each_of_its_joints_and_persists() -> None:
    noises = behaviors('<sbm:noise id="n" sbm:joint-range="l_shoulder spine3" sbm:scale="0.1" sbm:frequency="0.5"/>')
    assert {each.joint: each.id for each in noises if isinstance(each, Noise) and each.persistent} == {
        "l_shoulder": "n",
        "vt6": "noise1",
    }
    for noise in noises:
        assert noise.parameters == {
            **{f"baseamplitude{axis}": "0.1" for axis in "xyz"},
            **{f"basefreq{axis}": "0.5" for axis in "xyz"},
        }


def test_noise_with_an_end_ends() -> None:
    (noise,) = behaviors('<sbm:noise sbm:joint-range="l_elbow" end="3"/>')
    assert not noise.persistent
    assert noise.parameters["baseamplitudex"] == "0.02"


def test_noise_that_is_switched_off_is_told() -> None:
    assert told('<sbm:noise sbm:joint-range="l_elbow" enable="false"/>')[0].startswith("enable of SmartBody")


def test_joints_of_a_gesture_have_noise_while_it_holds() -> None:
    noise_of = 'sbm:joint-range="l_shoulder l_elbow" sbm:scale="0.04"'
    *noises, gesture = behaviors(f'<gesture id="g" lexeme="BEAT" relax="5" {noise_of}/>')
    assert isinstance(gesture, Gesture)
    assert sorted(each.joint for each in noises if isinstance(each, Noise)) == ["l_elbow", "l_shoulder"]
    for noise in noises:
        assert {point: str(ref) for point, ref in noise.syncs.items()} == {"start": "g:strokeEnd", "end": "g:relax"}
    assert len(behaviors(f'<gesture lexeme="BEAT" {noise_of}/>')) == 1
