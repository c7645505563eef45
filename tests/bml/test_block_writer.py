"""Blocks and procedures written as BML 1.0: what is read from it is what was written, and plays the same."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import pytest

from reactive_realizer.bml.block import BehaviorBlock, DefineProc
from reactive_realizer.bml.block_writer import document
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML, BMLA, BMLT
from reactive_realizer.limits import Limits

SPACES = f'xmlns="{BML}" xmlns:bmla="{BMLA}" xmlns:bmlt="{BMLT}" xmlns:rr="urn:reactive-realizer:1"'

DOCUMENTS = [
    f'<bml {SPACES} id="b" characterId="alice" composition="APPEND" bmla:interrupt="x,y" bmla:preplan="true" '
    'rr:accompanies="c" stroke="g:stroke"><gesture id="g" lexeme="BEAT" stroke="c:s:a+0.5"/></bml>',
    f'<bml {SPACES} id="b" bmla:appendAfter="a"><required><speech id="s"><text>One <sync id="w"/>two</text>'
    '<description priority="2" type="application/ssml+xml"><speak xmlns="http://www.w3.org/2001/10/synthesis">One '
    '<mark name="w"/><emphasis>two</emphasis></speak></description></speech>'
    '<constraint id="c"><synchronize><sync ref="s:w"/><sync ref="h:stroke"/></synchronize></constraint></required>'
    '<head id="h" lexeme="NOD" repetition="2"><bmlt:parameter name="amount" value="0.3"/></head>'
    '<constraint><after ref="s:start"><sync ref="h:start"/></after></constraint></bml>',
    f'<bml {SPACES} id="b"><wait id="w" event="go" max-wait="3"/><bmla:parametervaluechange id="p" target="s" '
    'paramId="volume" end="4"><bmla:trajectory type="linear" targetValue="12"/></bmla:parametervaluechange>'
    '<bmla:emit id="e" event="hit" start="1"><note>  as it is </note></bmla:emit></bml>',
    f'<bml {SPACES} id="b"><bmlt:keyframe id="k"><SkeletonInterpolator parts="vl5" encoding="R">0 1 0 0 0  1 1 0 0 0'
    '</SkeletonInterpolator></bmlt:keyframe><wink xmlns="urn:example:wink" id="x" eye="left"><lid/></wink></bml>',
    f'<bml {SPACES} id="b"><rr:keyPoses id="k" group="HEAD" fadeIn="0.1234567" up="1"><rr:keyPose id="up" time="0.7">'
    '<rr:lookAt target="1 2 -3.5"/><rr:pose name="x" influence="0.5"/></rr:keyPose></rr:keyPoses></bml>',
    f'<bml {SPACES} id="b"><murmlgesture xmlns="http://www.techfak.uni-bielefeld.de/ags/soa/murml" id="g" ready="1">'
    '<murml-description><static slot="HandLocation" value="LocHead"/></murml-description></murmlgesture></bml>',
    f'<bmla:defineproc {SPACES} id="p"><head id="h" lexeme="NOD"/></bmla:defineproc>'
    f'<bmla:useproc {SPACES} procid="p" bmlid="u" characterId="alice"/>',
    '<act><participant id="brad"/><bml><sbm:noise sbm:joint-range="l_elbow r_elbow" sbm:scale="0.1"/>'
    '<sbm:reach target="x" sbm:action="pick-up" end="4"/><gaze target="x" sbm:joint-range="NECK" sbm:joint-speed="40"/>'
    "</bml></act>",
    '<bml><gaze target="viewer" start="1"/><head type="NOD" repeats="2"/><posture stance="sitting"/></bml>',
]


def written(text: str) -> list[BehaviorBlock | DefineProc]:
    found = parse(text, Limits())
    assert not any(each.problems for each in found)
    return [each.written for each in found if each.written is not None]


def plain(part: Any) -> Any:
    """What a part means: without places, sources and prefixes."""
    if isinstance(part, Mapping):
        return {key: plain(value) for key, value in part.items()}
    if isinstance(part, tuple):
        return tuple(map(plain, part))
    if not is_dataclass(part):
        return part
    left_out = {"location", "source", "namespace", "content", "interpolator", "children"}
    return {each.name: plain(getattr(part, each.name)) for each in fields(part) if each.name not in left_out}


@pytest.mark.parametrize("text", DOCUMENTS)
def test_a_document_that_is_written_and_read_means_the_same(text: str) -> None:
    before = written(text)
    after = written(document(before))
    assert plain(tuple(after)) == plain(tuple(before))


def test_a_block_is_written_with_short_prefixes_and_indented() -> None:
    (block,) = written(f'<bml {SPACES} id="b"><wait id="w" duration="1"/></bml>')
    assert document([block]) == f'<bml xmlns="{BML}" id="b">\n  <wait id="w" duration="1"/>\n</bml>\n'


def test_the_content_of_an_event_and_of_other_languages_stays_as_it_was() -> None:
    (block,) = written(DOCUMENTS[2])
    assert "<note>  as it is </note>" in document([block])


def test_numbers_are_written_with_all_their_digits() -> None:
    (block,) = written(DOCUMENTS[4])
    assert 'fadeIn="0.1234567"' in document([block])
    assert isinstance(block, BehaviorBlock)
    (behavior,) = block.behaviors
    third = replace(behavior, fade_out=1 / 3)  # type: ignore[call-arg]
    (again,) = written(document([replace(block, behaviors=(third,))]))
    assert again.behaviors[0].fade_out == pytest.approx(1 / 3, abs=1e-15)  # type: ignore[attr-defined]
