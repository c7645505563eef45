"""What all behaviors of SmartBody have in common, and several that are one here."""

from reactive_realizer.bml.behaviors import Face, Head
from reactive_realizer.bml.extensions import Noise

from .reading import behaviors, block, only, told


def test_one_behavior_becomes_no_more_than_a_limit_of_them() -> None:
    many = " ".join(f"joint{number}" for number in range(10_000))
    assert len(behaviors(f'<sbm:noise sbm:joint-range="{many}" id="n"/>')) == 50
    assert len(behaviors(f'<locomotion target="{"1 2 " * 5_000}"/>')) == 1


def test_behaviors_that_are_joined_or_split_stay_required() -> None:
    own = block(
        '<act><bml><required><face type="facs" au="1"/><face type="facs" au="2"/><sbm:noise sbm:joint-range="a b"/>'
        "</required></bml></act>"
    )
    assert [type(each) for each in own.behaviors] == [Face, Noise, Noise]
    assert all(each.required for each in own.behaviors)


def test_groups_and_priorities_make_no_difference() -> None:
    assert isinstance(only('<head type="NOD" group="g" priority="3"/>'), Head)


def test_a_number_that_is_none_drops_its_behavior() -> None:
    (sentence,) = told('<head type="NOD" velocity="fast"/>')
    assert sentence == "velocity='fast' of <head>: not a finite number"


def test_an_element_that_is_not_known_stays_for_engines_of_plug_ins() -> None:
    assert only('<sbm:quickdraw id="q" anim="draw"/>').namespace == "urn:smartbody"
