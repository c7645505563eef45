"""Emitters of AsapRealizer: blinks and breaths in intervals are rates of idle animation."""

import pytest

from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.idle_change import IdleChange, IdleParameter
from reactive_realizer.limits import Limits


def read(emitter: str) -> Parsed:
    (parsed,) = parse(
        '<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" id="b">'
        f"<bmlt:{emitter}/></bml>",
        Limits(),
    )
    return parsed


EMITTERS = {
    'blinkemitter id="x" range="0.5" avgwaitingtime="4"': (IdleParameter.BLINK_RATE, 15.0),
    'breathingemitter id="x" start="2" avgwaitingtime="8"': (IdleParameter.BREATHING_RATE, 7.5),
}


@pytest.mark.parametrize("written", EMITTERS)
def test_an_emitter_with_an_interval_sets_a_rate(written: str) -> None:
    parsed = read(written)
    assert not parsed.problems
    assert parsed.block is not None
    (change,) = parsed.block.behaviors
    assert isinstance(change, IdleChange)
    assert (change.parameter, change.value) == EMITTERS[written]


@pytest.mark.parametrize("interval", ["0", "-1", "soon"])
def test_an_interval_that_no_character_has_is_refused_by_its_name(interval: str) -> None:
    (problem,) = read(f'blinkemitter id="x" avgwaitingtime="{interval}"').problems
    assert f"avgwaitingtime='{interval}' of <blinkemitter>" in problem.fault.sentence


@pytest.mark.parametrize("written", ['blinkemitter id="x"', 'gazeemitter id="x" avgwaitingtime="4"'])
def test_other_emitters_are_left_to_engines_of_plug_ins(written: str) -> None:
    parsed = read(written)
    assert parsed.block is not None
    assert [behavior.name for behavior in parsed.block.behaviors] == [written.split()[0]]
